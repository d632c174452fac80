// A record of steps gives back what was written, byte for byte, and tells what is no record.
#include "planner_svc/engine/step_record.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace roci::planner::engine {
namespace {

using temporal::seconds;
using testing::HasSubstr;

const RecordedEngine kEngine{"utility_htn", "lander", {"robust", "nearest"}, std::string("\0\xff model", 8)};

temporal::FlexiblePlan plan() {
  temporal::FlexiblePlan out;
  out.id = "p";
  out.version = 7;
  out.origin = seconds(3);
  out.point_count = 5;
  temporal::PlanActivity dig;
  dig.id = "dig#1.0";
  dig.arguments = {{"site", "near"}};
  dig.then.push_back(
      {.owner = "sim_svc", .robot = "", .subsystem = "arm", .command_name = "stow", .arguments = {}});
  dig.pre =
      temporal::all_of({temporal::compare("lamp", temporal::ConditionOp::eq, temporal::state("lit", {"a"})),
                        temporal::compare("battery", temporal::ConditionOp::ge, 0.1 + 0.2)});
  dig.impacts.push_back({"battery", temporal::ImpactKind::rate, temporal::ImpactWhen::during, -150.0});
  dig.lateness = temporal::LatenessPolicy::push;
  dig.utility = temporal::RankVector({0, 1e-300});
  out.activities.push_back(dig);
  out.tokens.push_back({"flag", true, 0, 1});
  out.decisions.push_back(
      {.id = "d", .resolver = "r", .choices = {{"c", {"dig#1.0"}, {}}}, .bindings = {{"a", "b"}}});
  out.constraints.push_back({1, 2, temporal::ConstraintKind::window, seconds(1), temporal::no_bound});
  out.function_values.push_back(
      {"f", {"x"}, 2.5, "owner", 3, seconds(4), temporal::FunctionAccuracy::estimate});
  return out;
}

StepInputs everything() {
  StepInputs out;
  out.now = seconds(12.5);
  Goal goal;
  goal.issuer = "ground\xc3";  // no text
  goal.id = "g";
  goal.kind = "request";
  goal.arguments = {{"task", "dig"}};
  goal.importance = GoalClass::optional;
  goal.utility = temporal::RankVector({1, 0.5});
  out.goals = {goal};
  out.ended_goals = {{"ground", "h", GoalState::dropped}};
  out.observations = {{"battery", 1.0 / 3, seconds(1)},
                      {"lamp", temporal::state("lit"), seconds(2)},
                      {"none", {}, seconds(3)},
                      {"high", std::numeric_limits<double>::infinity(), seconds(3)}};
  out.steps = {{7, "dig#1.0", {temporal::ActivityState::failed, seconds(1), std::nullopt}, "stuck", 2}};
  out.results = {{"dig#1.0", 1, 12.0, {{"depth", 0.25}}}};
  out.products = {
      {"p1", "image", "dig#1.0", DataTier::residual, 12'345, seconds(9), {}, DataFate::sent, seconds(10)}};
  out.model_changes = {{"ground", "n", std::string("\x00\x80", 2), "", 0},
                       {"ground", "v", std::nullopt, "power", 3}};
  out.receipt = Receipt{7, 6, "late", "battery", true};
  out.executed = plan();
  out.last_version = 7;
  return out;
}

StepOutput with_version(std::uint32_t version) {
  StepOutput out;
  out.account = {{"commit", "schedule"}, 12, {"a note"}};
  out.delta.emplace();
  out.delta->added = plan();
  out.delta->added.version = version;
  return out;
}

TEST(StepRecord, GivesBackWhatWasWritten) {
  const StepOutcome outcome = outcome_of(with_version(8));
  EXPECT_EQ(outcome.account, "commit, schedule; 12 explored; version 8; a note");
  const std::string entry = record_entry(everything());
  const std::string bytes = record_head(kEngine) + entry + record_entry(outcome) + record_entry(StepInputs{});
  StepRecordReader reader(bytes);
  EXPECT_EQ(reader.engine(), kEngine);
  const auto first = reader.next();
  ASSERT_TRUE(first);
  EXPECT_EQ(record_entry(first->inputs), entry);
  EXPECT_EQ(first->inputs.executed, plan());
  EXPECT_EQ(first->inputs.goals, everything().goals);
  EXPECT_EQ(first->inputs.products, everything().products);
  EXPECT_EQ(first->inputs.observations[0].value, temporal::Value(1.0 / 3));
  EXPECT_EQ(first->outcome, outcome);
  const auto second = reader.next();
  ASSERT_TRUE(second);
  EXPECT_FALSE(second->outcome) << "the process ended in it";
  EXPECT_FALSE(reader.next());
  EXPECT_FALSE(reader.cut_short());
}

TEST(StepRecord, TellsTwoVersionsApartByOneField) {
  StepOutput other = with_version(8);
  other.delta->added.activities[0].impacts[0].amount = -150.0000000001;
  EXPECT_NE(outcome_of(other), outcome_of(with_version(8)));
  EXPECT_EQ(outcome_of(with_version(8)), outcome_of(with_version(8)));
}

TEST(StepRecord, PassesOverAnEntryThatWasBeingWritten) {
  const std::string whole = record_head(kEngine) + record_entry(everything()) + record_entry(outcome_of({}));
  const std::size_t last = record_entry(outcome_of({})).size();
  for (std::size_t cut = 1; cut < last; ++cut) {
    const std::string bytes = whole.substr(0, whole.size() - cut);
    StepRecordReader reader(bytes);
    ASSERT_TRUE(reader.next());
    EXPECT_FALSE(reader.next());
    EXPECT_TRUE(reader.cut_short());
  }
}

std::string fault_of(const std::string& bytes) {
  try {
    StepRecordReader reader(bytes);
    while (reader.next()) continue;
  } catch (const StepRecordError& error) {
    return error.what();
  }
  return "";
}

TEST(StepRecord, RefusesWhatIsNoneWithThePlace) {
  std::string bytes = record_head(kEngine) + record_entry(everything());
  EXPECT_EQ(fault_of(bytes), "");
  EXPECT_THAT(fault_of("network: a\n"), HasSubstr("at byte 0: no record of planning steps"));
  EXPECT_THAT(fault_of(std::string(kStepRecordMagic) + "\x63"),
              HasSubstr("at byte 8: version 99 of the format"));
  EXPECT_THAT(fault_of(record_entry(everything())), HasSubstr("at byte 0: no record"));
  EXPECT_THAT(fault_of(record_head(kEngine) + record_entry(outcome_of({}))), HasSubstr("no step's inputs"));
  bytes[record_head(kEngine).size() + 20] ^= 1;
  EXPECT_THAT(fault_of(bytes), HasSubstr("the checksum of an entry is another"));
}

}  // namespace
}  // namespace roci::planner::engine
