// A model file and what is made of it (R134, R136, R137).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/mission/entry.hpp"
#include "planner_svc/timeline_htn/model/evaluate.hpp"
#include "tests/unit/planner_svc/timeline_htn/reading/texts.hpp"

namespace roci::planner::timeline_htn::reading {
namespace {

using model::Behaviour, model::Index, model::Model, model::NeedKind, model::State, model::StateKind;
using temporal::seconds;
using testing::ElementsAre;

Model rover() {
  EXPECT_EQ(faults_of(kSound), "");
  mission::Findings findings;
  return parse_model({{"m.yaml", kSound}}, findings).value_or(Model{});
}

TEST(TimelineModel, AComponentHasAllThatTheFileSays) {
  const Model model = rover();
  ASSERT_EQ(model.components.size(), 3U);
  EXPECT_EQ(model.components[0].layer, model::Layer::abstract);
  EXPECT_EQ(model.components[1].robot, "primary");
  const State& drive = model.components[1].states.at(1);
  EXPECT_EQ(drive.kind, StateKind::simple);
  EXPECT_EQ(drive.parameters.at(1).name, "to");
  EXPECT_EQ(drive.command->robot, "primary");
  EXPECT_EQ(drive.command->subsystem, "drive");
  EXPECT_EQ(drive.command->answer_within, seconds(5));
  EXPECT_EQ(drive.command->arguments.at(0).term, (model::Term{1, false}));
  EXPECT_EQ(drive.command->arguments.at(1).term, std::nullopt);
  EXPECT_EQ(drive.needs.at(1).kind, NeedKind::at_start);
  EXPECT_EQ(drive.contingency, "halt");
  EXPECT_EQ(drive.retries, 2U);
  EXPECT_EQ(model.components[1].states[0].observed->word, "parked");
  EXPECT_EQ(model.components[2].states[0].observed->word, "stowed");
  EXPECT_EQ(model.components[1].transitions.size(), 3U);
  EXPECT_EQ(model.components[0].transitions.size(), 2U);  // both ways
}

TEST(TimelineModel, ACommandMayHaveAPropertyOfAnObject) {
  const std::string text = with(kSound, "goal: to, gear: slow", "goal: to.x, gear: slow.x");
  EXPECT_EQ(faults_of(text), "");
  mission::Findings findings;
  const Model model = *parse_model({{"m.yaml", text}}, findings);
  const auto& arguments = model.components[1].states.at(1).command->arguments;
  const std::vector<Index> there{0, 1};
  EXPECT_EQ(model::text_of(model, arguments.at(0), there), "wp1.x");
  EXPECT_EQ(model::text_of(model, arguments.at(1), there), "slow.x") << "no parameter, so it is a text";
}

TEST(TimelineModel, DurationsAndTestsAreThoseOfTheObjects) {
  const Model model = rover();
  const State& drive = model.components[1].states.at(1);
  const std::vector<Index> there{0, 1}, back{1, 0}, nowhere{0, 0};
  EXPECT_EQ(model::bounds(model, drive, there)->shortest, seconds(8));
  EXPECT_EQ(model::bounds(model, drive, there)->longest, seconds(20));
  EXPECT_EQ(model::bounds(model, drive, back)->shortest, seconds(10));
  EXPECT_FALSE(model::bounds(model, drive, nowhere));
  for (const auto& test : drive.where) EXPECT_TRUE(model::holds(model, test, there));
  EXPECT_FALSE(model::holds(model, drive.where[0], nowhere));
  EXPECT_FALSE(model::holds(model, drive.where[1], nowhere));
  EXPECT_FALSE(model::holds(model, drive.where[2], nowhere));
}

TEST(TimelineModel, ABehaviourHasAllThatTheFileSays) {
  const Model model = rover();
  const Behaviour& step = model.behaviours.at(0);
  EXPECT_EQ(to_text(model, *step.achieves, step.variables), "navigation.traverse(from, to)");
  EXPECT_EQ(step.priority, 2);
  EXPECT_EQ(step.variables.at(2).name, "what");
  EXPECT_TRUE(step.conditions.at(1).negated);
  EXPECT_EQ(step.subgoals.at(1).contingency, "silence");
  ASSERT_EQ(step.constraints.size(), 2U);
  EXPECT_TRUE(step.constraints[0].from.end);
  EXPECT_EQ(step.constraints[0].to.subgoal, 1U);
  EXPECT_FALSE(step.constraints[1].from.subgoal);
  ASSERT_EQ(step.decisions.size(), 2U);
  EXPECT_EQ(step.decisions[0].choices.at(0).subgoals, std::vector<Index>{1});
  EXPECT_EQ(temporal::describe(step.decisions[0].choices[0].rule), "nav = parked");
  EXPECT_EQ(step.decisions[1].resolver, "console");
  EXPECT_EQ(step.decisions[1].variable, 2U);
  EXPECT_EQ(to_text(model, model.behaviours.at(1).triggers.at(0), model.behaviours[1].variables),
            "wheels.stuck(place)");
}

TEST(TimelineModel, EveryConstraintIsMadeOfPoints) {
  const auto constraints = [](const std::string& text) {
    mission::Findings findings;
    const auto model = parse_model({{"m.yaml", with(kSound, "drive before tell [0, 60]", text)}}, findings);
    EXPECT_TRUE(model) << errors_of(findings);
    return model ? model->behaviours[0].constraints.size() - 1 : 0;
  };
  EXPECT_EQ(constraints("drive before tell"), 1U);
  EXPECT_EQ(constraints("drive before tell before other [1, none]"), 2U);
  EXPECT_EQ(constraints("drive meets tell"), 1U);
  EXPECT_EQ(constraints("drive starts tell"), 1U);
  EXPECT_EQ(constraints("drive ends tell"), 1U);
  EXPECT_EQ(constraints("tell equals other"), 2U);
  EXPECT_EQ(constraints("tell during drive"), 2U);
  EXPECT_EQ(constraints("drive contains tell"), 2U);
}

TEST(TimelineModel, TheProblemSaysWhereItBegins) {
  const Model model = rover();
  ASSERT_TRUE(model.problem);
  EXPECT_EQ(model.problem->horizon, seconds(600));
  EXPECT_EQ(to_text(model, *model.problem->initial.at(1), {}), "wheels.at(wp0)");
  EXPECT_EQ(model.problem->goals.at(0).opens, seconds(5));
  EXPECT_EQ(model.problem->goals.at(0).release, seconds(0)) << "a window alone releases nothing later";
  EXPECT_THAT(model.problem->goals.at(1).after, ElementsAre(0U));
}

TEST(TimelineModel, ThreeTextsAreOneModel) {
  std::string domain = kSound;
  const std::size_t b = domain.find("behaviours:"), p = domain.find("problem:");
  mission::Findings findings;
  const auto parts = parse_model(
      {{"d", domain.substr(0, b)}, {"b", domain.substr(b, p - b)}, {"p", domain.substr(p)}}, findings);
  ASSERT_TRUE(parts) << errors_of(findings);
  EXPECT_EQ(*parts, rover());
}

TEST(TimelineModel, FilesIncludeOthersOnce) {
  const Model model = load_model({ROCI_SOURCE_DIR "/tests/missions/greenhouse/problem.yaml",
                                  ROCI_SOURCE_DIR "/tests/missions/greenhouse/domain.yaml"});
  EXPECT_EQ(model.name, "greenhouse");
  EXPECT_EQ(model.components.size(), 4U);
  EXPECT_EQ(model.behaviours.size(), 2U);
  EXPECT_EQ(model.relations.at(0).rows.size(), 6U);
}

TEST(TimelineModel, TheExampleOfTheDocumentationIsUsable) {
  std::ifstream in(ROCI_SOURCE_DIR "/docs/timeline-format.md");
  const std::string page{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const std::size_t from = page.find("# small.yaml");
  ASSERT_NE(from, std::string::npos);
  mission::Findings findings;
  const auto model =
      parse_model({{"small.yaml", page.substr(from, page.find("```", from) - from)}}, findings);
  ASSERT_TRUE(model) << errors_of(findings);
  EXPECT_EQ(findings.size(), 0U);
  EXPECT_EQ(model->behaviours.size(), 2U);
}

TEST(TimelineModel, WhatIsNoFileIsRefused) {
  EXPECT_THROW(load_model({ROCI_SOURCE_DIR "/gone.yaml"}), mission::FileError);
  EXPECT_THROW(load_model({ROCI_SOURCE_DIR}), mission::FileError);
  EXPECT_THROW(load_model(std::vector<std::filesystem::path>{}), mission::FileError);
}

}  // namespace
}  // namespace roci::planner::timeline_htn::reading
