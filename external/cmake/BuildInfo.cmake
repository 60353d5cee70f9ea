# base/version.h: version, commit, compiler and options, for source/base/build_info.cpp.
find_package(Git QUIET)
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
get_target_property(flags strandlab_flags INTERFACE_COMPILE_OPTIONS)
list(FILTER flags EXCLUDE REGEX "^-W|^\\$<")  # warnings say nothing about the program
list(JOIN flags " " flags)
string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}} ${flags}" flags)
add_custom_target(strandlab_version
  COMMAND ${CMAKE_COMMAND} "-Dsource_dir=${PROJECT_SOURCE_DIR}"
          "-Dtemplate=${PROJECT_SOURCE_DIR}/source/base/version.h.in"
          "-Doutput=${PROJECT_BINARY_DIR}/generated/base/version.h" "-Dgit=${GIT_EXECUTABLE}"
          "-Dversion=${PROJECT_VERSION}" "-Dcompiler=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
          "-Dflags=${flags}" "-Dbuild_type=$<IF:$<BOOL:$<CONFIG>>,$<CONFIG>,unknown>"
          -P ${PROJECT_SOURCE_DIR}/external/cmake/WriteVersion.cmake
  BYPRODUCTS ${PROJECT_BINARY_DIR}/generated/base/version.h
  COMMENT "" VERBATIM)
add_dependencies(strandlab strandlab_version)
target_include_directories(strandlab PRIVATE ${PROJECT_BINARY_DIR}/generated)
