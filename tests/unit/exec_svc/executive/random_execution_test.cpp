// Thousands of random plans in worlds that end activities at random.
#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <set>

#include "core/temporal/execution_windows.hpp"
#include "exec_svc/executive/executive.hpp"
#include "exec_svc/executive/precedence.hpp"
#include "tests/unit/exec_svc/executive/random_plan.hpp"

namespace roci::exec::testing {

using executive::Breakage;
using executive::CommandStage;
using executive::Executive;
using executive::Inputs;
using executive::OutcomeKind;
using executive::Outputs;
using executive::point_owners;
using executive::PointOwner;
using executive::PointRole;
using executive::Precedence;
using executive::precedence_of;
using executive::StepStatus;

namespace {

using temporal::Duration;
using temporal::PlanActivity;
using temporal::Time;
using temporal::TimePoint;

/// Steps the executive and keeps, beside it, the events and the windows that follow from them.
class Observer {
 public:
  explicit Observer(temporal::FlexiblePlan p)
      : plan(std::move(p)),
        constraints(all_constraints(plan)),
        windows(plan.point_count, constraints, plan.origin),
        happened(plan.point_count),
        precedence(precedence_of(constraints, point_owners(plan))) {
    happened[0] = plan.origin;
    EXPECT_TRUE(executive.load(plan, Time{0}).empty());
  }

  Outputs step(Time now, const std::vector<std::size_t>& ends) {
    Inputs inputs;
    for (const std::size_t i : ends) {
      inputs.acks.push_back({plan.activities[i].id, 1, CommandStage::completed, "", ""});
      event(plan.activities[i].end_point, now);
      running.erase(i);
    }
    for (const std::size_t i : unanswered)
      inputs.acks.push_back({plan.activities[i].id, 1, CommandStage::accepted, "", ""});
    unanswered.clear();
    const Outputs outputs = executive.step(now, inputs);
    for (const StepStatus& change : outputs.changes) note(change, now);
    return outputs;
  }

  /// The end may happen now without closing the window of any other point.
  bool may_end(std::size_t activity, Time now) {
    const TimePoint end = plan.activities[activity].end_point;
    const temporal::Window window = windows.window(end);
    if (now < window.lower || now > window.upper) return false;
    for (const TimePoint p : precedence.predecessors[end])
      if (!happened[p]) return false;
    windows.happen(end, now);
    bool free = true;
    for (TimePoint p = 0; p < happened.size(); ++p)
      if (p != end && !happened[p] && windows.window(p).upper < now) free = false;
    windows.undo_happen(end);
    return free;
  }

  temporal::FlexiblePlan plan;
  std::vector<temporal::TemporalConstraint> constraints;
  temporal::ExecutionWindows windows;
  std::vector<std::optional<Time>> happened;
  Precedence precedence;
  std::set<std::size_t> running;  ///< activities with a command
  Executive executive;

 private:
  void event(TimePoint point, Time now) {
    windows.happen(point, now);
    happened[point] = now;
  }

  void note(const StepStatus& change, Time now) {
    const auto index = static_cast<std::size_t>(std::stoul(change.activity.substr(1)));
    const PlanActivity& activity = plan.activities[index];
    const bool commanded = !activity.owner.empty();
    if (change.state == temporal::ActivityState::dispatched) {
      running.insert(index);
      unanswered.push_back(index);
    }
    if (change.started == now && !happened[activity.start_point]) event(activity.start_point, now);
    if (!commanded && change.state == temporal::ActivityState::succeeded) event(activity.end_point, now);
  }

  std::vector<std::size_t> unanswered;
};

/// All constraints between real events, exactly.
void expect_satisfied(const Observer& run, bool also_observed_ends) {
  const std::vector<PointOwner> owners = point_owners(run.plan);
  for (const temporal::TemporalConstraint& c : run.constraints) {
    const auto& from = run.happened[c.from_point];
    const auto& to = run.happened[c.to_point];
    if (!from || !to) continue;
    const Duration distance = *to - *from;
    if (also_observed_ends || owners[c.to_point].role != PointRole::observed_end) {
      EXPECT_GE(distance, c.lower) << c.from_point << " -> " << c.to_point;
    }
    // Only a start can be too late; an end that was too early or too late shows in starts after it.
    const TimePoint last = distance >= Duration{0} ? c.to_point : c.from_point;
    if (also_observed_ends || owners[last].role == PointRole::start) {
      EXPECT_LE(distance, c.upper) << c.from_point << " -> " << c.to_point;
    }
  }
}

TEST(RandomExecution, DelaysInsideTheWindowsNeverBreakAPlan) {
  std::mt19937_64 random(17);
  for (int round = 0; round < 4000; ++round) {
    Observer run(random_plan(random, 8));
    SCOPED_TRACE(round);
    Time now{0};
    std::vector<std::size_t> ends;
    Outputs outputs = run.step(now, ends);
    while (outputs.outcome.kind == OutcomeKind::running) {
      ends.clear();
      Time next = outputs.next_wake.value_or(temporal::no_bound);
      for (const std::size_t i : run.running) {
        const temporal::Window window = run.windows.window(run.plan.activities[i].end_point);
        const bool last_moment = now >= window.upper;
        if (ends.empty() && (last_moment || random() % 3 == 0) && run.may_end(i, now)) ends.push_back(i);
        const Time chosen = now + Duration{between(random, 1, 50'000)};
        next = std::min({next, std::max(chosen, window.lower), std::max(now, window.upper)});
      }
      if (ends.empty()) {
        ASSERT_GT(next, now) << "nothing may end, nothing may wait";
        ASSERT_LT(next, temporal::no_bound);
        now = next;
      }
      outputs = run.step(now, ends);
    }
    ASSERT_EQ(outputs.outcome.kind, OutcomeKind::finished) << outputs.outcome.reason;
    expect_satisfied(run, true);
    if (HasFailure()) break;
  }
}

TEST(RandomExecution, AnyDurationsKeepEveryOrderOfStartsOrBreakThePlan) {
  std::mt19937_64 random(18);
  std::map<Breakage, int> ends_by;
  for (int round = 0; round < 4000; ++round) {
    Observer run(random_plan(random, 8));
    SCOPED_TRACE(round);
    Time now{0};
    std::multimap<Time, std::size_t> planned_ends;
    std::set<std::size_t> known;
    Outputs outputs = run.step(now, {});
    while (outputs.outcome.kind == OutcomeKind::running) {
      for (const std::size_t i : run.running) {
        if (!known.insert(i).second) continue;
        const std::int64_t shortest = run.plan.activities[i].duration_lower.count();
        planned_ends.emplace(now + Duration{between(random, shortest * 7 / 10, shortest * 15 / 10 + 1)}, i);
      }
      const Time end = planned_ends.empty() ? temporal::no_bound : planned_ends.begin()->first;
      now = std::min(end, outputs.next_wake.value_or(temporal::no_bound));
      ASSERT_LT(now, temporal::no_bound) << "the plan waits for nothing";
      std::vector<std::size_t> ends;
      if (now == end) {
        ends.push_back(planned_ends.begin()->second);
        planned_ends.erase(planned_ends.begin());
      }
      outputs = run.step(now, ends);
    }
    ++ends_by[outputs.outcome.breakage];
    expect_satisfied(run, false);
    if (HasFailure()) break;
  }
  EXPECT_GT(ends_by[Breakage::none], 1000);
  EXPECT_GT(ends_by[Breakage::late_start], 200);
  EXPECT_GT(ends_by[Breakage::ordering_violated], 20);
}

/// Latest times that stand even when durations are exceeded.
temporal::ExecutionWindows firm_windows(const temporal::FlexiblePlan& plan) {
  std::vector<temporal::TemporalConstraint> constraints = all_constraints(plan);
  for (std::size_t i = 0; i < plan.activities.size(); ++i) constraints[i].upper = temporal::no_bound;
  return {plan.point_count, constraints, plan.origin};
}

TEST(RandomExecution, ADelayBeyondTheLatestStartOfAFollowerIsAlwaysDetected) {
  std::mt19937_64 random(19);
  int delayed = 0;
  for (int round = 0; round < 20'000; ++round) {
    SCOPED_TRACE(round);
    const temporal::FlexiblePlan plan = random_plan(random, 6);
    const std::size_t victim = random() % plan.activities.size();
    const std::vector<PointOwner> owners = point_owners(plan);
    const temporal::ExecutionWindows firm = firm_windows(plan);
    const Precedence precedence = precedence_of(all_constraints(plan), owners);
    Time latest = temporal::no_bound;
    for (const TimePoint p : precedence.successors[plan.activities[victim].end_point])
      if (owners[p].role == PointRole::start) latest = std::min(latest, firm.window(p).upper);
    if (plan.activities[victim].owner.empty() || latest == temporal::no_bound) continue;
    ++delayed;
    Observer run(plan);
    Time now{0};
    Outputs outputs = run.step(now, {});
    while (outputs.outcome.kind == OutcomeKind::running) {
      std::vector<std::size_t> ends;
      for (const std::size_t i : run.running)
        if (i != victim && run.may_end(i, now)) ends = {i};
      if (ends.empty()) now = std::min(now + Duration{1000}, outputs.next_wake.value_or(temporal::no_bound));
      ASSERT_LE(now, latest + Duration{1});
      outputs = run.step(now, ends);
    }
    ASSERT_EQ(outputs.outcome.kind, OutcomeKind::broken);
  }
  EXPECT_GT(delayed, 400);
}

}  // namespace
}  // namespace roci::exec::testing
