# What each program of ours may do in a secure run is a word of its declaration: roci_program(NAME x ... ROLES owner commander). The words are those
# of the enumeration Role in services/security/topic_rights.hpp.

# Stops unless each role that the program's declaration names is one of the enumeration.
function(roci_check_roles program)
  set(header "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../services/security/topic_rights.hpp")
  file(READ "${header}" text)
  string(REGEX MATCH "enum class Role {[^}]*}" text "${text}")
  string(REGEX MATCHALL "\n  [a-z_]+," words "${text}")
  list(TRANSFORM words REPLACE "[^a-z_]" "")
  foreach(role ${ARGN})
    if(NOT role IN_LIST words)
      list(JOIN words " " words)
      message(FATAL_ERROR "${program}: ROLES names ${role}, which is no role; there are ${words} (services/security/topic_rights.hpp)")
    endif()
  endforeach()
endfunction()

# Notes the roles of a program. The source of roci_generate_program_roles() has them wherever that is called, since CMake writes it last.
function(roci_note_roles program)
  roci_check_roles(${program} ${ARGN})
  set(roles ${ARGN})
  list(TRANSFORM roles PREPEND "Role::")
  list(JOIN roles ", " roles)
  set_property(TARGET roci_program_roles APPEND PROPERTY ROCI_ROWS "    {\"${program}\", {${roles}}}")
endfunction()

# Writes the source that has the roles of all programs.
function(roci_generate_program_roles output)
  file(GENERATE OUTPUT "${output}" CONTENT "// Made of the declarations of the programs (cmake/ProgramRoles.cmake).
#include \"services/security/program_roles.hpp\"

namespace roci::services::security {

const std::map<std::string, std::set<Role>, std::less<>>& program_roles() {
  static const std::map<std::string, std::set<Role>, std::less<>> table{
$<JOIN:$<TARGET_PROPERTY:roci_program_roles,ROCI_ROWS>,$<COMMA>\n>};
  return table;
}

}  // namespace roci::services::security
")
endfunction()
