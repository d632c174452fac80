# The catalogue: every part of the house is declared by one of these calls, with its sources by name.
#
#   roci_library(NAME core_pddl HELP "..." SOURCES a.cpp b.cpp DEPENDS core_x PRIVATE_DEPENDS yaml-cpp)
#   roci_program(NAME roci-plan HELP "..." SOURCES main.cpp DEPENDS planner_temporal_pddl)      installed to bin/, unless NOT_INSTALLED
#     ROLES executive: what it may write and read in a secure run (cmake/ProgramRoles.cmake); without, rights of a mission's list say so
#   roci_plugin (NAME roci_transport_inproc HELP "..." SOURCES ... DEPENDS ...)        installed to lib/rocinante/
#   roci_test_library(NAME scenario_flight HELP "..." SOURCES flight.cpp DEPENDS ...)   what tests of one folder share
#   roci_test   (NAME unit_pddl SOURCES parser_test.cpp DEPENDS core_pddl [LABEL contract] [SERIAL | PROCESSORS 2] [OPTIMIZED] [WHOLE])
#     SERIAL: alone, since a second beside it would change what it is about; PROCESSORS 2: beside one other, since it computes on both or is about
#     who is late. A flight that waits for its pace needs neither (CONTRIBUTING.md)
#     OPTIMIZED: its own code is a long search (an oracle, an explorer, a fuzzer); others are compiled without, which takes a quarter less time
#     WHOLE: all its cases are one test, since they look at one flight from several sides
#
# Release builds compile many sources of a part at once (CMake's unity build, CMakePresets.json), which takes a third of the time. Two sources
# that give one name to two private things cannot be compiled so: give them two names, or list one of them under ALONE.
#
# What of the standard library nearly every part includes is compiled once, ahead of the others, and so are googletest and JSON for the tests; builds
# without that (preset dev, and those of ./check --full) show that each source includes what it uses.
#
# A part that is COLD does little but start, tell and end: its compile time counts for more than its speed. A folder that is compiled with other
# than -O2 says so: roci_optimize(-O3).
#
# Headers are included from the top of the tree: #include "core/pddl/parser.hpp".

set_property(GLOBAL PROPERTY ROCI_PARTS "")

# Everything that ./run needs: programs and plug-ins, no tests.
add_custom_target(programs)

find_package(GTest REQUIRED)
find_package(nlohmann_json REQUIRED)
include(GoogleTest)
include(ProgramRoles)

add_library(roci_program_roles INTERFACE)  # holds them until all programs are declared

set(standard_headers <algorithm> <array> <chrono> <cmath> <filesystem> <fstream> <functional> <map> <memory> <optional> <set> <span> <sstream> <string>
                     <unordered_map> <vector>)

# What a folder and those below it are compiled with in release builds.
macro(roci_optimize level)
  set(roci_optimization ${level})
  add_compile_options($<$<CONFIG:Release>:${level}>)
endmacro()

set(roci_optimization -O2)
file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/headers.cpp" CONTENT "")
foreach(optimization -O0 -O1 -O2 -O3)
  add_library(roci_headers${optimization} STATIC "${PROJECT_BINARY_DIR}/headers.cpp")
  target_link_libraries(roci_headers${optimization} PRIVATE roci_warnings)
  target_precompile_headers(roci_headers${optimization} PRIVATE ${standard_headers} <variant> <string_view> <utility>)
  target_compile_options(roci_headers${optimization} PRIVATE $<$<CONFIG:Release>:${optimization}>)
endforeach()

file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/test_headers.cpp" CONTENT "int main() {}\n")
function(_roci_test_headers target optimization)
  add_executable(${target} "${PROJECT_BINARY_DIR}/test_headers.cpp")
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/tests")
  target_link_libraries(${target} PRIVATE GTest::gtest GTest::gmock json_instances roci_warnings)
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}")
  target_precompile_headers(${target} PRIVATE ${standard_headers} <gmock/gmock.h> <gtest/gtest.h> <tests/json_instances.hpp>)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${optimization}>)
endfunction()
add_library(json_instances STATIC "${PROJECT_SOURCE_DIR}/tests/json_instances.cpp")
target_include_directories(json_instances PRIVATE "${PROJECT_SOURCE_DIR}")
target_link_libraries(json_instances PUBLIC nlohmann_json::nlohmann_json)
_roci_test_headers(roci_test_headers -O0)
_roci_test_headers(roci_optimized_test_headers -O1)

function(_roci_part target)
  cmake_parse_arguments(PART "COLD;NOT_INSTALLED;LIBRARY" "NAME;HELP" "SOURCES;DEPENDS;PRIVATE_DEPENDS;ALONE;ROLES" ${ARGN})
  set_source_files_properties(${PART_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  if(NOT PART_HELP)
    message(FATAL_ERROR "${target}: every part says in HELP what it is for")
  endif()
  set_property(GLOBAL APPEND PROPERTY ROCI_PARTS "${target}: ${PART_HELP}")
  target_include_directories(${target} PUBLIC "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>")
  # What is headers alone is compiled in; who links an installed library does not need it.
  list(TRANSFORM PART_PRIVATE_DEPENDS REPLACE "^(CLI11::CLI11|nlohmann_json::nlohmann_json|spdlog::spdlog_header_only)$"
                                              "$<BUILD_INTERFACE:\\1>")
  target_link_libraries(${target} PUBLIC ${PART_DEPENDS} PRIVATE ${PART_PRIVATE_DEPENDS} $<BUILD_INTERFACE:roci_warnings>)
  if(PART_COLD)
    set(roci_optimization -O1)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
  if(PART_LIBRARY)
    target_precompile_headers(${target} REUSE_FROM roci_headers${roci_optimization})
    if(roci_optimization STREQUAL -O3)
      # With precompiled headers GCC 12 at -O3 tells boundless copies in "text" + std::string, too, that are none (GCC bug 105329).
      target_compile_options(${target} PRIVATE $<$<AND:$<CXX_COMPILER_ID:GNU>,$<CONFIG:Release>>:-Wno-stringop-overflow;-Wno-array-bounds>)
    endif()
  endif()
endfunction()

function(roci_library)
  cmake_parse_arguments(PART "COLD" "NAME;HELP" "SOURCES;DEPENDS;PRIVATE_DEPENDS;ALONE" ${ARGN})
  add_library(${PART_NAME} STATIC ${PART_SOURCES})
  _roci_part(${PART_NAME} LIBRARY ${ARGN})
endfunction()

function(roci_program)
  cmake_parse_arguments(PART "COLD;NOT_INSTALLED" "NAME;HELP" "SOURCES;DEPENDS;PRIVATE_DEPENDS;ALONE;ROLES" ${ARGN})
  add_executable(${PART_NAME} ${PART_SOURCES})
  _roci_part(${PART_NAME} ${ARGN})
  if(PART_ROLES)
    roci_note_roles(${PART_NAME} ${PART_ROLES})
  endif()
  # A command line is read once; optimizing that takes the compiler longer than anything else.
  list(FILTER PART_SOURCES INCLUDE REGEX "main\\.cpp$")
  set_source_files_properties(${PART_SOURCES} PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release>:-O1>")
  add_dependencies(programs ${PART_NAME})
  if(NOT PART_NOT_INSTALLED)
    install(TARGETS ${PART_NAME} RUNTIME DESTINATION bin)
  endif()
endfunction()

function(roci_plugin)
  cmake_parse_arguments(PART "" "NAME;HELP" "SOURCES;DEPENDS;PRIVATE_DEPENDS;ALONE" ${ARGN})
  add_library(${PART_NAME} MODULE ${PART_SOURCES})
  _roci_part(${PART_NAME} ${ARGN})
  set_target_properties(${PART_NAME} PROPERTIES
    LIBRARY_OUTPUT_DIRECTORY "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}/rocinante")
  add_dependencies(programs ${PART_NAME})
  install(TARGETS ${PART_NAME} LIBRARY DESTINATION lib/rocinante)
endfunction()

# What tests of one folder share, compiled once and as they are.
function(roci_test_library)
  cmake_parse_arguments(PART "" "NAME;HELP" "SOURCES;DEPENDS;ALONE" ${ARGN})
  add_library(${PART_NAME} STATIC ${PART_SOURCES})
  _roci_part(${PART_NAME} ${ARGN})
  _roci_test_part(${PART_NAME} FALSE)
  target_compile_options(${PART_NAME} PRIVATE -fPIE)  # as programs are, for which the headers were compiled
endfunction()

function(_roci_test_part target optimized)
  if(optimized)
    target_precompile_headers(${target} REUSE_FROM roci_optimized_test_headers)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  else()
    target_precompile_headers(${target} REUSE_FROM roci_test_headers)
  endif()
  target_compile_definitions(${target} PRIVATE ROCI_SOURCE_DIR="${PROJECT_SOURCE_DIR}" ROCI_BINARY_DIR="${PROJECT_BINARY_DIR}")
  target_link_libraries(${target} PRIVATE GTest::gtest GTest::gmock json_instances roci_warnings)
endfunction()

function(roci_test)
  cmake_parse_arguments(PART "SERIAL;OPTIMIZED;WHOLE" "NAME;HELP;LABEL;PROCESSORS" "SOURCES;DEPENDS;ALONE" ${ARGN})
  set_source_files_properties(${PART_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  add_executable(${PART_NAME} ${PART_SOURCES})
  set_target_properties(${PART_NAME} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/tests")
  target_include_directories(${PART_NAME} PRIVATE "${PROJECT_SOURCE_DIR}")
  target_link_libraries(${PART_NAME} PRIVATE ${PART_DEPENDS} GTest::gtest_main)
  _roci_test_part(${PART_NAME} ${PART_OPTIMIZED})
  if(NOT PART_LABEL)
    set(PART_LABEL unit)
  endif()
  set(properties LABELS ${PART_LABEL} TIMEOUT 300)  # one: gtest_discover_tests keeps no lists
  # Where no run has told yet how long each takes, flights begin first, those that need two processors before the others: no long one is left over.
  if(PART_PROCESSORS)
    list(APPEND properties COST 20)
  elseif(PART_LABEL STREQUAL "scenario")
    list(APPEND properties COST 10)
  endif()
  if(PART_SERIAL)
    list(APPEND properties RUN_SERIAL TRUE)
  endif()
  if(PART_PROCESSORS)
    list(APPEND properties PROCESSORS ${PART_PROCESSORS})
  endif()
  if(PART_WHOLE)
    add_test(NAME ${PART_NAME} COMMAND ${PART_NAME})
    set_tests_properties(${PART_NAME} PROPERTIES ${properties})
  else()
    # CTest merges the labels of tests of one name. Of two programs with the same sources, one of which is for ./check --full alone, it would
    # leave both out of ./check.
    set(prefix "")
    if(PART_LABEL STREQUAL "full")
      set(prefix "full/")
    endif()
    gtest_discover_tests(${PART_NAME} NO_PRETTY_VALUES DISCOVERY_MODE PRE_TEST TEST_PREFIX "${prefix}" PROPERTIES ${properties})
  endif()
endfunction()
