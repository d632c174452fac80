// What a node is told when it is made.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "services/clock/clock_mode.hpp"
#include "services/link/link_table.hpp"

namespace roci::services::node {

/// The settings of the simulated clock's master.
struct MasterOptions {
  std::vector<std::string> roster;  ///< Services that must be ready before time 0, this one included.
  double pace = 0;                  ///< Simulated seconds per wall second; 0: as fast as possible.
  double hang_limit_s = 60;         ///< Wall time after which a participant without progress counts as dead.
  double restart_hold_s = 0;  ///< Wall time for which mission time waits for a killed service to return.
};

struct NodeOptions {
  std::string name;       ///< The logical sender, unique in the run, e.g. "arm_svc".
  std::string run{};      ///< Identity of the run; an observer without one joins the first run that it hears.
  std::string mission{};  ///< The mission's name.
  std::string robot{};    ///< That the service belongs to; empty: the team, the ground or the world.
  /// Says whether nobody else of the run may have this name; the members of a pair of executives may, for a while.
  bool sole = true;
  std::uint32_t incarnation = 1;  ///< How often this service was started in this run, from 1.
  clock::ClockMode clock = clock::ClockMode::live;
  double live_scale = 1;           ///< Live: mission seconds per wall second.
  std::int64_t epoch_unix_us = 0;  ///< Live: mission time 0, the same for all services of a run.
  double live_hang_limit_s = 5;    ///< Live: a service without a heartbeat for this long counts as hung.
  MasterOptions master;
  std::string vendor = "fastdds";  ///< Reported in the heartbeat.
  link::LinkTable links{};         ///< Of the scenario: what comes over one is lost or late as it says.
};

}  // namespace roci::services::node
