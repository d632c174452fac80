// This table says who may write and who may read which topic in a secure run. The permissions that roci-keys signs
// are made from it, and a test compares it with what the services publish and subscribe
// (tests/unit/services/security).
#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "services/transport/scope.hpp"

namespace roci::services::security {

/// Says what a process does in a run; one process may have several roles.
enum class Role {
  service,       ///< every process of the mission's list: it has a clock and a heartbeat
  master,        ///< drives the simulated clock
  executive,     ///< commands
  planner,       ///< answers the executive with plans
  path_planner,  ///< serves paths and the functions of traverses
  arm_planner,   ///< serves motions of arms and their functions
  functions,     ///< owns external functions of its own
  analyst,       ///< looks at data products and asks for goals
  listener,      ///< hears whatever the robot and its executive say, and says nothing but events
  owner,         ///< executes commands and reports what it observes
  commander,     ///< commands subsystems on behalf of an executive, beside being an owner
  world,         ///< plays the ground's script beside being an owner: the simulator
  resolver,      ///< answers decisions of running plans
  launcher,      ///< watches a run
  console,       ///< watches a run, and speaks for the ground
};

/// Translate between a role and its word in mission.yaml's `rights:`.
std::string_view word_of(Role);
std::optional<Role> role_of(std::string_view word);

/// Says which roles may write and read a topic.
struct TopicRights {
  std::string topic;
  transport::Scope scope;
  std::set<Role> writers;
  std::set<Role> readers;
};

/// A row for each topic of services/topics/topics.hpp.
std::span<const TopicRights> topic_rights();

/// Returns what a program does in a run: `service`, and the ROLES of its declaration (cmake/ProgramRoles.cmake). A
/// program that was declared without, or is not built here, has none: `rights` of the mission's list name its roles.
std::set<Role> roles_of_program(std::string_view program);

/// Return the topics of a scope that these roles may write or read, in the order of the table.
std::vector<std::string> writable(const std::set<Role>&, transport::Scope);
std::vector<std::string> readable(const std::set<Role>&, transport::Scope);

}  // namespace roci::services::security
