// Each checker accepts what its engine makes, and refuses every mutant of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/engines/lock_calls.hpp"
#include "tests/engines/mutations.hpp"

namespace roci::planner::proof {
namespace {

using temporal::FlexiblePlan;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A request, the engine's plan for it, and who checks it.
struct Case {
  engine::Request request;
  FlexiblePlan plan;
  std::unique_ptr<engine::Checker> checker;

  std::vector<std::string> faults(const FlexiblePlan& checked) const {
    return checker->faults({request, {}, checked, nullptr, nullptr});
  }
};

Case answered() {
  Case out;
  out.request = lock_request({goal_of("lift", {{"ship", "above"}})});
  out.request.goals[0].closes = out.request.origin + temporal::seconds(2000);
  out.plan = answer_to(out.request).plan.value_or(FlexiblePlan{});
  out.checker = engines().at("search").make_checker();
  return out;
}

Case stepped() {
  Case out;
  out.request = lock_request({});
  out.request.engine = "chain";
  engine::Goal goal;
  goal.issuer = "ground";
  goal.id = "lift";
  goal.kind = "lift";
  out.request.goals = {goal};
  const auto made = std::get<engine::MakeStepped>(engines().at("chain").make)({"chain", "", kLockModel});
  engine::StepInputs inputs;
  inputs.now = out.request.origin;
  inputs.goals = out.request.goals;
  for (const auto& [timeline, value] : lock_at_rest())
    inputs.observations.push_back({timeline, value, inputs.now});
  inputs.receipt.emplace();
  inputs.receipt->open = true;
  const engine::StepOutput output = made->step(inputs);
  if (output.delta) out.plan = output.delta->added;
  out.checker = engines().at("chain").make_checker();
  return out;
}

void refuses_every_mutant_of(const Case& made) {
  ASSERT_EQ(made.plan.activities.size(), 6U);
  EXPECT_THAT(made.faults(made.plan), IsEmpty());
  std::set<std::string> names;
  for (const Mutation& mutation : mutations()) {
    FlexiblePlan mutant = made.plan;
    mutation.apply(mutant);
    EXPECT_NE(mutant, made.plan) << mutation.name;
    EXPECT_FALSE(made.faults(mutant).empty()) << mutation.name;
    names.insert(mutation.name);
  }
  EXPECT_GE(names.size(), 20U);
}

TEST(Checkers, TheAnsweringEnginesRefusesEveryMutant) { refuses_every_mutant_of(answered()); }

TEST(Checkers, TheSteppedEnginesRefusesEveryMutant) { refuses_every_mutant_of(stepped()); }

TEST(Checkers, APlanThatMayBeTooLateIsRefused) {
  Case made = answered();
  std::erase_if(made.plan.constraints, [](const temporal::TemporalConstraint& constraint) {
    return constraint.kind == temporal::ConstraintKind::window;
  });
  EXPECT_THAT(made.faults(made.plan), ElementsAre(HasSubstr("too late for ground/lift")));
}

// What the plan was right for is not what is asked.
TEST(Checkers, APlanForAnotherStateOrGoalIsRefused) {
  for (const bool by_call : {true, false}) {
    Case made = by_call ? answered() : stepped();
    made.request.state["lower"] = temporal::state("open");
    EXPECT_FALSE(made.faults(made.plan).empty());
    made.request.state = lock_at_rest();
    made.request.state["energy"] = 39.0;
    EXPECT_FALSE(made.faults(made.plan).empty());
    made.request.state = lock_at_rest();
    made.request.goals[0].id = "another";
    EXPECT_FALSE(made.faults(made.plan).empty());
  }
}

TEST(Checkers, WhatIsCommittedStaysAsItIs) {
  const Case made = stepped();
  FlexiblePlan before = made.plan;
  before.activities[0].commit = temporal::CommitState::committed;
  FlexiblePlan next = before;
  next.activities[0].priority = 7;
  const temporal::Progress progress;
  const auto faults = [&](const FlexiblePlan& plan) {
    return made.checker->faults({made.request, {}, plan, &before, &progress});
  };
  EXPECT_THAT(faults(before), IsEmpty());
  EXPECT_THAT(faults(next), ElementsAre(HasSubstr("is committed and has changed")));
  next = before;
  next.activities[1].commit = temporal::CommitState::committed;
  EXPECT_THAT(faults(next), ElementsAre(HasSubstr("is committed too early")));
}

}  // namespace
}  // namespace roci::planner::proof
