// Plans, checked by the independent validator.
#pragma once

#include <gtest/gtest.h>

#include "planner_svc/temporal_pddl/extraction/plan_text.hpp"
#include "planner_svc/temporal_pddl/validate/validator.hpp"
#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"

namespace roci::planner::temporal_pddl::testing {

// Expects a plan that is valid at the given ε.
inline void expect_valid(const Model& model, const Result& result, const call::Options& options = {}) {
  ASSERT_EQ(result.verdict, temporal::Verdict::solved) << result.reason;
  pddl::FunctionTable table;
  for (const engine::FunctionUse& use : result.functions) {
    std::string application = "(" + use.call.function;
    for (const auto& argument : use.call.arguments) application += " " + argument;
    const bool value = use.answer.outcome == engine::FunctionOutcome::value;
    table[application + ")"] = value ? std::optional(use.answer.value) : std::nullopt;
  }
  const auto steps = pddl::parse_plan(to_ipc(*result.plan), "plan");
  validate::Options rules;
  rules.epsilon = options.epsilon;
  const auto report = validate::validate(model.domain, model.problem, steps, table, rules);
  EXPECT_TRUE(report.valid) << validate::to_text(report, steps, "plan") << to_ipc(*result.plan);
}

}  // namespace roci::planner::temporal_pddl::testing
