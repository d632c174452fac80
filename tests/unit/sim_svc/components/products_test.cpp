#include "sim_svc/components/products.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim_svc/components/argument_slots.hpp"
#include "tests/unit/sim_svc/world_fixture.hpp"

namespace roci::sim::components {

using temporal::seconds;
using testing::HasSubstr;
using world::Tier;

namespace {

std::vector<ProductForm> read(const std::string& text) {
  return read_products(mission::Entry::parse(text, "m.yaml"), "look", {"site"});
}

std::string error_of(const std::string& text) {
  try {
    read(text);
  } catch (const mission::FileError& error) {
    return error.what();
  }
  return "no error";
}

// A robot's body with room for 100 bytes, and what is said.
struct Bench {
  std::string robot = "lander";
  world::Environment environment;
  world::Body body;
  world::ComponentSet components;
  world::Outputs out;
  world::Surroundings around{robot, environment, body, components, out};
  world::RandomStream noise{1, "test"};
  Bench() { body.data.emplace(100); }

  world::Ending make(const std::vector<ProductForm>& forms, double content = 1) {
    return make_products(forms, {"look_1#2", 1}, {{"site", "0"}}, content, seconds(7), noise, around);
  }
};

TEST(Products, AreReadInOrderOfTheirTiers) {
  const auto forms = read(
      "raw_{site}: {tier: residual, bytes: 30e6}\n"
      "trench_{site}: {tier: decisional, bytes: 3e6, bytes_noise: 0.1, utility: [0, 0.3]}\n");
  ASSERT_EQ(forms.size(), 2u);
  EXPECT_EQ(forms[0].kind, "trench_{site}");
  EXPECT_EQ(forms[0].tier, Tier::decisional);
  EXPECT_EQ(forms[0].bytes_noise, 0.1);
  EXPECT_EQ(forms[0].utility, (std::vector<double>{0, 0.3}));
  EXPECT_EQ(forms[1].bytes, 30e6);
}

TEST(Products, RefuseWhatCannotBe) {
  EXPECT_THAT(error_of("a: {tier: urgent}\n"), HasSubstr("m.yaml:1:11: unknown tier 'urgent'"));
  EXPECT_THAT(error_of("a_{target}: {}\n"), HasSubstr("names no argument of 'look'"));
  EXPECT_THAT(error_of("a: {bytes: 0}\n"), HasSubstr("at least"));
  EXPECT_THAT(error_of("a: {bytes: 1e99}\n"), HasSubstr("more than anybody could send"));
  EXPECT_THAT(error_of("a: {size: 3}\n"), HasSubstr("m.yaml:1:"));
}

TEST(Products, AreStoredAndTold) {
  Bench bench;
  EXPECT_FALSE(bench.make({{"trench_{site}", Tier::decisional, 30, 0, {0.3}}}, 1.5));
  ASSERT_EQ(bench.out.size(), 1u);
  const world::Product told = std::get<world::Product>(bench.out.front());
  const world::Product expected{"trench_0",       "trench_0",          "lander",   "look_1#2", 45,
                                Tier::decisional, world::Fate::stored, seconds(7), {0.3}};
  EXPECT_EQ(told, expected);
  EXPECT_EQ(*bench.body.data->find("trench_0"), expected);
}

TEST(Products, VaryByTheSeed) {
  Bench bench;
  bench.body.data.emplace(1e12);
  bench.make(std::vector<ProductForm>(50, {"a", Tier::mandatory, 1e6, 0.1}));
  double sum = 0, least = 1e9;
  for (const world::Product& one : bench.body.data->products()) {
    sum += static_cast<double>(one.bytes);
    least = std::min(least, static_cast<double>(one.bytes));
  }
  EXPECT_NEAR(sum / 50, 1e6, 5e4);
  EXPECT_LT(least, 9e5);
}

TEST(Products, WithoutRoomTheMoreUrgentIsKeptAndTheOtherNamed) {
  Bench bench;
  const world::Ending ending = bench.make({{"summary", Tier::decisional, 60}, {"raw", Tier::mandatory, 60}});
  ASSERT_TRUE(ending);
  EXPECT_EQ(ending->code, "data-full");
  EXPECT_THAT(ending->reason, HasSubstr("for raw;"));
  EXPECT_NE(bench.body.data->find("summary"), nullptr);
}

TEST(Products, ARobotWithoutAStoreMakesNone) {
  Bench bench;
  bench.body.data.reset();
  EXPECT_EQ(bench.make({{"a"}})->code, "no-store");
  EXPECT_FALSE(bench.make({}));
}

}  // namespace
}  // namespace roci::sim::components
