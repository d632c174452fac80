// This table has the roles of the programs that are built here, as each program's declaration names them.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>

#include "services/security/topic_rights.hpp"

namespace roci::services::security {

/// Maps each program that was declared with ROLES (cmake/ProgramRoles.cmake, which makes the source) to these.
const std::map<std::string, std::set<Role>, std::less<>>& program_roles();

}  // namespace roci::services::security
