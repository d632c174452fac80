// The example of planner_svc/README.md is this code, and it works.
#include "tests/engines/example_engine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "planner_svc/engine/checked_answer.hpp"
#include "tests/engines/lock_calls.hpp"

namespace roci::planner::proof {
namespace {

using temporal::Verdict;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string text_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(ROCI_SOURCE_DIR "/" + file).rdbuf();
  return text.str();
}

TEST(ExampleEngine, StandsInTheReadme) {
  const std::string code = text_of("tests/engines/example_engine.cpp");
  const std::string begin = "// README: begin\n";
  const auto from = code.find(begin) + begin.size();
  ASSERT_LT(from, code.size());
  EXPECT_THAT(text_of("planner_svc/README.md"),
              HasSubstr("```cpp\n" + code.substr(from, code.find("// README: end") - from) + "```"));
}

TEST(ExampleEngine, PlansAndIsChecked) {
  engine::Request request = lock_request({goal_of("full", {{"level", "high"}})});
  request.engine = "errands";
  engine::NoFunctions functions;
  const engine::Answer answer = engine::answer_checked(example_engines(), request, {}, functions);
  ASSERT_EQ(answer.verdict, Verdict::solved) << answer.reason;
  EXPECT_THAT(answer.plan->activities.at(0).goals_served, ElementsAre("ground/full"));
  const auto checker = example_engines().at("errands").make_checker();
  EXPECT_THAT(checker->faults({request, {}, {}, nullptr, nullptr}),
              ElementsAre("nothing is done for ground/full"));
}

TEST(ExampleEngine, SaysWhichGoalItCannotPlan) {
  engine::Request request = lock_request({goal_of("both", {{"level", "high"}, {"ship", "above"}})});
  request.engine = "errands";
  engine::NoFunctions functions;
  const engine::Answer answer = engine::answer_checked(example_engines(), request, {}, functions);
  ASSERT_EQ(answer.blocking.size(), 1U);
  EXPECT_EQ(answer.blocking[0].id, "both");
}

}  // namespace
}  // namespace roci::planner::proof
