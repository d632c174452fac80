// A checked mission is a mission as far as it could be read, which the checks examine.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/mission/findings.hpp"
#include "core/mission/service_list.hpp"
#include "exec_svc/mission/mission_model.hpp"
#include "rehearsal/check/simulated_world.hpp"

namespace roci::rehearsal::check {

/// A scenario that could be read, with all that a run of it needs.
struct CheckedScenario {
  std::string name;
  mission::Entry file;
  sim::scenario::RunSetup run;
  bool sound = false;  ///< nothing was found while it was read
};

/// An executive of the mission, by the mission file that it reads.
struct CheckedExecutive {
  std::string service;
  mission::Entry file;
  exec::mission::MissionModel model;
  /// What plans of the model tell of, where its engine says so (planner::engine::TableEntry::check_model).
  std::optional<std::vector<std::string>> planned_timelines{};
};

/// Holds a mission as far as it could be read.
struct CheckedMission {
  std::filesystem::path folder;
  mission::Entry file;  ///< mission.yaml
  mission::ServiceList services;
  SimulatedWorld world;
  std::vector<CheckedScenario> scenarios;
  std::vector<CheckedExecutive> executives;
  /// Whether all programs of the mission are linked here, so that what nobody of them knows does not exist.
  bool closed = false;

  /// Timelines of the windows that the mission predicts.
  std::vector<std::string> windows() const;
};

/// The names of timelines that an executive may speak of.
class KnownTimelines {
 public:
  KnownTimelines(const CheckedMission& mission, const CheckedExecutive& executive);

  /// Complains at `entry` if nobody tells of this timeline. `text` may be a template, with a slot for the name of a
  /// thing or a robot. Where the mission has programs that are not linked here, which may tell of anything, only
  /// a name that is nearly a known one is complained of.
  void require(const mission::Entry& entry, const std::string& text) const;

 private:
  const CheckedMission& mission_;
  std::string robot_;
  /// Whether all timelines are known: an engine may have some of its own of which it does not say.
  bool closed_ = false;
  std::vector<std::string> names_;
  std::vector<std::string> prefixes_;
};

/// Complains at `entry` if the timeline is a simulated component's or family's, and the state none of its own.
void require_state(const mission::Entry& entry, const SimulatedWorld& world, const std::string& timeline,
                   const std::string& state);

}  // namespace roci::rehearsal::check
