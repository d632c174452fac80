# rocinante_service(NAME drill_svc SOURCES main.cpp drill.cpp [LIBRARIES ...] [FOLDER folder]): a service, twice, in FOLDER (default: where
# the build folder puts programs): the program NAME, which the launcher starts, and NAME.so, which a rehearsal loads into its one
# process. main.cpp names the service by ROCI_SERVICE_PROGRAM (services/process/service_program.hpp).
function(rocinante_service)
  cmake_parse_arguments(SERVICE "" "NAME;FOLDER" "SOURCES;LIBRARIES" ${ARGN})
  if(NOT SERVICE_NAME OR NOT SERVICE_SOURCES OR SERVICE_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "rocinante_service(NAME name SOURCES files ... [LIBRARIES ...] [FOLDER folder])")
  endif()
  if(NOT SERVICE_FOLDER)
    set(SERVICE_FOLDER "${CMAKE_CURRENT_BINARY_DIR}")
  endif()
  set(libraries ${SERVICE_LIBRARIES} rocinante::owner rocinante::process rocinante::wire rocinante::services rocinante::idl)

  add_library(${SERVICE_NAME}_objects OBJECT ${SERVICE_SOURCES})
  set_target_properties(${SERVICE_NAME}_objects PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(${SERVICE_NAME}_objects PRIVATE ${libraries})

  add_executable(${SERVICE_NAME} $<TARGET_OBJECTS:${SERVICE_NAME}_objects>)
  set_target_properties(${SERVICE_NAME} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${SERVICE_FOLDER}")
  target_link_libraries(${SERVICE_NAME} PRIVATE ${libraries})

  add_library(${SERVICE_NAME}_rehearsed MODULE $<TARGET_OBJECTS:${SERVICE_NAME}_objects>)
  set_target_properties(${SERVICE_NAME}_rehearsed PROPERTIES LIBRARY_OUTPUT_DIRECTORY "${SERVICE_FOLDER}" PREFIX ""
                                                             OUTPUT_NAME "${SERVICE_NAME}" SUFFIX ".so")
  target_link_libraries(${SERVICE_NAME}_rehearsed PRIVATE ${libraries})
endfunction()
