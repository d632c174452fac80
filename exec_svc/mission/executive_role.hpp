// The role of an executive says whose robot it commands, and who answers what is addressed to none.
#pragma once

#include <string>
#include <vector>

#include "core/mission/service_list.hpp"

namespace roci::exec::mission {

/// Says which of a mission's executives a process is.
struct ExecutiveRole {
  std::string robot;  ///< robot that it commands; empty: every robot of the mission
  /// Says whether the mission has other executives beside this one (with its standby).
  bool one_of_several = false;
  /// Names the robots that one of several executives commands.
  std::vector<std::string> commanded;
  /// Says whether this one answers goals that name no robot of any executive: the team's executive does, else
  /// the first of the list, so that they are answered once.
  bool answers_strays = true;
};

/// Returns the role of the service `name` in the list; one that the list does not name is alone, with
/// `robot`.
ExecutiveRole role_of(const roci::mission::ServiceList& list, const std::string& name,
                      const std::string& robot);

/// Says who takes a goal that names a robot (empty: none).
enum class Addressee {
  this_one,
  another,
  nobody,  ///< and this executive is the one that says so
};
Addressee addressee(const ExecutiveRole& role, const std::string& robot);

}  // namespace roci::exec::mission
