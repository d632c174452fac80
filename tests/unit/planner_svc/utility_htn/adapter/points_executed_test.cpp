// A mission of many days in which time points are given again: the executive does what it would do if each were used
// once, and neither side needs more memory in the end than in the middle (R82).
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <map>
#include <random>
#include <tuple>

#include "core/temporal/plan_delta.hpp"
#include "exec_svc/executive/executive.hpp"
#include "planner_svc/utility_htn/adapter/utility_engine.hpp"
#include "tests/unit/planner_svc/utility_htn/cycle/toy_network.hpp"

namespace roci::planner::utility_htn::adapter {
namespace {

using namespace std::chrono_literals;
using engine::StepInputs;
using exec::executive::Command, exec::executive::CommandAck, exec::executive::CommandStage;
using temporal::FlexiblePlan, temporal::PlanActivity, temporal::Time, temporal::TimePoint;

// The same plans with a point of its own for each activity that there ever was.
class PointsOnce {
 public:
  FlexiblePlan renumbered(FlexiblePlan plan) {
    std::map<TimePoint, TimePoint> now{{temporal::origin_point, temporal::origin_point},
                                       {Points::kPast, Points::kPast}};
    for (PlanActivity& activity : plan.activities) {
      const auto [known, added] = of_.emplace(activity.id, next_);
      if (added) next_ += 2;
      now[activity.start_point] = known->second;
      now[activity.end_point] = known->second + 1;
      activity.start_point = known->second;
      activity.end_point = known->second + 1;
    }
    const auto is_gone = [&](const auto& one) { return !now.contains(one); };
    std::erase_if(plan.tokens,
                  [&](const auto& one) { return is_gone(one.start_point) || is_gone(one.end_point); });
    for (temporal::Token& one : plan.tokens) {
      one.start_point = now.at(one.start_point);
      one.end_point = now.at(one.end_point);
    }
    for (temporal::TemporalConstraint& one : plan.constraints) {
      one.from_point = now.at(one.from_point);
      one.to_point = now.at(one.to_point);
    }
    plan.point_count = next_;
    return plan;
  }

 private:
  std::map<std::string, TimePoint> of_;
  TimePoint next_ = Points::kPast + 1;
};

// A lander that is asked for a view every quarter of an hour, while one task runs as long as the mission does. Every
// command takes up to a fifth more or less than foreseen, and one in twenty fails.
class LongFlight {
 public:
  explicit LongFlight(unsigned seed, bool twice) : random_(seed), twice_(twice) {
    heard_.goals.push_back(goal("mission", "mission"));
    heard_.observations.push_back({"health", temporal::state("works"), now_});
    heard_.observations.push_back({"battery", 1e9, now_});
    observed_ = {{"health", temporal::state("works")}, {"battery", 1e9}};
    heard_.receipt = engine::Receipt{0, 0, "", "", true};
  }

  void run_until(Time end) {
    for (; now_ < end; now_ += 30s) {
      if (now_ % 900s == 0s) {
        if (!asked_.empty()) heard_.ended_goals.push_back({"ground", asked_, engine::GoalState::dropped});
        asked_ = "view-" + std::to_string(now_ / 900s);
        heard_.goals.push_back(goal(asked_, "request"));
      }
      for (int turn = 0; turn < 3; ++turn) {
        step_engine();
        step_executives();
      }
    }
  }

  std::size_t commands() const { return commands_; }
  std::uint32_t points() const { return plan_.point_count; }
  const FlexiblePlan& plan() const { return plan_; }

 private:
  static model::Network network() {
    model::Network out = testing::toy_network();
    model::Task& hotel = out.tasks[testing::task_named(out, "idle")];
    hotel.duration = {40.0 * 86400};
    hotel.impacts.clear();
    for (model::Task& task : out.tasks)
      if (task.primitive()) {
        task.commands.emplace_back();
        task.commands.back().owner = "sim_svc";
        task.commands.back().command_name = task.id;
      }
    out.timelines[testing::kBattery].initial = out.timelines[testing::kBattery].highest = 1e9;
    out.cycle = {60s, 5s, 120s, temporal::no_bound, 45 * 86400s};
    return out;
  }
  static engine::Goal goal(const std::string& id, const std::string& kind) {
    engine::Goal out;
    out.issuer = "ground";
    out.id = id;
    out.kind = kind;
    if (kind == "request") out.arguments.push_back({"task", "view"});
    return out;
  }

  void step_engine() {
    const bool due = wake_ && *wake_ <= now_;
    if (!due && heard_.goals.empty() && heard_.steps.empty() && !heard_.receipt) return;
    StepInputs inputs = std::exchange(heard_, {});
    inputs.now = now_;
    inputs.last_version = plan_.version;
    const engine::StepOutput out = engine_.step(inputs);
    wake_ = out.wake;
    if (!out.delta) return;
    ASSERT_EQ(temporal::apply(*out.delta, plan_), "");
    ASSERT_TRUE(executive_.load(plan_, now_).empty());
    if (twice_) {
      ASSERT_TRUE(other_.load(once_.renumbered(plan_), now_).empty());
    }
    heard_.receipt = engine::Receipt{plan_.version, 0, "", "", true};
  }

  void step_executives() {
    exec::executive::Inputs inputs;
    inputs.observations = std::exchange(observed_, {});
    for (auto end = ends_.begin(); end != ends_.end() && end->first <= now_; end = ends_.erase(end))
      inputs.acks.push_back(end->second);
    const exec::executive::Outputs out = executive_.step(now_, inputs);
    if (twice_) {
      const exec::executive::Outputs other = other_.step(now_, inputs);
      ASSERT_EQ(words_of(out.commands), words_of(other.commands)) << "at " << now_.count();
      ASSERT_EQ(out.changes.size(), other.changes.size());
    }
    for (const Command& command : out.commands) begin(command);
    for (const auto& change : out.changes) {
      heard_.steps.push_back({plan_.version,
                              change.activity,
                              {change.state, change.started, change.ended},
                              change.reason,
                              change.attempt});
      if (change.name == "send_view" && change.state == temporal::ActivityState::succeeded)
        heard_.ended_goals.push_back({"ground", std::exchange(asked_, ""), engine::GoalState::achieved});
    }
  }

  static std::vector<std::string> words_of(const std::vector<Command>& commands) {
    std::vector<std::string> out;
    for (const Command& one : commands)
      out.push_back(one.activity + " " + std::to_string(one.attempt) + " " + one.command_name + " " +
                    std::to_string(static_cast<int>(one.action)) + " " +
                    std::to_string(one.latest_end.count()));
    return out;
  }

  void begin(const Command& command) {
    ++commands_;
    if (command.action != exec::executive::CommandAction::execute) return;
    std::uniform_real_distribution<double> share(0.8, 1.2);
    const bool fails = random_() % 20 == 0 && command.command_name != "idle";
    const Time end = now_ + temporal::seconds(temporal::to_seconds(command.expected) * share(random_));
    ends_.emplace(now_, CommandAck{command.activity, command.attempt, CommandStage::accepted, "", ""});
    ends_.emplace(std::max(end, now_ + 1us),
                  CommandAck{command.activity, command.attempt,
                             fails ? CommandStage::failed : CommandStage::completed, "", ""});
  }

  std::mt19937 random_;
  bool twice_;
  UtilityEngine engine_{{"utility_htn", "lander", "", {}}, network()};
  exec::executive::Executive executive_{settings()}, other_{settings()};
  static exec::executive::ExecutiveSettings settings() {
    exec::executive::ExecutiveSettings out;
    out.only_committed = true;
    return out;
  }
  PointsOnce once_;
  FlexiblePlan plan_;
  StepInputs heard_;
  std::vector<exec::executive::Observation> observed_;
  std::multimap<Time, CommandAck> ends_;
  std::optional<Time> wake_;
  std::string asked_;
  std::size_t commands_ = 0;
  Time now_{0};
};

TEST(PointNumbers, GivenAgainOrNotTheSameCommandsGoOut) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    LongFlight flight(seed, true);
    flight.run_until(86400s);
    EXPECT_GT(flight.commands(), 50U);
    EXPECT_LT(flight.points(), 40U) << "points were given again";
    if (::testing::Test::HasFailure()) break;
  }
}

// An outlook remembers the newest thousand chains that have ended; that takes eleven days here.
TEST(LongRunMemory, OfEngineAndExecutiveIsFlatOverThirtyDays) {
  const auto bytes = [] { return static_cast<double>(mallinfo2().uordblks); };
  LongFlight flight(1, false);
  double early = 0, late = 0;
  for (int hour = 1; hour <= 30 * 24; ++hour) {
    flight.run_until(hour * 3600s);
    if (hour > 12 * 24 && hour <= 14 * 24) early = std::max(early, bytes());
    if (hour > 28 * 24) late = std::max(late, bytes());
  }
  EXPECT_GT(flight.commands(), 4000U) << "the mission went on";
  EXPECT_LE(late, 1.02 * early) << "bytes in use";
}

}  // namespace
}  // namespace roci::planner::utility_htn::adapter
