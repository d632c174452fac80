// Who may write and who may read which topic in a secure run. The permissions that roci-keys signs are made from this
// table, and a test holds it against what the services publish and subscribe (tests/unit/services/security).
#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "services/transport/scope.hpp"

namespace roci::services::security {

/// What a process does in a run. One may do several things.
enum class Role {
  service,       ///< Every process of the mission's list: it has a clock and a heartbeat.
  master,        ///< It drives the simulated clock.
  executive,     ///< It commands.
  planner,       ///< It answers the executive with plans.
  path_planner,  ///< It serves paths and the functions of traverses.
  arm_planner,   ///< It serves motions of arms and their functions.
  functions,     ///< It owns external functions of its own.
  analyst,       ///< It looks at data products and asks for goals.
  listener,      ///< It hears whatever the robot and its executive say, and says nothing but events.
  owner,         ///< It executes commands and reports what it observes.
  commander,     ///< It commands subsystems on behalf of an executive, beside being an owner.
  world,         ///< It plays the ground's script beside being an owner: the simulator.
  resolver,      ///< It answers decisions of running plans.
  launcher,      ///< It watches a run.
  console,       ///< It watches a run, and speaks for the ground.
};

/// The word of mission.yaml's `rights:` for a role, and back.
std::string_view word_of(Role);
std::optional<Role> role_of(std::string_view word);

struct TopicRights {
  std::string topic;
  transport::Scope scope;
  std::set<Role> writers;
  std::set<Role> readers;
};

/// A row for each topic of services/topics/topics.hpp.
std::span<const TopicRights> topic_rights();

/// What a program of ours does in a run; empty for a program that is not ours.
std::set<Role> roles_of_program(std::string_view program);

/// The topics of a scope that somebody with these roles may write (or read), in the order of the table.
std::vector<std::string> writable(const std::set<Role>&, transport::Scope);
std::vector<std::string> readable(const std::set<Role>&, transport::Scope);

}  // namespace roci::services::security
