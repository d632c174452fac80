// The functions of an arm as the mission declares them.
#include "arm_svc/functions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/mission/entry.hpp"
#include "tests/unit/arm_svc/arms.hpp"

namespace roci::arm {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

ArmModule read(const std::string& text) {
  return read_module(mission::Entry::parse(text, "mission.yaml"), test::rail_setup());
}

std::string error_of(const std::string& text) {
  try {
    read(text);
    return "no error";
  } catch (const mission::FileError& error) {
    return error.what();
  }
}

TEST(ArmFunctions, AreTheUsualTwoByDefault) {
  const ArmModule module = read("model: a\n");
  EXPECT_EQ(module.name, "arm");
  ASSERT_EQ(module.functions.size(), 2U);
  EXPECT_EQ(module.functions[0].name, "arm_move_time");
  EXPECT_EQ(module.functions[1].name, "arm_move_energy");
  EXPECT_EQ(module.functions[1].gives, Quantity::energy);
}

TEST(ArmFunctions, MeanWhatTheMissionSays) {
  const ArmModule module = read(R"(module: ef_orbitalrarmplanner
functions:
  ra_move_energy: {parameters: [slot], gives: energy, from: home, to: "?1"}
  ra_carry_dur: {parameters: [module, slot, slot], gives: duration, from: "?2", to: "?3",
                 payload: {mass_kg: "?1.mass_kg", size_m: [0.4, "?1.y_m", 0.4]}}
)");
  EXPECT_EQ(module.name, "ef_orbitalrarmplanner");
  ASSERT_EQ(module.functions.size(), 2U);
  const ArmFunction &move = module.functions[0], &carry = module.functions[1];
  EXPECT_THAT(move.parameters, ElementsAre("slot"));
  EXPECT_EQ(std::get<std::string>(move.from), "home");
  EXPECT_EQ(std::get<std::size_t>(move.to), 0U);
  EXPECT_FALSE(move.payload);
  EXPECT_THAT(carry.parameters, ElementsAre("module", "slot", "slot"));
  EXPECT_EQ(std::get<std::size_t>(carry.from), 1U);
  ASSERT_TRUE(carry.payload && carry.payload->size_m);
  EXPECT_EQ(std::get<ArgumentProperty>(carry.payload->mass_kg).key, "mass_kg");
  EXPECT_EQ(std::get<double>((*carry.payload->size_m)[0]), 0.4);
  EXPECT_EQ(std::get<ArgumentProperty>((*carry.payload->size_m)[1]).argument, 0U);
}

TEST(ArmFunctions, ErrorsNameThePlaceAndTheRemedy) {
  const auto with = [](const std::string& fields) {
    return error_of("functions:\n  f: {parameters: [slot], " + fields + "}\n");
  };
  EXPECT_THAT(with("gives: duration, from: home, to: \"?2\""),
              HasSubstr("mission.yaml:2:60: the function has 1 parameters, so there is no ?2"));
  EXPECT_THAT(with("gives: length, from: home, to: \"?1\""),
              HasSubstr("neither duration (s) nor energy (J)"));
  EXPECT_THAT(with("gives: energy, from: hoem, to: \"?1\""), HasSubstr("'hoem' is no pose"));
  EXPECT_THAT(with("gives: energy, from: home, to: \"?x\""), HasSubstr("'?x' is no argument"));
  EXPECT_THAT(with("gives: energy, from: home, to: \"?1.x\""), HasSubstr("a place is a whole argument"));
  EXPECT_THAT(with("gives: energy, from: home"), HasSubstr("'to' is missing"));
  EXPECT_THAT(with("gives: energy, from: home, to: \"?1\", payload: {mass_kg: \"?1\"}"),
              HasSubstr("say which property"));
  EXPECT_THAT(with("gives: energy, from: home, to: \"?1\", payload: {mass_kg: -1}"), HasSubstr("0 or more"));
  EXPECT_THAT(with("gives: energy, from: home, to: \"?1\", payload: {mass_kg: 1, size_m: [1, 1]}"),
              HasSubstr("three edges"));
  EXPECT_THAT(with("gives: energy, from: home, to: \"?1\", pay: 1"), HasSubstr("unknown key 'pay'"));
  EXPECT_THAT(error_of("module: \"two words\"\n"),
              HasSubstr("mission.yaml:1:9: 'two words' is no name of PDDL"));
  EXPECT_THAT(error_of("functions: {}\n"), HasSubstr("names no function"));
  EXPECT_THAT(error_of("functions:\n  f: {parameters: [], gives: energy, from: home, to: s0}\n"
                       "  f: {parameters: [], gives: energy, from: home, to: s0}\n"),
              HasSubstr("stands twice"));
}

}  // namespace
}  // namespace roci::arm
