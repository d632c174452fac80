#include "exec_svc/mission/executive_role.hpp"

#include <algorithm>

namespace roci::exec::mission {

using roci::mission::ServiceEntry;
using roci::mission::ServiceList;

ExecutiveRole role_of(const ServiceList& list, const std::string& name, const std::string& robot) {
  ExecutiveRole role;
  role.robot = robot;
  const ServiceEntry* own = list.find(name);
  if (own == nullptr) return role;
  role.robot = own->robot;
  const auto executives = list.of_program(own->program);
  if (executives.size() == 1) return role;
  role.one_of_several = true;
  const auto team = std::ranges::find_if(executives, [](const auto* one) { return one->robot.empty(); });
  role.answers_strays = own == (team == executives.end() ? executives.front() : *team);
  for (const ServiceEntry* executive : executives)
    if (!executive->robot.empty()) role.commanded.push_back(executive->robot);
  std::ranges::sort(role.commanded);
  return role;
}

Addressee addressee(const ExecutiveRole& role, const std::string& robot) {
  if (!role.one_of_several) {
    const bool fits = robot.empty() || role.robot.empty() || robot == role.robot;
    return fits ? Addressee::this_one : Addressee::nobody;
  }
  if (!robot.empty() && robot == role.robot) return Addressee::this_one;
  if (std::ranges::find(role.commanded, robot) != role.commanded.end() || !role.answers_strays)
    return Addressee::another;
  const bool of_the_team = role.robot.empty() && !robot.empty();
  return of_the_team ? Addressee::this_one : Addressee::nobody;
}

}  // namespace roci::exec::mission
