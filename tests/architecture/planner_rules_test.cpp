#include "tests/architecture/planner_rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace roci::architecture {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kEngine = "planner_svc/temporal_pddl/";

SourceFile in_engine(const std::string& path, const std::vector<std::string>& includes) {
  return {kEngine + path, includes, {}};
}

std::string engine(const std::string& path) { return kEngine + path; }

TEST(PlannerRules, AFloorSeesThoseBelowIt) {
  EXPECT_THAT(
      broken_planner_rules({in_engine("search/a.hpp", {engine("heuristics/b.hpp"), engine("task/c.hpp")}),
                            in_engine("heuristics/b.hpp", {engine("task/c.hpp")}),
                            in_engine("task/c.hpp", {"core/temporal/duration.hpp", "vector"})}),
      IsEmpty());
}

TEST(PlannerRules, AFloorDoesNotSeeThoseAboveIt) {
  EXPECT_THAT(broken_planner_rules({in_engine("task/a.hpp", {engine("search/b.hpp")})}),
              ElementsAre(HasSubstr("a floor sees only those below it")));
  EXPECT_THAT(
      broken_planner_rules({in_engine("grounding/lifted/a.hpp", {engine("grounding/encoding/b.hpp")})}),
      ElementsAre(HasSubstr("a floor sees only those below it")));
  EXPECT_THAT(broken_planner_rules({in_engine("extraction/a.hpp", {engine("planner.hpp")})}),
              ElementsAre(HasSubstr("a floor sees only those below it")));
}

TEST(PlannerRules, AChainOfIncludesIsFollowedAndTold) {
  const auto broken = broken_planner_rules({in_engine("search/a.cpp", {engine("search/a.hpp")}),
                                            in_engine("search/a.hpp", {"core/mission/x.hpp"}),
                                            {"core/mission/x.hpp", {"core/pddl/ast.hpp"}, {}}});
  EXPECT_THAT(broken,
              ElementsAre(AllOf(HasSubstr("search/a.cpp: includes planner_svc/temporal_pddl/search/a.hpp -> "
                                          "core/mission/x.hpp -> core/pddl/ast.hpp"),
                                HasSubstr("never sees PDDL text")),
                          HasSubstr("search/a.hpp: includes core/mission/x.hpp -> core/pddl/ast.hpp")));
}

TEST(PlannerRules, WhatWorksOnTheTaskSeesNeitherModelNorGrounder) {
  for (const std::string folder :
       {"call", "task", "constraints", "heuristics", "dead_ends", "search", "improvement"}) {
    EXPECT_THAT(broken_planner_rules({in_engine(folder + "/a.cpp", {"core/pddl/ast.hpp"})}),
                ElementsAre(HasSubstr("never sees PDDL text")));
    EXPECT_THAT(broken_planner_rules({in_engine(folder + "/a.cpp", {engine("grounding/grounder.hpp")})}),
                ElementsAre(HasSubstr("never sees the grounder")));
  }
  EXPECT_THAT(broken_planner_rules({in_engine("grounding/a.cpp", {"core/pddl/ast.hpp"})}), IsEmpty());
}

TEST(PlannerRules, DetectorsAndHeuristicsDoNotSeeEachOther) {
  EXPECT_THAT(broken_planner_rules({in_engine("dead_ends/a.cpp", {engine("heuristics/ff.hpp")})}),
              ElementsAre(HasSubstr("beside the heuristics")));
  EXPECT_THAT(broken_planner_rules({in_engine("heuristics/a.cpp", {engine("dead_ends/x.hpp")})}),
              ElementsAre(HasSubstr("a floor sees only those below it")));
}

TEST(PlannerRules, TheValidatorIsIndependent) {
  EXPECT_THAT(
      broken_planner_rules({in_engine("validate/a.cpp", {"core/pddl/x.hpp", engine("validate/b.hpp")}),
                            {"core/pddl/x.hpp", {engine("grounding/grounder.hpp")}, {}}}),
      ElementsAre(HasSubstr("the validator shares only core/pddl")));
  EXPECT_THAT(broken_planner_rules({in_engine("validate/a.cpp", {"planner_svc/engine/function_source.hpp"})}),
              ElementsAre(HasSubstr("the validator shares only core/pddl")));
  EXPECT_THAT(broken_planner_rules({in_engine("improvement/a.cpp", {engine("validate/validator.hpp")})}),
              ElementsAre(HasSubstr("engines never see the validator")));
  EXPECT_THAT(broken_planner_rules({in_engine("adapter/a.cpp", {engine("checker/pddl_checker.hpp")})}),
              ElementsAre(HasSubstr("engines never see the validator")));
}

TEST(PlannerRules, TheCheckerSeesTheValidatorAlone) {
  EXPECT_THAT(broken_planner_rules({in_engine(
                  "checker/a.cpp", {engine("validate/validator.hpp"), "planner_svc/engine/checker.hpp"})}),
              IsEmpty());
  EXPECT_THAT(broken_planner_rules({in_engine("checker/a.cpp", {engine("task/task.hpp")})}),
              ElementsAre(HasSubstr("nothing of the engine")));
}

TEST(PlannerRules, TheCommandLineAsksTheCheckerAndNotTheValidator) {
  EXPECT_THAT(broken_planner_rules({in_engine("cli/a.cpp", {engine("checker/refusal.hpp")})}), IsEmpty());
  EXPECT_THAT(broken_planner_rules({in_engine("cli/a.cpp", {engine("validate/validator.hpp")})}),
              ElementsAre(HasSubstr("engines never see the validator")));
}

// To add an engine touches the table and its own folder.
TEST(PlannerRules, NobodyButTheTableKnowsAnEngine) {
  const auto broken = [](const std::string& path, const std::string& include) {
    return broken_seam_rules({{path, {include}, {}}});
  };
  EXPECT_THAT(broken("planner_svc/engines.cpp", engine("adapter/pddl_engine.hpp")), IsEmpty());
  EXPECT_THAT(broken("planner_svc/temporal_pddl/search/a.cpp", engine("task/task.hpp")), IsEmpty());
  EXPECT_THAT(broken("planner_svc/timeline_htn/a.cpp", "planner_svc/engine/checker.hpp"), IsEmpty());
  for (const std::string path : {"planner_svc/settings.cpp", "planner_svc/engine/table.cpp",
                                 "planner_svc/timeline_htn/a.cpp", "rehearsal/programs.cpp"}) {
    EXPECT_THAT(broken(path, engine("adapter/pddl_engine.hpp")),
                ElementsAre(HasSubstr("none but planner_svc/engines.cpp knows an engine")));
  }
}

TEST(PlannerRules, AFolderWithoutAFloorIsTold) {
  EXPECT_THAT(broken_planner_rules({in_engine("cellar/a.cpp", {})}),
              ElementsAre(HasSubstr("stands on no floor")));
}

}  // namespace
}  // namespace roci::architecture
