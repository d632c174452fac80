// From texts to a report, for the tests of the validator.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "core/pddl/check.hpp"
#include "planner_svc/temporal_pddl/validate/validator.hpp"

namespace roci::planner::temporal_pddl::validate {

struct World {
  std::string domain;     // sections of the domain after its name
  std::string problem;    // sections of the problem; a goal of nothing is added if there is none
  std::string functions;  // table of external functions
};

inline Report check_plan(const World& world, const std::string& plan, const Options& options = {}) {
  const pddl::Domain domain = pddl::load_domain("(define (domain d) " + world.domain + ")", "domain");
  const bool has_goal = world.problem.find("(:goal") != std::string::npos;
  const pddl::Problem problem = pddl::load_problem(
      "(define (problem p) (:domain d) " + world.problem + (has_goal ? ")" : "(:goal ()))"), "problem",
      domain);
  return validate(domain, problem, pddl::parse_plan(plan, "plan"),
                  pddl::parse_function_table(world.functions, "functions"), options);
}

// The kinds of all violations with their times, "condition@1.000 goal@2.000"; "" for a valid plan.
inline std::string kinds(const Report& report) {
  std::string text;
  for (const Violation& violation : report.violations) {
    if (!text.empty()) text += " ";
    text += std::string(to_string(violation.kind)) + "@" + pddl::print_seconds(violation.time);
  }
  EXPECT_EQ(report.valid, report.violations.empty());
  return text;
}

inline std::string check_kinds(const World& world, const std::string& plan, const Options& options = {}) {
  return kinds(check_plan(world, plan, options));
}

}  // namespace roci::planner::temporal_pddl::validate
