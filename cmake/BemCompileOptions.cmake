# One interface target with the options that every target of the project shares.
add_library(bem_options INTERFACE)
target_compile_options(bem_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                                             -Wno-unknown-pragmas)
if(CMAKE_UNITY_BUILD)
  # to the compiler, sources that are compiled together are headers
  target_compile_options(bem_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()
if(BEM_WARNINGS_AS_ERRORS)
  target_compile_options(bem_options INTERFACE -Werror)
endif()
if(BEM_BUILD_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "BEM_BUILD_FUZZ needs clang: -DCMAKE_CXX_COMPILER=clang++")
  endif()
  target_compile_options(bem_options INTERFACE -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined
                                               -fno-omit-frame-pointer)
  target_link_options(bem_options INTERFACE -fsanitize=address,undefined)
endif()
if(BEM_SANITIZE)
  target_compile_options(bem_options INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer)
  target_link_options(bem_options INTERFACE -fsanitize=address,undefined)
endif()

# What nearly every source includes, precompiled. Sources include what they use all the same.
set(BEM_COMMON_HEADERS <Eigen/Dense> <algorithm> <array> <functional> <memory> <string> <vector>)

# Libraries that a Python module can contain, too. Hidden symbols keep the code as fast as without it.
function(bem_fit_for_modules)
  set_target_properties(${ARGN} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
endfunction()
