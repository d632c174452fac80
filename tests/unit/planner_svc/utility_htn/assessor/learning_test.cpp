#include "planner_svc/utility_htn/assessor/learning.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace {

namespace assessor = roci::planner::utility_htn::assessor;
namespace model = roci::planner::utility_htn::model;
using assessor::learn, assessor::Learned, assessor::Measured;
using model::Measure;
using roci::temporal::ImpactKind, roci::temporal::ImpactWhen;
using testing::ElementsAre, testing::HasSubstr, testing::IsEmpty;

// Task 0 and 1 sample site 0, task 2 site 1. A sample takes 60 s more than its parameter and
// draws 20 W more than its own.
class LearningTest : public testing::Test {
 protected:
  LearningTest() {
    network.timelines = {{"battery", roci::temporal::timelines::Kind::cumulative_rate}};
    for (const char* name : {"collect_s.0", "collect_w.0", "collect_s.1", "collect_w.1"})
      network.parameters.push_back({name, 100, 10, 1000, "chosen"});
    for (const model::ParameterIndex site : {0U, 0U, 1U}) {
      model::Task& task = network.tasks.emplace_back();
      task.id = "collect_" + std::to_string(network.tasks.size() - 1);
      task.duration = {60, 2 * site, 1};
      task.impacts = {{0, ImpactKind::rate, ImpactWhen::during, {-20, 2 * site + 1, -1}}};
      task.learns = {{Measure::duration_s, 2 * site}, {Measure::power, 2 * site + 1}};
    }
    values = model::priors(network);
  }
  double duration(model::TaskIndex task) const {
    return model::evaluate(network.tasks[task].duration, values);
  }
  double cost(model::TaskIndex task) const { return model::cost(network, network.tasks[task], values); }

  model::Network network;
  model::Values values;
};

TEST_F(LearningTest, LaterPredictionsEqualTheMeasurementAndOtherSitesStay) {
  const Learned learned = learn(network, 0, {400.0, {}, 35.0}, values);
  EXPECT_THAT(learned.replaced, ElementsAre(0, 1));
  EXPECT_THAT(learned.refused, IsEmpty());
  for (const model::TaskIndex task : {0U, 1U}) {
    EXPECT_DOUBLE_EQ(duration(task), 400);
    EXPECT_DOUBLE_EQ(cost(task), 400 * 35.0);
  }
  EXPECT_DOUBLE_EQ(duration(2), 160);
  EXPECT_DOUBLE_EQ(cost(2), 160 * 120.0);
}

TEST_F(LearningTest, PowerFollowsFromEnergyAndDuration) {
  learn(network, 0, {400.0, 18'000.0, {}}, values);
  EXPECT_DOUBLE_EQ(cost(1), 18'000);
}

TEST_F(LearningTest, AMeasurementOfEnergyIsMetByWhatTheTaskDrawsBeside) {
  network.tasks[0].learns = {{Measure::energy, 1}};
  learn(network, 0, {{}, 12'345.0, {}}, values);
  EXPECT_DOUBLE_EQ(cost(0), 12'345);
  EXPECT_DOUBLE_EQ(duration(0), 160);
}

TEST_F(LearningTest, WhatIsOutOfRangeIsRefusedAndTold) {
  const model::Values before = values;
  const Learned learned = learn(network, 0, {2000.0, {}, std::numeric_limits<double>::quiet_NaN()}, values);
  EXPECT_THAT(learned.replaced, IsEmpty());
  EXPECT_THAT(
      learned.refused,
      ElementsAre("the measured duration 2000 of 'collect_0' is not taken over: 'collect_s.0' would be 1940, "
                  "outside of 10 to 1000",
                  HasSubstr("it is not a number from 0 on")));
  EXPECT_EQ(values, before);
}

// Nothing of the task itself depends on it: it says what its site is worth.
TEST_F(LearningTest, AValueThatWasComputedOnBoardReplacesItsParameterAndNoOther) {
  for (const model::ParameterIndex site : {0U, 1U})
    network.parameters.push_back({"worth." + std::to_string(site), 0.5, 0, 1, "chosen"});
  values = model::priors(network);
  network.tasks[0].learns = {{Measure::value, 4, "worth"}};
  Measured measured;
  measured.values.emplace();
  EXPECT_THAT(
      learn(network, 0, measured, values).refused,
      ElementsAre("the value 'worth' of 'collect_0' is not taken over: its commands brought no number of "
                  "this name"));
  measured.values->emplace("worth", 1.5);
  EXPECT_THAT(
      learn(network, 0, measured, values).refused,
      ElementsAre("the value 'worth' 1.5 of 'collect_0' is not taken over: 'worth.0' would be 1.5, outside "
                  "of 0 to 1"));
  EXPECT_EQ(values, model::priors(network));
  measured.values->insert_or_assign("worth", 0.9);
  measured.values->emplace("depth", 0.1);
  EXPECT_THAT(learn(network, 0, measured, values).replaced, ElementsAre(4));
  EXPECT_EQ(values[4], 0.9);
  EXPECT_EQ(values[5], 0.5);
  measured.values.reset();
  EXPECT_THAT(learn(network, 0, measured, values).refused, IsEmpty()) << "the commands have not said yet";
}

TEST_F(LearningTest, AParameterThatTheTaskDoesNotUseIsNotReplaced) {
  network.tasks[0].learns = {{Measure::duration_s, 2}};
  EXPECT_THAT(learn(network, 0, {400.0, {}, {}}, values).refused,
              ElementsAre(HasSubstr("does not depend on 'collect_s.1'")));
}

}  // namespace
