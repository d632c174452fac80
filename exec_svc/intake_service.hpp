/// The door to the reactor: what comes from the wire is let in as long as the tables that keep
/// it have room (limits.hpp).
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "exec_svc/mission/mission_model.hpp"
#include "exec_svc/reactor/reactor.hpp"
#include "services/bounds/tally.hpp"

namespace roci::exec {

/// What is known already always passes, so that a full table holds up nobody who is in it. Each refusal is an event
/// with a code of its own, "goal.no_room" and so on, the first time and each time that there are ten times as many.
class Intake {
 public:
  using Report = std::function<void(const reactor::Event&)>;

  /// Mission and reactor outlive this. Knows what the reactor knows when it is made, and what it has let in since.
  Intake(const mission::MissionModel&, const reactor::Reactor&, Report);

  /// `waiting`: those that were let in and that the reactor has not seen yet.
  bool admits(const goals::GoalRequest&, const std::vector<goals::GoalRequest>& waiting, temporal::Time now);
  bool admits(const orders::Order&);
  bool admits(const reactor::GivenAnswer&);
  bool admits(const executive::Observation&);
  bool admits(const reactor::ModelVersion&);

  /// Reports an event about a bad sample: by its code, the first one, the tenth, the hundredth and so on.
  void tell(reactor::Event);

 private:
  /// Lets a name in if it is known or there is room.
  bool enter(std::set<std::string>& known, const std::string& name, std::size_t room, const char* code,
             const char* what);
  bool refuse(const char* code, const std::string& text);
  /// Whether there is room for one more goal of its fate, found with a copy of the reactor's goals.
  bool has_room_for(const goals::GoalRequest&, const std::vector<goals::GoalRequest>& waiting,
                    temporal::Time now);
  /// Whether the mission's own data speak of the timeline.
  bool is_of_mission(const std::string& timeline) const;

  const mission::MissionModel* mission_;
  const reactor::Reactor* reactor_;
  Report report_;
  services::bounds::Tally tally_;
  std::optional<goals::GoalSet> sieve_;  // a copy of the reactor's goals, with those that came since
  std::size_t sieved_ = 0;               // since it was copied
  std::size_t rejected_ = 0;             // of it
  std::set<std::string> goals_, orders_, answers_, timelines_, foreign_timelines_, owners_;
};

}  // namespace roci::exec
