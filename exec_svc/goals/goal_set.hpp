// The goal set keeps the goals of a mission: what was asked, by whom, in which order, and what became of
// each.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/temporal/duration.hpp"
#include "core/temporal/rank_vector.hpp"
#include "exec_svc/mission/mission_model.hpp"

namespace roci::exec::goals {

/// Says how much a goal matters; it decides which goal goes first when not all fit (R52, R53).
enum class GoalClass { hard, optional, opportunistic };

/// Says how far a goal has come; all but pending and planned are final (is_final()).
enum class GoalState { rejected, pending, planned, achieved, dropped, failed, recalled };

/// Names a goal for good: who asks for it, and the id that the issuer chose.
struct GoalKey {
  std::string issuer;
  std::string id;
  auto operator<=>(const GoalKey&) const = default;
  std::string text() const { return issuer + "/" + id; }
};

/// Says which of its sender's samples brought a request; samples are numbered anew in each start of a sender.
struct SampleId {
  std::string sender;
  std::uint32_t incarnation = 0;  ///< 0: a console
  std::uint64_t number = 0;
  bool operator==(const SampleId&) const = default;
};

/// Holds a goal as its issuer asked for it. Times are mission times.
struct GoalRequest {
  GoalKey key;
  std::string robot;  ///< robot that is to achieve it; empty: the executive's
  std::string kind;
  std::map<std::string, std::string> arguments;
  GoalClass importance = GoalClass::hard;
  temporal::RankVector utility;
  std::int32_t priority = 0;
  temporal::Time preferred = temporal::no_bound;  ///< time at which it is best achieved; no_bound: none
  temporal::Time opens{0};                        ///< 0: any time
  temporal::Time closes{0};                       ///< 0: never
  bool recalled = false;
  SampleId sample;
  bool operator==(const GoalRequest&) const = default;
};

/// Returns whether both ask for the same, whoever asks and however often.
bool same_request(const GoalRequest&, const GoalRequest&);

/// Returns whether a console asks, where somebody reads the answer; services only pass on what a scenario
/// says.
bool from_console(const GoalRequest&);

/// Returns the values that fill the templates of the goal's kind: its arguments, its id and its robot.
std::map<std::string, std::string> template_values(const GoalRequest& goal);

/// Holds all that the executive knows of a goal: the request, how far it has come, and why.
struct GoalRecord {
  GoalRequest request;
  GoalState state = GoalState::pending;
  std::string reason;
  std::uint64_t arrival = 0;  ///< rises with each goal
  std::uint32_t plan_version = 0;
  SampleId answers;  ///< the newest request of this key, also one that was refused or changed nothing
  std::uint32_t revision = 0;  ///< rises with each change and recall that is taken
  /// Lists the newest request of each other sender before `answers`, oldest first. A sender's newest sample stays on
  /// the topic, so an executive that is restarted, takes over or was cut off hears it again, after one that came later.
  std::vector<SampleId> before;
};

/// Notes that this sample of the goal was heard before the one that the record answers; the newest 16 are kept.
void note_before(GoalRecord& record, const SampleId& sample);

/// Says who holds what is acknowledged: this executive alone, or both of a pair. It has the order of AckStage in
/// idl/goal.idl.
enum class AckStage { journaled, held_by_both };

bool is_final(GoalState state);

/// Of goals that are worth the same, the one with the lower priority leaves first, of equal priority the newer one.
bool leaves_first(const GoalRecord& one, const GoalRecord& other);

/// Holds every goal that was asked for, with what became of it. Nothing is ever removed.
class GoalSet {
 public:
  explicit GoalSet(const mission::MissionModel& mission) : mission_(&mission) {}

  /// Says what became of a request.
  enum class Disposition {
    known,     ///< this very sample, or an older one: nothing is to be told
    repeated,  ///< the same wish in a new sample, or a recall that is too late: it is answered, nothing else
    refused,   ///< the goal stays as it was
    rejected,
    recalled,
    accepted,
  };
  struct Submission {
    Disposition taken;
    const GoalRecord* record;
  };
  /// Takes a request in: a new goal, a change, or a recall. A bad new one is stored as rejected, with a
  /// reason that names the remedy; a bad change leaves the goal as it was, with the reason.
  Submission submit(const GoalRequest& request, temporal::Time now);

  /// Returns the requests, each after those that its arguments name: a late joiner hears goals of different
  /// keys in any order.
  std::vector<GoalRequest> in_reference_order(std::vector<GoalRequest> requests) const;

  /// Merges the record that another executive, which led apart, has of a goal (goal_merge.hpp). Returns the
  /// record if it is new or has changed; a goal that this mission cannot have is entered as rejected.
  const GoalRecord* merge(const GoalRecord& theirs);

  /// Puts a goal back as the journal has it; one whose kind or arguments this mission does not have is rejected, with
  /// the reason.
  void restore(const GoalRecord& record);

  void set_state(const GoalKey& key, GoalState state, std::string reason, std::uint32_t plan_version = 0);

  /// Returns the goals that are not final yet, in order of arrival.
  std::vector<const GoalRecord*> open() const;
  /// Returns every goal whose objects exist: all but rejected ones, since the robot may stand at the place of
  /// a goal that was given up.
  std::vector<const GoalRecord*> present() const;
  std::vector<const GoalRecord*> all() const;
  const GoalRecord* find(const GoalKey& key) const;

  /// Which goal goes when not all fit: an opportunistic one, whatever its utility, else the optional one of the lowest
  /// utility by rank; of equals as leaves_first() says; never a hard one (R52, R53, R113; architecture, "The way of a
  /// goal").
  std::optional<GoalKey> drop_candidate() const;
  /// Returns the same among these goals alone.
  std::optional<GoalKey> drop_candidate(const std::vector<GoalKey>& among) const;

 private:
  Disposition change(GoalRecord&, const GoalRequest&, temporal::Time now);
  std::string fault_of(const GoalRequest& request, temporal::Time now) const;
  std::string fault_of_form(const GoalRequest& request) const;
  std::string fault_of_address(const GoalRequest& request) const;
  std::string fault_of_object(const std::string& type, const std::string& given,
                              const std::string& argument) const;
  bool names(const GoalRequest& request, const GoalRequest& other) const;
  std::string fault_of_reference(const GoalRequest& request, const std::string& argument) const;

  const mission::MissionModel* mission_;
  std::map<GoalKey, GoalRecord> records_;
  std::uint64_t next_arrival_ = 1;
};

}  // namespace roci::exec::goals
