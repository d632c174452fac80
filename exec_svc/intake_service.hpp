// The intake admits what comes from the wire as long as the tables that keep it have room (limits.hpp).
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

/// Decides what is let in. A key that is known always passes, so a full table blocks none of its own entries. Each
/// kind of refusal has an event of its own, e.g. "goal.no_room", reported the first, tenth, hundredth time and so
/// on.
class Intake {
 public:
  using Report = std::function<void(const reactor::Event&)>;

  /// Starts with what the reactor knows now, and adds what is let in from then on. Mission and reactor must
  /// outlive this object.
  Intake(const mission::MissionModel&, const reactor::Reactor&, Report);

  /// Returns whether there is room. `waiting` are the requests that were let in and that the reactor has not
  /// seen yet.
  bool admits(const goals::GoalRequest&, const std::vector<goals::GoalRequest>& waiting, temporal::Time now);
  bool admits(const orders::Order&);
  bool admits(const reactor::GivenAnswer&);
  bool admits_timeline(const std::string& timeline);
  bool admits(const reactor::ModelVersion&);

  /// Reports an event about a bad sample, of each code the first one, the tenth, the hundredth and so on.
  void tell(reactor::Event);

 private:
  /// Lets a name in if it is known or there is room.
  bool enter(std::set<std::string>& known, const std::string& name, std::size_t room, const char* code,
             const char* what);
  bool refuse(const char* code, const std::string& text);
  /// Returns whether the goal finds room among the accepted or the rejected ones, as a trial on a copy of the
  /// reactor's goals tells.
  bool has_room_for(const goals::GoalRequest&, const std::vector<goals::GoalRequest>& waiting,
                    temporal::Time now);
  /// Returns whether the mission's own data mention the timeline.
  bool is_of_mission(const std::string& timeline) const;

  const mission::MissionModel* mission_;
  const reactor::Reactor* reactor_;
  Report report_;
  services::bounds::Tally tally_;
  std::optional<goals::GoalSet> sieve_;  // copy of the reactor's goals, with those that came since
  std::size_t sieved_ = 0;               // goals that came since it was copied
  std::size_t rejected_ = 0;             // rejected goals in it
  std::set<std::string> goals_, orders_, answers_, timelines_, foreign_timelines_, owners_;
};

}  // namespace roci::exec
