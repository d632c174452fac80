// A run of the simulated world ends when the executives have ended their missions, and nothing is to come.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "roci_idl/plan.h"
#include "services/clock/wall.hpp"
#include "services/node.hpp"

namespace roci::sim {

/// Decides when a run ends.
class RunEnd {
 public:
  /// Calls `end` once some executive had goals, none has open ones, `nothing_to_come` says that world and scenario are
  /// through, and that stayed so for a second of mission time, in which a goal may arrive. Where an executive has made
  /// a live robot safe, it must also stay so for some seconds of wall time: the robot may have hung, and is heard
  /// again then. The node must outlive this object.
  RunEnd(services::Node& node, std::function<bool()> nothing_to_come, std::function<void()> end);

  void note(const v1::MissionStatus&);
  /// Checks again; it is to be called whenever something that was to come has come.
  void check();

 private:
  enum class MissionState : std::uint8_t { without_goals, open, over, made_safe };

  static MissionState mission_state_of(const v1::MissionStatus&);
  bool over() const;
  bool may_be_heard_again();

  services::Node& node_;
  std::function<bool()> nothing_to_come_;
  std::function<void()> end_;
  std::map<std::string, MissionState> executives_;
  std::optional<services::Node::TimerId> farewell_;
  std::optional<services::clock::WallTime> awaited_until_;  ///< a robot that was made safe
};

}  // namespace roci::sim
