// These options are what a node is told when it is made.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "services/clock/clock_mode.hpp"
#include "services/link/link_table.hpp"

namespace roci::services::node {

/// Holds the settings of the simulated clock's master.
struct MasterOptions {
  std::vector<std::string> roster;  ///< services that must be ready before time 0, this one included
  double pace = 0;                  ///< simulated seconds per wall second; 0: as fast as possible
  double hang_limit_s = 60;         ///< wall time after which a participant without progress counts as dead
  double restart_hold_s = 0;        ///< wall time for which mission time waits for a killed service to return
};

/// Says who a node is, which run it belongs to, and which clock it follows.
struct NodeOptions {
  std::string name;       ///< the logical sender, unique in the run, e.g. "arm_svc"
  std::string run{};      ///< identity of the run; an observer without one joins the first run that it hears
  std::string mission{};  ///< the mission's name
  std::string robot{};    ///< robot that the service belongs to; empty: the team, the ground or the world
  /// Says whether no other process of the run may have this name; the members of a pair of executives may, for a
  /// while.
  bool sole = true;
  std::uint32_t incarnation = 1;  ///< how often this service was started in this run, from 1
  clock::ClockMode clock = clock::ClockMode::live;
  double live_scale = 1;           ///< live: mission seconds per wall second
  std::int64_t epoch_unix_us = 0;  ///< live: mission time 0, the same for all services of a run
  double live_hang_limit_s = 5;    ///< live: a service without a heartbeat for this long counts as hung
  MasterOptions master;
  std::string vendor = "fastdds";  ///< reported in the heartbeat
  link::LinkTable links{};  ///< the scenario's: what comes over a link is lost or late as the link says
};

}  // namespace roci::services::node
