# The SDK: what a program of somebody else needs to take part, installed beside the programs (docs/sdk.md).
#
#   find_package(rocinante) gives   rocinante::services, ::process, ::owner, ::wire, ::idl and what they stand on
#                                   rocinante_service(...)   a service, for launcher and rehearsal (rocinante-service.cmake)
#                                   rocinante_IDL_DIR        the IDL, with contract.h: all that a participant on a vendor's own API needs
include(CMakePackageConfigHelpers)

set(sdk_doors services services_process services_command_server services_wire idl)

# The static libraries behind a target, itself included.
function(_roci_closure target found)
  set(all ${${found}})
  if(target IN_LIST all)
    return()
  endif()
  list(APPEND all ${target})
  get_target_property(links ${target} LINK_LIBRARIES)
  foreach(link IN LISTS links)
    if(TARGET ${link})
      get_target_property(type ${link} TYPE)
      get_target_property(imported ${link} IMPORTED)
      if(type STREQUAL STATIC_LIBRARY AND NOT imported)
        _roci_closure(${link} all)
      endif()
    endif()
  endforeach()
  set(${found} ${all} PARENT_SCOPE)
endfunction()

set(sdk_libraries)
foreach(door IN LISTS sdk_doors)
  _roci_closure(${door} sdk_libraries)
endforeach()
foreach(library IN LISTS sdk_libraries)
  target_include_directories(${library} INTERFACE "$<INSTALL_INTERFACE:include/rocinante>")
  target_compile_features(${library} INTERFACE cxx_std_20)
endforeach()
set_target_properties(services_process PROPERTIES EXPORT_NAME process)
set_target_properties(services_command_server PROPERTIES EXPORT_NAME owner)
set_target_properties(services_wire PROPERTIES EXPORT_NAME wire)
add_dependencies(programs ${sdk_doors})

install(TARGETS ${sdk_libraries} EXPORT rocinante ARCHIVE DESTINATION lib/rocinante/sdk)
set(sdk_cmake lib/cmake/rocinante)
install(EXPORT rocinante NAMESPACE rocinante:: DESTINATION ${sdk_cmake} FILE rocinante-targets.cmake)
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/sdk/rocinante-config.cmake.in"
                              "${PROJECT_BINARY_DIR}/rocinante-config.cmake" INSTALL_DESTINATION ${sdk_cmake})
write_basic_package_version_file("${PROJECT_BINARY_DIR}/rocinante-config-version.cmake" COMPATIBILITY ExactVersion)
install(FILES "${PROJECT_BINARY_DIR}/rocinante-config.cmake" "${PROJECT_BINARY_DIR}/rocinante-config-version.cmake"
              cmake/sdk/rocinante-service.cmake
        DESTINATION ${sdk_cmake})

install(DIRECTORY services DESTINATION include/rocinante FILES_MATCHING PATTERN "*.hpp" PATTERN "services/vendors" EXCLUDE
        PATTERN "services/launch" EXCLUDE PATTERN "services/systemd" EXCLUDE)
install(DIRECTORY core/temporal core/mission DESTINATION include/rocinante/core FILES_MATCHING PATTERN "*.hpp")
set(generated "${PROJECT_BINARY_DIR}/idl/generated/roci_idl")
install(DIRECTORY "${generated}" DESTINATION include/rocinante FILES_MATCHING PATTERN "*.h" PATTERN "*PubSubTypes.h" EXCLUDE)
install(DIRECTORY idl/ DESTINATION share/rocinante/idl FILES_MATCHING PATTERN "*.idl")
install(FILES "${generated}/contract.h" DESTINATION share/rocinante/idl)
install(DIRECTORY example_service DESTINATION share/rocinante)
