# cmake --install: the program, the library with its headers, and the package that find_package(strandlab) reads.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/strandlab)

install(TARGETS strandlab EXPORT strandlab-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
if(TARGET strandlab_program)
  install(TARGETS strandlab_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

# All headers but those of the program, and those that show, themselves or through another header, a
# library which the package does not depend on.
file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/source source/*.h)
list(FILTER headers EXCLUDE REGEX "^commands/")
set(private "<vulkan/|<nlohmann/|<embree|<OpenImageIO/|<CLI/")
set(found_private TRUE)
while(found_private)
  set(found_private FALSE)
  foreach(header ${headers})
    file(STRINGS source/${header} private_includes REGEX "#include.*(${private})" LIMIT_COUNT 1)
    if(private_includes)
      list(REMOVE_ITEM headers ${header})
      string(APPEND private "|\"${header}\"")
      set(found_private TRUE)
    endif()
  endforeach()
endwhile()
foreach(header ${headers})
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES source/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/strandlab/${folder})
endforeach()
# The texts that C++ and GLSL share: layouts, and what the kernels of primitives/kernel.h include.
install(DIRECTORY shaders DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/strandlab FILES_MATCHING PATTERN "*.h")

install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

install(EXPORT strandlab-targets NAMESPACE strandlab:: DESTINATION ${package_dir})
configure_package_config_file(external/cmake/strandlab-config.cmake.in ${PROJECT_BINARY_DIR}/strandlab-config.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/strandlab-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/strandlab-config.cmake ${PROJECT_BINARY_DIR}/strandlab-config-version.cmake
              external/cmake/FindEmbree.cmake
        DESTINATION ${package_dir})
