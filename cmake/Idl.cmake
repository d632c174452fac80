# roci_idl(NAME idl FILES basic.idl ...): plain C++ structs by fastddsgen, generated into the build folder alone
# and included as "roci_idl/basic.h".
# They need only Fast CDR; no service sees a vendor. The PubSubTypes that fastddsgen writes beside them are compiled
# by the contract tests' native peers and by nobody else.
find_program(FASTDDSGEN fastddsgen REQUIRED)
find_package(fastcdr REQUIRED)
find_package(Python3 REQUIRED COMPONENTS Interpreter)

function(roci_idl)
  cmake_parse_arguments(IDL "" "NAME;HELP" "FILES" ${ARGN})
  set(include "${CMAKE_CURRENT_BINARY_DIR}/generated")
  set(generated "${include}/roci_idl")
  set(inputs)
  set(outputs)
  set(sources)
  foreach(file ${IDL_FILES})
    string(REGEX REPLACE "\\.idl$" "" stem "${file}")
    list(APPEND inputs "${CMAKE_CURRENT_SOURCE_DIR}/${file}")
    list(APPEND sources "${generated}/${stem}.cxx")
    list(APPEND outputs "${generated}/${stem}.cxx" "${generated}/${stem}.h"
         "${generated}/${stem}PubSubTypes.cxx" "${generated}/${stem}PubSubTypes.h")
  endforeach()
  file(MAKE_DIRECTORY "${generated}")
  add_custom_command(
    OUTPUT ${outputs}
    COMMAND "${FASTDDSGEN}" -replace -I "${CMAKE_CURRENT_SOURCE_DIR}" -d "${generated}" ${inputs}
    COMMAND Python3::Interpreter "${CMAKE_CURRENT_SOURCE_DIR}/bound_decoding.py" --generated "${generated}" ${inputs}
    DEPENDS ${inputs} "${CMAKE_CURRENT_SOURCE_DIR}/bound_decoding.py" "${CMAKE_CURRENT_SOURCE_DIR}/contract.py"
    WORKING_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}"
    COMMENT "IDL to C++: ${IDL_NAME}"
    VERBATIM)
  # The contract (docs/dds.md): a hash for each topic type, the same from the same files wherever they are built.
  set(contract "${generated}/contract.h")
  add_custom_command(
    OUTPUT "${contract}"
    COMMAND Python3::Interpreter "${CMAKE_CURRENT_SOURCE_DIR}/contract.py" --build "${PROJECT_VERSION}"
            --out "${contract}" ${inputs}
    DEPENDS ${inputs} "${CMAKE_CURRENT_SOURCE_DIR}/contract.py"
    COMMENT "IDL to contract: ${IDL_NAME}"
    VERBATIM)
  add_library(${IDL_NAME} STATIC ${sources} "${contract}")
  target_include_directories(${IDL_NAME} SYSTEM PUBLIC "$<BUILD_INTERFACE:${include}>" PRIVATE "${PROJECT_SOURCE_DIR}")
  target_link_libraries(${IDL_NAME} PUBLIC fastcdr)
  set_property(GLOBAL APPEND PROPERTY ROCI_PARTS "${IDL_NAME}: ${IDL_HELP}")
endfunction()
