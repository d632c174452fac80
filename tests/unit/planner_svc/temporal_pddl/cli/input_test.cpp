// The input side of roci-plan: each kind of file that departs from PDDL is planned for, with its warning on standard
// error and nothing but the plan on standard output; what is refused ends with the code that says how.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/unit/planner_svc/temporal_pddl/cli/roci_plan_program.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const std::string kFiles = ROCI_SOURCE_DIR "/tests/unit/planner_svc/temporal_pddl/cli/departures/";

class RociPlanInput : public testing::RociPlanProgram {
 protected:
  // Runs with the file of a departure in the place of its counterpart.
  int run_departure(const std::string& name, const std::string& options) {
    const bool in_domain = std::filesystem::exists(kFiles + name + "-domain.pddl");
    return run(kFiles + (in_domain ? name + "-domain.pddl " : "domain.pddl ") + kFiles +
               (in_domain ? "problem.pddl " : name + "-problem.pddl ") + options);
  }
};

TEST_F(RociPlanInput, SaysNothingOfWhatIsRight) {
  EXPECT_EQ(run(kFiles + "domain.pddl " + kFiles + "problem.pddl --strict"), 0) << read("err");
  EXPECT_THAT(read("err"), IsEmpty());
  EXPECT_THAT(read("out"), HasSubstr("(land van south)"));
  EXPECT_EQ(run_departure("crlf-and-capitals", "--strict"), 0) << read("err");
  EXPECT_THAT(read("err"), IsEmpty());
}

TEST_F(RociPlanInput, ReadsEachDepartureWithAWarningAndRefusesItIfStrict) {
  ASSERT_EQ(run(kFiles + "domain.pddl " + kFiles + "problem.pddl"), 0);
  const std::string plan = read("out");
  for (const std::string name :
       {"byte-order-mark", "odd-character", "comma", "question-mark", "hyphen", "outside-text",
        "requirement-flag", "missing-requirement", "old-section", "number-type", "type-twice",
        "type-under-itself", "undeclared-type", "undeclared-function", "signature-twice", "object-twice",
        "value-twice", "hidden-variable", "missing-goal", "domain-name"}) {
    SCOPED_TRACE(name);
    EXPECT_EQ(run_departure(name, ""), 0) << read("err");
    EXPECT_THAT(read("err"),
                AllOf(HasSubstr(".pddl:"), HasSubstr(": warning: "), HasSubstr("[" + name + "]\n")));
    EXPECT_EQ(read("out"), name == "missing-goal" ? "" : plan);
    EXPECT_EQ(run_departure(name, "--strict"), 2);
    EXPECT_THAT(read("err"),
                AllOf(HasSubstr("invalid_input"), HasSubstr(": error: "), HasSubstr("[" + name + "]")));
    EXPECT_THAT(read("out"), IsEmpty());
  }
}

TEST_F(RociPlanInput, WarningsStandInTheJson) {
  EXPECT_EQ(run_departure("comma", "--json"), 0) << read("err");
  const auto json = nlohmann::json::parse(read("out"));
  ASSERT_EQ(json["warnings"].size(), 1U);
  EXPECT_THAT(json["warnings"][0].get<std::string>(), HasSubstr("[comma]"));
  EXPECT_EQ(json["verdict"], "solved");
}

TEST_F(RociPlanInput, TellsAllErrorsOfBothFiles) {
  write("d",
        "(define (domain d) (:predicates (p))\n(:action a :precondition (zap) :efect (p))\n(:action b "
        ":effect (zip)))");
  write("x", "(define (problem x) (:domain d)\n(:init (p) p) (:goal (and (q) (not)))\n)");
  EXPECT_EQ(run("d x"), 2);
  EXPECT_THAT(read("out"), IsEmpty());
  EXPECT_THAT(
      read("err"),
      AllOf(HasSubstr("invalid_input: 5 findings\n"), HasSubstr("\nd:2:26: error: unknown predicate 'zap'"),
            HasSubstr("\nd:2:32: error: ':efect'"), HasSubstr("\nd:3:20: error: unknown predicate 'zip'"),
            HasSubstr("\nx:2:12: error: "), HasSubstr("\nx:2:31: error: 'not' with 0 parts")));
  EXPECT_EQ(run("d x --json"), 2);
  EXPECT_EQ(nlohmann::json::parse(read("out"))["errors"].size(), 5U);
  EXPECT_EQ(run("d nowhere"), 2);
  EXPECT_THAT(read("err"), HasSubstr("nowhere: error: cannot be read"));
}

TEST_F(RociPlanInput, WhatIsNotSupportedEndsWithCodeThree) {
  const std::string head =
      "(define (domain d) (:requirements :durative-actions :fluents) (:predicates (p)) (:functions (f))\n";
  write("x", "(define (problem x) (:domain d) (:init (= (f) 0)) (:goal (p)))");
  const std::pair<const char*, const char*> cases[] = {
      {"(:durative-action a :duration (= ?duration 1)\n :effect (increase (f) (* #t 1)))", "d:3:10: error: "},
      {"(:durative-action a :duration (= ?duration 1)\n :condition (preference n (at start (p))))",
       "d:3:13: error: preferences"},
      {"(:action a :precondition\n (always (p)))", "d:3:2: error: trajectory constraint 'always'"},
      {"(:constraints (always (p)))", "d:2:1: error: trajectory constraints"},
      {"(:process a :effect (p))", "d:2:1: error: processes and events"},
      {"(:event a :effect (p))", "d:2:1: error: processes and events"},
      {"(:functions (g) - thing)", "d:2:19: error: a function of another type than number"}};
  for (const auto& [section, words] : cases) {
    SCOPED_TRACE(section);
    write("d", head + section + ")");
    EXPECT_EQ(run("d x"), 3);
    EXPECT_THAT(read("err"), AllOf(HasSubstr(words), HasSubstr("unsupported: "), Not(HasSubstr("invalid"))));
    EXPECT_EQ(run("d x --parse-only"), 3);
  }
  write("d", head + ")");
  write("x",
        "(define (problem x) (:domain d) (:init)\n(:goal (preference n (p))) (:metric minimize (is-violated "
        "n)))");
  EXPECT_EQ(run("d x"), 3);
  EXPECT_THAT(read("err"),
              AllOf(HasSubstr("x:2:8: error: preferences"), HasSubstr("x:2:46: error: preferences")));
}

TEST_F(RociPlanInput, TimesThatNoPlanCanTellAreNotSupported) {
  const std::string head =
      "(define (domain d) (:requirements :durative-actions :timed-initial-literals)"
      "(:predicates (p) (open)) ";
  const std::string closed = "(define (problem x) (:domain d) (:init) (:goal (p)))";
  const std::string opens_late = "(define (problem x) (:domain d) (:init (at 1e14 (open))) (:goal (p)))";
  const std::pair<std::string, std::string> cases[] = {
      {"(:durative-action a :duration (= ?duration 2e9) :effect (at end (p)))", closed},
      {"(:durative-action a :duration (>= ?duration 1e15) :effect (at end (p)))", closed},
      {"(:action a :precondition (open) :effect (p))", opens_late}};
  for (const auto& [action, problem] : cases) {
    SCOPED_TRACE(action);
    write("d", head + action + ")");
    write("x", problem);
    EXPECT_EQ(run("d x"), 3);
    EXPECT_THAT(read("out"), IsEmpty());
    EXPECT_THAT(read("err"), AllOf(HasSubstr("unsupported: "), HasSubstr("use a greater unit of time"),
                                   HasSubstr("is out of range (0 to 1000000000 seconds)")));
    EXPECT_EQ(run("d x --json"), 3);
    EXPECT_FALSE(nlohmann::json::parse(read("out")).contains("plan"));
  }
}

TEST_F(RociPlanInput, ParseOnlyEndsBeforePlanning) {
  EXPECT_EQ(run_departure("comma", "--parse-only"), 0);
  EXPECT_THAT(read("out"), IsEmpty());
  EXPECT_THAT(read("err"), HasSubstr("[comma]"));
  write("d", "(define (domain d))\n(:action a :effect (p))");
  EXPECT_EQ(run("d d --parse-only"), 2);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
