// The mission view is what the ground knows of a mission: the newest of everything that came down. It
// consists of plain values, without DDS.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "ground_console/lib/repairs.hpp"
#include "roci_idl/command.h"
#include "roci_idl/executed.h"
#include "roci_idl/function.h"
#include "roci_idl/goal.h"
#include "roci_idl/health.h"
#include "roci_idl/map.h"
#include "roci_idl/motion.h"
#include "roci_idl/order.h"
#include "roci_idl/outlook.h"
#include "roci_idl/plan.h"
#include "roci_idl/standby.h"

namespace roci::console::lib {

/// Holds a position in the map frame, in metres.
struct Place {
  double x_m = 0;
  double y_m = 0;
  bool operator==(const Place&) const = default;
};

/// Keeps the newest of everything that came down; late or repeated samples never replace newer ones.
class MissionView {
 public:
  /// Late or repeated samples never replace newer ones.
  void take(const v1::MissionStatus& status);
  void take(const v1::Goal& goal);
  void take(const v1::GoalStatus& status);
  void take(const v1::Plan& plan);
  void take(const v1::ExecutedPlan& executed);
  void take(const v1::StepStatus& step);
  void take(const v1::Observation& observation);
  void take(const v1::DataProduct& product);
  void take(const v1::Event& event);
  void take(const v1::Hazard& hazard);
  void take(const v1::Heartbeat& heartbeat);
  void take(const v1::LeaseMessage& member);
  void take(const v1::Decision& decision);
  void take(const v1::OrderStatus& status);
  void take(const v1::FunctionOffer& offer);
  void take(const v1::DownlinkSchedule& schedule);
  void take(const v1::MissionOutlook& outlook);
  void take(const v1::Command& command);
  void take(const v1::CommandAck& word);
  void take(const v1::KnownMap& map);

  using GoalKey = std::pair<std::string, std::string>;  ///< issuer, id

  /// The executives that have told of themselves, by name.
  std::vector<std::string> executives() const;
  /// Chooses whose mission(), plan() and step() are seen; by default, and after an empty name, that of the first
  /// by name.
  void look_at(std::string executive) { chosen_ = std::move(executive); }
  /// Whose are seen; empty before one is known.
  std::string executive() const;

  const v1::MissionStatus* mission() const;  ///< null before the first
  const std::map<std::string, v1::MissionStatus>& missions() const { return missions_; }  ///< by executive
  /// The mission of the chosen executive, or of all where none was chosen, has an outcome, or the world has told of
  /// the end of a simulated run.
  bool ended() const;
  /// Decisions that plans have asked for, by id.
  const std::map<std::string, v1::Decision>& decisions() const { return decisions_; }
  /// The stages of an order as they came, oldest first.
  const std::vector<v1::OrderStatus>& order(const std::string& issuer, const std::string& id) const;
  const std::map<GoalKey, v1::GoalStatus>& goals() const { return goal_statuses_; }
  const v1::Goal* goal(const GoalKey& key) const;  ///< as it was asked for; null if not seen
  const v1::Plan* plan() const;                    ///< of the highest version; null before the first
  /// Has the plans of the chosen executive that have ended, by version; the newest kExecuted are kept.
  const std::map<std::uint32_t, v1::ExecutedPlan>& executed() const;
  const v1::StepStatus* step(const std::string& activity) const;
  const v1::TimelineValue* timeline(const std::string& name) const;
  const std::map<std::string, v1::Observation>& timelines() const { return observations_; }
  const std::map<std::string, v1::DataProduct>& products() const { return products_; }
  /// What owners offer, by module and owner.
  const std::map<std::pair<std::string, std::string>, v1::FunctionOffer>& offers() const { return offers_; }
  /// What planners expect of their plans, by robot.
  const std::map<std::string, v1::DownlinkSchedule>& schedules() const { return schedules_; }
  const std::map<std::string, v1::MissionOutlook>& outlooks() const { return outlooks_; }
  /// The version that the model of an owner of functions has now; 0 while it has offered nothing.
  std::uint64_t model_version(const std::string& owner) const;
  const std::map<std::string, v1::Heartbeat>& services() const { return heartbeats_; }
  /// Returns which of executive()'s pair leads in the latest epoch; null without a pair.
  const v1::LeaseMessage* leader() const;
  /// Names the executives of pairs that are heard and look for a leader in vain, while none leads; else "".
  std::string leaderless() const;
  const std::map<std::pair<std::string, std::string>, v1::Hazard>& hazards() const { return hazards_; }
  /// Where each robot was, oldest first: a robot is whatever observes its `<name>.x` and `<name>.y`, in
  /// metres. Long ways are thinned out to at most kWay places.
  const std::map<std::string, std::vector<Place>>& ways() const { return ways_; }
  /// What owners of commands repair or have repaired by themselves since this view joined, and what they repaired then.
  const std::map<Repairs::Key, Repair>& repairs() const { return repairs_.all(); }
  /// What the maps of robots have beyond the loaded one, by path planner.
  const std::map<std::string, v1::KnownMap>& maps() const { return maps_; }
  const std::deque<v1::Event>& events() const { return events_; }  ///< oldest first, at most kEvents
  std::uint64_t events_seen() const { return events_seen_; }
  /// Mission time of the newest sample seen, in microseconds.
  std::int64_t now_us() const { return now_us_; }

  /// Samples about something new that found no room (limits.hpp).
  std::uint64_t unseen() const { return unseen_; }

  static constexpr std::size_t kEvents = 1000;
  static constexpr std::size_t kWay = 2000;
  static constexpr std::size_t kExecuted = 20;

 private:
  void note_time(const v1::SampleHeader& header);
  void count(bool kept);
  void extend_way(const std::string& timeline);

  std::string chosen_;
  std::map<std::string, v1::MissionStatus> missions_;  ///< by executive
  std::map<GoalKey, v1::Goal> goals_;
  std::map<GoalKey, v1::GoalStatus> goal_statuses_;
  std::map<std::string, v1::Plan> plans_;                                      ///< by executive
  std::map<std::string, std::map<std::uint32_t, v1::ExecutedPlan>> executed_;  ///< by executive and version
  std::map<std::pair<std::string, std::string>, v1::StepStatus> steps_;        ///< by executive and activity
  std::map<std::string, v1::Observation> observations_;
  std::map<std::string, v1::DataProduct> products_;
  std::map<std::string, v1::Heartbeat> heartbeats_;
  std::map<std::pair<std::string, std::string>, v1::LeaseMessage> members_;  ///< by executive and member
  std::map<std::pair<std::string, std::string>, v1::Hazard> hazards_;        // by finder and id
  std::map<std::pair<std::string, std::string>, v1::FunctionOffer> offers_;
  std::map<std::string, v1::DownlinkSchedule> schedules_;  // by robot
  std::map<std::string, v1::MissionOutlook> outlooks_;     // by robot
  std::map<std::string, std::vector<Place>> ways_;
  std::map<std::string, v1::Decision> decisions_;
  Repairs repairs_;
  std::map<std::string, v1::KnownMap> maps_;
  std::map<GoalKey, std::vector<v1::OrderStatus>> orders_;  // by issuer and id
  std::deque<v1::Event> events_;
  std::uint64_t events_seen_ = 0;
  std::uint64_t unseen_ = 0;
  std::int64_t now_us_ = 0;
};

const char* name_of(v1::MissionPhase phase);
const char* name_of(v1::ExecutedOutcome outcome);
const char* name_of(v1::GoalState state);
const char* name_of(v1::GoalClass importance);
const char* name_of(v1::AckStage stage);  ///< "journaled", "held by both"
const char* name_of(v1::ActivityState state);
const char* name_of(v1::Severity severity);
const char* name_of(v1::ServiceState state);
const char* name_of(v1::ObstacleKind kind);  ///< "rock", "soil"
std::string value_text(const v1::TimelineValue& value);
std::string value_text(double number);
/// Who of a pair leads, in which epoch, and how far the other is behind: "first leads (epoch 3), second stands
/// by, 0 commits behind".
std::string pair_text(const v1::LeaseMessage& leader);
std::string clock_text(std::int64_t time_us);  ///< "01:23:45"

}  // namespace roci::console::lib
