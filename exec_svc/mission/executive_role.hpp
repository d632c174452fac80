/// Which of a mission's executives a process is: whose robot it commands, and who answers what is addressed to
/// none.
#pragma once

#include <string>
#include <vector>

#include "core/mission/service_list.hpp"

namespace roci::exec::mission {

struct ExecutiveRole {
  std::string robot;  ///< that it commands; empty: every robot of the mission
  /// Whether the mission has other executives beside this one (with its standby).
  bool one_of_several = false;
  /// Names the robots that one of several executives commands.
  std::vector<std::string> commanded;
  /// Whether this one answers goals that name no robot of any executive: the team's executive does, else the
  /// first of the list, so that they are answered once.
  bool answers_strays = true;
};

/// The role of the service `name` in the list; of one that the list does not name: alone, with `robot`.
ExecutiveRole role_of(const roci::mission::ServiceList& list, const std::string& name,
                      const std::string& robot);

/// Who takes a goal that names this robot (empty: none).
enum class Addressee {
  this_one,
  another,
  nobody,  ///< and this executive is the one that says so
};
Addressee addressee(const ExecutiveRole& role, const std::string& robot);

}  // namespace roci::exec::mission
