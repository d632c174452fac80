#include "tests/engines/example_engine.hpp"

namespace roci::planner::proof {
namespace {

// README: begin
// For each goal, which asks that some timeline holds a state, one command to the service `errand_svc`.
class ErrandEngine final : public engine::AnsweringEngine {
 public:
  engine::Answer answer(const engine::Request& request, const engine::Limits& limits,
                        engine::FunctionSource&) override {
    temporal::FlexiblePlan plan;
    plan.engine = request.engine;
    plan.origin = request.origin;
    for (const engine::Goal& goal : request.goals) {
      if (limits.cancelled()) return engine::without_plan(temporal::Verdict::cancelled, "cancelled");
      const auto timelines = temporal::timelines_of(goal.achieved);
      if (timelines.size() != 1) return blocked(goal);
      temporal::PlanActivity errand;
      errand.id = errand.name = "errand-" + goal.id;
      errand.owner = "errand_svc";
      errand.command_name = "set";
      errand.arguments = {{"timeline", timelines.front()}};
      errand.start_point = plan.point_count++;
      errand.end_point = plan.point_count++;
      errand.duration_upper = temporal::seconds(60);
      errand.goals_served = {goal.key()};
      plan.activities.push_back(std::move(errand));
    }
    engine::Answer out;
    out.verdict = temporal::Verdict::solved;
    out.plan = std::move(plan);
    return out;
  }

 private:
  static engine::Answer blocked(const engine::Goal& goal) {
    engine::Answer out =
        engine::without_plan(temporal::Verdict::unsolvable, "an errand is about one timeline");
    out.blocking = {{goal.issuer, goal.id, "", out.reason}};
    return out;
  }
};

// Sees the plan as whoever gets it does: its form, and that each goal has somebody who works for it.
class ErrandChecker final : public engine::Checker {
 public:
  std::vector<std::string> faults(const engine::CheckedPlan& checked) const override {
    std::vector<std::string> faults = temporal::check(checked.plan);
    for (const engine::Goal& goal : checked.request.goals) {
      bool served = false;
      for (const temporal::PlanActivity& activity : checked.plan.activities)
        for (const std::string& key : activity.goals_served) served |= key == goal.key();
      if (!served) faults.push_back("nothing is done for " + goal.key());
    }
    return faults;
  }
};

const engine::Table kErrands{
    {"errands",
     {engine::MakeAnswering([] { return std::make_unique<ErrandEngine>(); }),
      [] { return std::make_unique<ErrandChecker>(); }}},
};
// README: end

}  // namespace

const engine::Table& example_engines() { return kErrands; }

}  // namespace roci::planner::proof
