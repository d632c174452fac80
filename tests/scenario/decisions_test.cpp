// Decisions of the running plan through real processes, for each resolver: on time, late, unknown, twice, with
// the executive killed between question and answer, and after a take-over by the standby.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenario/scripted_world/flight.hpp"

namespace roci::scenario {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;

// Enumerators of idl/order.idl.
constexpr int kTaken = 0, kLate = 1, kRepeated = 2, kUnknownChoice = 4, kNotEntitled = 5;
constexpr int kAnswered = 1, kMissed = 2;

struct Case {
  const char* name;
  const char* resolver;
  const char* dds;
  const char* crash;
  const char* more;
  int starts;  // at least so many of the executive
};

class Decisions : public ::testing::TestWithParam<Case> {};

TEST_P(Decisions, AreAskedAnsweredAndKept) {
  const Case& one = GetParam();
  const bool rule = std::string(one.resolver) == "rule";
  const ScriptedFlight flight =
      fly_scripted("ROCI_TEST_SCRIPT=decisions ROCI_TEST_RESOLVER=" + std::string(one.resolver) +
                       " ROCI_CRASH=" + one.crash,
                   std::string("--dds ") + one.dds + one.more);
  EXPECT_EQ(flight.exit_code, 0);
  EXPECT_EQ(flight.summary.value("result", ""), "achieved");
  EXPECT_THAT(flight.images,
              ElementsAre("image-look", "image-r1", "image-r2", "image-r3", "image-r4", "image-end"))
      << "as the answers say";
  ASSERT_TRUE(flight.heard.is_object());
  for (const auto& [image, times] : flight.heard["begun"].items()) EXPECT_EQ(times, 1) << image;
  const nlohmann::json questions{{"d1", kAnswered}, {"d2", kAnswered},  {"d3", kAnswered},
                                 {"d4", kMissed},   {"d4b", kAnswered}, {"what", kAnswered}};
  EXPECT_EQ(flight.heard["questions"], questions) << "by the topic";
  const std::string by = std::string(one.resolver) == "engine" ? "scripted/" : "ground/";
  const nlohmann::json receipts =
      rule ? nlohmann::json{{"ground/d2", kNotEntitled}, {"ground/w", kTaken}}
           : nlohmann::json{{by + "d1", kTaken},          {by + "d2", kRepeated},
                            {by + "d2-again", kRepeated}, {by + "d3-up", kUnknownChoice},
                            {by + "d3", kTaken},          {by + "d4", kLate},
                            {by + "d4b", kTaken},         {"ground/w", kTaken}};
  EXPECT_EQ(flight.heard["receipts"], receipts) << "by the topic";
  EXPECT_THAT(flight.answered, Contains(by + "d2 0").Times(rule ? 0 : 1)) << "the first of them was taken";
  EXPECT_EQ(flight.answered.size(), rule ? 2U : 9U) << "nothing that is heard again is answered again";
  EXPECT_EQ(flight.count("plan.broken"), 1) << "by the one that was missed";
  EXPECT_GE(flight.summary.value("epoch", 0), one.starts);
  EXPECT_EQ(flight.count("executive.resumed"), flight.summary.value("epoch", 0) > 1 ? one.starts - 1 : 0);
  EXPECT_EQ(flight.count("journal.diverged"), 0);
  EXPECT_EQ(flight.replayed.value("same", false), true) << flight.replayed;
}

constexpr char kAtQuestions[] = "after-question:1,after-question:1,after-question:1";

INSTANTIATE_TEST_SUITE_P(
    Resolvers, Decisions,
    ::testing::Values(Case{"engine", "engine", "cyclonedds", "", "", 1},
                      Case{"engine_killed", "engine", "fastdds", kAtQuestions, "", 4},
                      Case{"ground_killed", "ground", "cyclonedds", kAtQuestions, "", 4},
                      Case{"rule_killed", "rule", "cyclonedds", kAtQuestions, "", 4},
                      Case{"engine_taken_over", "engine", "cyclonedds", "after-question:1", " --standby", 2},
                      Case{"ground_taken_over", "ground", "fastdds", "after-question:2", " --standby", 2},
                      Case{"rule_taken_over", "rule", "cyclonedds", "after-question:1", " --standby", 2}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace roci::scenario
