// The executive runs any FlexiblePlan on the plan's own temporal network. It is a functional core: it has no
// clock and no I/O, and the same inputs give the same outputs.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"
#include "exec_svc/executive/contingency.hpp"
#include "exec_svc/executive/messages.hpp"
#include "exec_svc/executive/permissions.hpp"

namespace roci::exec::executive {

/// Says when an activity starts within its window (R144). With `latest` it starts at its upper bound, if it
/// has one.
enum class StartPolicy { earliest, latest };

/// Bounds waits that no plan states, and holds what plans name but do not hold.
struct ExecutiveSettings {
  temporal::Duration ack_timeout = temporal::seconds(5);  ///< command sent -> accepted, rejected or completed
  temporal::Duration cancel_timeout = temporal::seconds(5);  ///< cancel sent -> any answer
  /// Bounds how long observations may take to follow a start or an end.
  temporal::Duration settle_time = temporal::seconds(2);
  /// Bounds the wait for pre conditions, where nothing else bounds it.
  temporal::Duration default_wait = temporal::seconds(3600);
  /// Bounds the wait for an answer where decide_before has no latest time.
  temporal::Duration decision_timeout = temporal::seconds(600);
  double overrun_factor = 3.0;  ///< a command fails as hung after this many times its longest duration ...
  temporal::Duration overrun_grace = temporal::seconds(600);  ///< ... plus this
  StartPolicy start = StartPolicy::earliest;
  /// Says whether what is not committed waits for a version of the plan that commits it (R78).
  bool only_committed = false;
  /// Maps the names that PlanActivity::contingency uses to contingencies.
  std::map<std::string, Contingency> contingencies{};
  /// Bounds retries from the first start on, by PlanActivity::name; a name that is not here has no bound.
  std::map<std::string, temporal::Duration> retry_within{};
  /// Gives the light time there and back for each owner that the executive reaches over a link of the
  /// scenario. Messages over such a link may be lost.
  std::map<std::string, temporal::Duration> round_trips{};
  /// Bounds how often such an owner is asked what became of a command before the command counts as
  /// unanswered.
  std::uint32_t queries = 5;

  bool linked(const std::string& owner) const { return round_trips.contains(owner); }
  temporal::Duration round_trip(const std::string& owner) const {
    const auto found = round_trips.find(owner);
    return found == round_trips.end() ? temporal::Duration{0} : found->second;
  }
};

/// Runs one plan after the other by these rules (README.md): a start whose predecessors happened at t <= lb
/// starts at lb, in (lb, ub] at once, after ub the plan is broken (R49). Observed ends replace durations: an
/// activity that takes longer breaks nothing by itself.
class Executive {
 public:
  explicit Executive(ExecutiveSettings settings = {});
  ~Executive();
  Executive(Executive&&) noexcept;
  Executive& operator=(Executive&&) noexcept;

  /// Takes a plan; the next step() acts on it. Activities of the plan before it that were started and stand
  /// in the new plan under the same id go on; others that run are cancelled. Observed values are kept.
  /// Returns check(plan); if that is not empty, nothing has changed.
  std::vector<std::string> load(temporal::FlexiblePlan plan, temporal::Time now);
  /// Does as load() for a plan that was stopped and goes on (R149): activities without a command that had
  /// begun go on from their start, so that the activities within them can still be done.
  std::vector<std::string> load_again(temporal::FlexiblePlan plan, temporal::Time now);

  /// Advances to `now` (never before the time of the call before). It also does so without a plan, as
  /// observations are kept.
  Outputs step(temporal::Time now, const Inputs& inputs);

  /// Goes on after a restart, with the state from before it: asks the owners of everything that runs what
  /// became of it. A command or cancel that an owner never received is sent again under its key.
  Outputs resume(temporal::Time now);

  /// Begins the first phase of the cancel: asks the owners of everything that runs; step() takes their
  /// answers.
  Outputs cancel_all(temporal::Time now);

  /// Holds or releases all starts. While held, no activity starts; what runs goes on, and latest starts still
  /// pass. load() ends it.
  void hold_starts(bool hold);

  /// Sets what the ground lets the executive do from now on, whatever plan is loaded.
  void permit(Permissions permissions);
  /// Leaves out an activity that has not begun; its neighbours keep their order. Returns false if there is
  /// none.
  bool drop(const std::string& activity, const std::string& reason);
  /// Replaces the contingency of that name from now on; it must not be under way.
  void set_contingency(Contingency contingency);
  /// Returns whether some activity runs the contingency of that name.
  bool contingency_under_way(const std::string& name) const;

  /// Returns the activities that were started and have not ended, in plan order.
  std::vector<StepStatus> running() const;

  Outcome outcome() const;
  const temporal::FlexiblePlan& plan() const;
  /// Returns the plan's activity of this id, or null if it has none.
  const temporal::PlanActivity* activity(const std::string& id) const;

  /// Returns all activities in plan order, with the windows of the plan's network as of the last event; this
  /// takes work in the size of the plan.
  std::vector<StepStatus> steps() const;

  /// Returns the first `most` waiting activities in plan order, as in steps(); this takes work in their
  /// number.
  std::vector<StepStatus> upcoming(std::size_t most) const;

  /// Returns how many edges of the network were looked at for windows since the plan was loaded.
  std::uint64_t window_work() const;

  /// Holds start and end of one token of the plan, as far as they have happened.
  struct TokenStatus {
    std::optional<temporal::Time> started, ended;
  };
  /// Returns one entry for each token, in plan order.
  std::vector<TokenStatus> tokens() const;

  /// Returns the value that conditions see: as observed, else as internal activities left it.
  std::optional<temporal::Value> value_of(const std::string& timeline) const;

  /// Return the number of acknowledgements and of decision answers that matched nothing awaited.
  std::uint64_t ignored_acks() const;
  std::uint64_t ignored_answers() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace roci::exec::executive
