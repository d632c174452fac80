# Compiler, warnings, sanitizers, output folders: the settings that hold for every part.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib")
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib/static")

# Where plans are searched for, -O3 is worth its compile time (planner_svc/CMakeLists.txt); elsewhere -O2 is as fast.
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")

# GCC begins to collect its garbage at 128 MB; a part compiled at once takes several times that, and is done 8 % earlier if GCC waits.
cmake_host_system_information(RESULT memory_mib QUERY TOTAL_PHYSICAL_MEMORY)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND memory_mib GREATER 7000)
  add_compile_options(--param=ggc-min-heapsize=524288)
endif()

# Continuous integration turns this on through its environment (.ci/run).
set(werror OFF)
if(DEFINED ENV{ROCI_WERROR})
  set(werror "$ENV{ROCI_WERROR}")
endif()
option(ROCI_WERROR "Treat warnings as errors" ${werror})
set(ROCI_SANITIZE "" CACHE STRING "Sanitizers, as for -fsanitize= (empty: none)")

find_program(ROCI_CCACHE ccache)
if(ROCI_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_C_COMPILER_LAUNCHER "${ROCI_CCACHE}")
  # What ccache asks for with precompiled headers.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros "${ROCI_CCACHE}")
  add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fpch-preprocess>)
endif()

# Warnings are for our code; generated code is compiled without them (see Idl.cmake).
add_library(roci_warnings INTERFACE)
target_compile_options(roci_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow
                                               $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor>
                                               $<$<BOOL:${ROCI_WERROR}>:-Werror>)
# GCC 12 sees overlapping copies in "text" + std::string at -O3 that are none (GCC bug 105651).
target_compile_options(roci_warnings INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)

if(ROCI_SANITIZE)
  add_compile_options(-fsanitize=${ROCI_SANITIZE} -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${ROCI_SANITIZE})
endif()
