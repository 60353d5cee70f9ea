# Optional parts, each on when its package is found, and the flags that all code is compiled with.

find_package(Threads REQUIRED)
find_package(fmt REQUIRED)
find_package(glm REQUIRED)
find_package(TBB REQUIRED)
find_package(ZLIB REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(VulkanHeaders REQUIRED)
find_package(SPIRV-Headers REQUIRED)
find_program(GLSLANG_VALIDATOR NAMES glslangValidator glslang REQUIRED)

# strandlab_optional(NAME package help): option STRANDLAB_NAME. AUTO, the default, is asked again at every
# configuration, so that a package installed later switches its part on.
function(strandlab_optional name package help)
  set(STRANDLAB_${name} AUTO CACHE STRING "${help}: ON, OFF, or AUTO (where ${package} is found)")
  set_property(CACHE STRANDLAB_${name} PROPERTY STRINGS AUTO ON OFF)
  set(answer OFF)
  if(STRANDLAB_${name} STREQUAL AUTO OR STRANDLAB_${name})
    find_package(${package} QUIET)
    if(${package}_FOUND)
      set(answer ON)
    elseif(NOT STRANDLAB_${name} STREQUAL AUTO)
      message(FATAL_ERROR "STRANDLAB_${name} is on, but ${package} was not found: install it (tools/setup) or pass -DSTRANDLAB_${name}=OFF")
    else()
      message(STATUS "strandlab: ${package} was not found, building without it (no ${help})")
    endif()
  endif()
  set(STRANDLAB_${name} ${answer} PARENT_SCOPE)
endfunction()

strandlab_optional(EMBREE Embree "Embree as a second opinion")
strandlab_optional(IMAGES OpenImageIOLight "PNG and EXR images through OpenImageIO")
strandlab_optional(D3 D3 "sorting, hovering and zooming in reports")
strandlab_optional(TESTS GTest "tests")

option(STRANDLAB_SANITIZE "AddressSanitizer and UndefinedBehaviorSanitizer" OFF)
option(STRANDLAB_FUZZ "libFuzzer program of tests/fuzz, everything instrumented for it; clang only" OFF)
option(STRANDLAB_WERROR "Warnings are errors" OFF)

add_library(strandlab_flags INTERFACE)
# No contraction: the C++ versions of the intersectors must round as the text says.
target_compile_options(strandlab_flags INTERFACE -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                       -Wno-sign-conversion -Wno-missing-field-initializers)
# g++ 12 cannot see through out-parameters that are set exactly when the function returns true, and warns
# of overlapping copies inside std::string's operator+ (GCC bug 105651).
target_compile_options(strandlab_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>
                       $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
if(STRANDLAB_WERROR)
  target_compile_options(strandlab_flags INTERFACE -Werror)
endif()
if(STRANDLAB_SANITIZE)
  target_compile_options(strandlab_flags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined
                         -fno-omit-frame-pointer)
  target_link_options(strandlab_flags INTERFACE -fsanitize=address,undefined)
endif()
if(STRANDLAB_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "STRANDLAB_FUZZ needs clang: configure with -DCMAKE_CXX_COMPILER=clang++")
  endif()
  target_compile_options(strandlab_flags INTERFACE -g1 -UNDEBUG -D_GLIBCXX_ASSERTIONS
                         -fsanitize=fuzzer-no-link,address,undefined,float-cast-overflow
                         -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(strandlab_flags INTERFACE -fsanitize=address,undefined)
endif()
