// Numbers that services are asked for before the search (R35, R36), through the engine and its checker.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "planner_svc/timeline_htn/adapter/timeline_engine.hpp"
#include "planner_svc/timeline_htn/adapter/timeline_resolver.hpp"
#include "planner_svc/timeline_htn/checking/timeline_checker.hpp"
#include "tests/unit/planner_svc/timeline_htn/search/plans.hpp"

namespace roci::planner::timeline_htn::adapter {
namespace {

using engine::Answer, engine::FunctionCall, engine::FunctionOutcome, engine::FunctionUse,
    engine::FunctionValue, engine::Request;
using temporal::FunctionValueUse, temporal::seconds, temporal::state, temporal::Verdict;
using testing::Contains, testing::ElementsAre, testing::HasSubstr, testing::IsEmpty, testing::SizeIs,
    testing::UnorderedElementsAre;

/// Gives the values of a table, 100 s where nothing stands in it; keeps what it was asked for.
class Owner final : public engine::FunctionSource {
 public:
  std::vector<FunctionValue> evaluate(std::span<const FunctionCall> calls,
                                      const std::function<bool()>&) override {
    ++batches;
    std::vector<FunctionValue> out;
    for (const FunctionCall& call : calls) {
      const auto known = table.find(engine::application(call));
      FunctionValue value = known == table.end() ? said(FunctionOutcome::value, 100) : known->second;
      value.provenance = {"paths", "7", seconds(990)};
      out.push_back(value);
      uses.push_back({call, value});
    }
    if (answers_too_few) out.pop_back();
    return out;
  }
  static FunctionValue said(FunctionOutcome outcome, double value = 0, const std::string& reason = "") {
    FunctionValue out;
    out.outcome = outcome;
    out.value = value;
    out.reason = reason;
    return out;
  }

  std::map<std::string, FunctionValue> table;
  std::vector<FunctionUse> uses;
  int batches = 0;
  bool answers_too_few = false;
};

// The porter, whose way between two places takes as long as the owner of module 'pathplan' says.
Request porter(const std::string& rows_of = "") {
  Request out;
  out.engine = "timeline_htn";
  out.origin = seconds(1000);
  out.model =
      with(text_of_file("tests/missions/porter/porter.yaml"),
           "metres: {arguments: [place, place], symmetric: true, rows: [[dock, gate, 6], [gate, yard, 10]]}",
           "drive_s: {arguments: [place, place], asked: {module: pathplan, function: traverse_time" +
               rows_of + "}}");
  out.model = with(out.model, "[\"metres(from, to) / 0.5\", \"metres(from, to) / 0.5 + 120\"]",
                   "[\"drive_s(from, to)\", \"2 * drive_s(from, to)\"]");
  out.state = {{"porter.base", state("parked", {"dock"})}, {"porter.gripper", state("empty")}};
  engine::Goal goal;
  goal.issuer = "ground";
  goal.id = "7";
  goal.achieved = temporal::compare("errand", temporal::ConditionOp::eq, state("fetched", {"red"}));
  out.goals = {goal};
  return out;
}

Answer answer(const Request& request, Owner& owner) { return TimelineEngine().answer(request, {}, owner); }

const temporal::PlanActivity& activity(const Answer& answer, const std::string& name) {
  return *std::ranges::find(answer.plan->activities, name, &temporal::PlanActivity::name);
}

TEST(AskedNumbers, BoundActivitiesAndStandInThePlanWithWhoSaidSo) {
  Owner owner;
  owner.table["(traverse_time gate dock)"] = Owner::said(FunctionOutcome::value, 31.5);
  const Request request = porter();
  const Answer out = answer(request, owner);
  ASSERT_TRUE(out.plan) << out.reason;
  EXPECT_EQ(owner.batches, 1) << "all of a table at once, before the search";
  EXPECT_THAT(owner.uses, SizeIs(9));
  EXPECT_EQ(owner.uses[1].call, (FunctionCall{"pathplan", "traverse_time", {"dock", "gate"}}));
  const auto& back = activity(out, "base.driving(gate, dock)");
  EXPECT_EQ(back.duration_lower, seconds(31.5));
  EXPECT_EQ(back.duration_upper, seconds(63));
  EXPECT_THAT(out.plan->function_values,
              UnorderedElementsAre(
                  FunctionValueUse{"traverse_time", {"dock", "gate"}, 100, "paths", 7, seconds(990)},
                  FunctionValueUse{"traverse_time", {"gate", "dock"}, 31.5, "paths", 7, seconds(990)}))
      << "the yard is on no way to the red crate";
}

TEST(AskedNumbers, TheCheckerTakesThemFromTheirOwnersAlone) {
  Owner owner;
  const Request request = porter();
  const Answer out = answer(request, owner);
  ASSERT_TRUE(out.plan) << out.reason;
  const auto faults = [&](const temporal::FlexiblePlan& plan, const std::vector<FunctionUse>& values) {
    return checking::TimelineChecker().faults({.request = request, .values = values, .plan = plan});
  };
  EXPECT_THAT(faults(*out.plan, owner.uses), IsEmpty());
  EXPECT_THAT(faults(*out.plan, {}), Not(IsEmpty())) << "nobody gave a value";
  std::vector<FunctionUse> others = owner.uses;
  for (FunctionUse& use : others) use.answer.value = 130;
  EXPECT_THAT(faults(*out.plan, others), Contains(HasSubstr("base.driving(dock, gate)")));
  others = owner.uses;
  for (FunctionUse& use : others) use.answer.accuracy = temporal::FunctionAccuracy::lower_bound;
  EXPECT_THAT(faults(*out.plan, others), Not(IsEmpty())) << "a bound is no value";
  temporal::FlexiblePlan plan = *out.plan;
  plan.function_values[0].number = 99;
  EXPECT_THAT(
      faults(plan, owner.uses),
      ElementsAre(HasSubstr("records (traverse_time dock gate) = 99 of paths, which did not say so")));
  plan = *out.plan;
  plan.function_values.pop_back();
  EXPECT_THAT(faults(plan, owner.uses),
              ElementsAre("the plan stands on (traverse_time gate dock) and does not record it"));
}

TEST(AskedNumbers, OfARelationItsRowsAloneAreAskedFor) {
  Owner owner;
  const Answer out = answer(porter(", rows_of: path"), owner);
  ASSERT_TRUE(out.plan) << out.reason;
  std::vector<std::string> asked;
  for (const FunctionUse& use : owner.uses) asked.push_back(engine::application(use.call));
  EXPECT_THAT(asked, ElementsAre("(traverse_time dock gate)", "(traverse_time gate dock)",
                                 "(traverse_time gate yard)", "(traverse_time yard gate)"));
}

TEST(AskedNumbers, WhatHasNoValueIsNoStateAndTheOwnersWordsAreTheReason) {
  Owner owner;
  for (const char* from : {"dock", "yard"})
    owner.table["(traverse_time " + std::string(from) + " gate)"] =
        Owner::said(FunctionOutcome::unreachable, 0, "gate: the rover cannot stand there (steep)");
  const Answer out = answer(porter(", rows_of: path"), owner);
  EXPECT_EQ(out.verdict, Verdict::unsolvable);
  EXPECT_THAT(out.reason, HasSubstr("gate: the rover cannot stand there (steep) (says paths, model 7)"));
  ASSERT_THAT(out.blocking, SizeIs(1));
  EXPECT_EQ(out.blocking[0].reason, "gate: the rover cannot stand there (steep) (says paths, model 7)");
  owner.table.erase("(traverse_time yard gate)");
  EXPECT_THAT(answer(porter(), owner).reason,
              HasSubstr("paths says that there is no (traverse_time dock gate), gate: the rover cannot"))
      << "of the gate alone it says nothing: there is a way from the yard";
}

TEST(AskedNumbers, WhatWasNotFoundProvesNothing) {
  Owner owner;
  owner.table["(traverse_time dock gate)"] = Owner::said(FunctionOutcome::unknown);
  const Answer out = answer(porter(), owner);
  EXPECT_EQ(out.verdict, Verdict::timeout);
  EXPECT_THAT(out.reason, HasSubstr("not known: paths found no way for (traverse_time dock gate) with the "
                                    "effort spent; ask again or give it more; without that, "));
  EXPECT_TRUE(out.lacks_values);
  ASSERT_THAT(out.blocking, SizeIs(1)) << "the goal that needs the gate";
}

TEST(AskedNumbers, WhoDoesNotAnswerIsNamedWithTheTableAndARemedy) {
  engine::NoFunctions nobody;
  const Answer none = TimelineEngine().answer(porter(), {}, nobody);
  EXPECT_EQ(none.verdict, Verdict::function_unavailable);
  EXPECT_EQ(none.reason,
            "model:13:47: number 'drive_s': external function (traverse_time dock dock) of module pathplan: "
            "unavailable; start the service that offers module pathplan, or give the values in a file");
  Owner owner;
  owner.table["(traverse_time dock gate)"] =
      Owner::said(FunctionOutcome::value, std::numeric_limits<double>::infinity());
  EXPECT_THAT(answer(porter(), owner).reason,
              HasSubstr("(traverse_time dock gate) of module pathplan: not-a-number"));
  owner.table.clear();
  owner.answers_too_few = true;
  EXPECT_EQ(answer(porter(), owner).verdict, Verdict::function_unavailable);
  EXPECT_EQ(TimelineEngine().answer(porter(), {.cancelled = [] { return true; }}, owner).verdict,
            Verdict::cancelled);
}

// Who answers a decision of a running plan may ask nobody: the plan has all that was given.
TEST(AskedNumbers, AnswersToOpenDecisionsStandOnThoseOfThePlan) {
  Request request = porter();
  request.model =
      with(request.model, "numbers:\n",
           "numbers:\n  set_s: {arguments: [crate], asked: {module: arm, function: motion_time}}\n");
  request.model = with(request.model, "    parameters: {crate: crate}\n        duration_s: [5, 60]",
                       "    parameters: {crate: crate}\n        duration_s: [\"set_s(crate)\", 200]");
  request.model = with(request.model, "    constraints: [lift before put]\n",
                       "      crane: gripper.handing_over(crate)\n"
                       "    constraints: [lift before put, lift before crane]\n"
                       "    decisions:\n      how: {resolver: engine, before: put.start, choices: {floor: "
                       "{subgoals: put}, crane: {subgoals: crane}}}\n");
  request.model = with(request.model, "    transitions:\n      - \"empty -> lifting",
                       "      handing_over: {kind: simple, parameters: {crate: crate}, duration_s: [5, 60]}\n"
                       "    transitions:\n      - \"holding(x) -> handing_over(x)\"\n"
                       "      - \"handing_over(x) -> empty\"\n      - \"empty -> lifting");
  Owner owner;
  const Answer out = answer(request, owner);
  ASSERT_TRUE(out.plan) << out.reason;
  EXPECT_EQ(owner.batches, 2) << "one for each table";
  EXPECT_THAT(out.plan->function_values, SizeIs(2 + 9)) << "all, since an answer may stand on any";
  EXPECT_THAT(
      checking::TimelineChecker().faults({.request = request, .values = owner.uses, .plan = *out.plan}),
      IsEmpty());
  ASSERT_THAT(out.plan->decisions, SizeIs(1));
  request.goals.clear();
  request.origin = seconds(1300);
  request.state = {{"errand", state("fetching", {"red"})},
                   {"porter.base", state("parked", {"dock"})},
                   {"porter.gripper", state("holding", {"red"})}};
  const auto chosen = [&](const temporal::FlexiblePlan& plan) {
    const auto resolution = TimelineResolver().resolve({request, plan, plan.decisions[0]});
    return resolution ? resolution->choice : "nothing";
  };
  EXPECT_EQ(chosen(*out.plan), "floor");
  temporal::FlexiblePlan without = *out.plan;
  without.function_values.clear();
  EXPECT_EQ(chosen(without), "crane") << "nobody knows how long setting it down takes";
}

TEST(AskedNumbers, AreBoundedBeforeAnybodyIsAsked) {
  Request request = porter();
  for (int i = 0; i < 150; ++i) request.objects.push_back({"p" + std::to_string(i), "place", {}});
  Owner owner;
  const Answer out = answer(request, owner);
  EXPECT_EQ(out.verdict, Verdict::invalid_input);
  EXPECT_THAT(out.reason,
              HasSubstr("more than 20000 numbers would be asked for; name a relation in 'rows_of'"));
  EXPECT_EQ(owner.batches, 0);
}

}  // namespace
}  // namespace roci::planner::timeline_htn::adapter
