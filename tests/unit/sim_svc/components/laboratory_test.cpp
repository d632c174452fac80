// What the laboratory finds in the samples that it is brought.
#include "sim_svc/components/laboratory.hpp"

#include <gtest/gtest.h>

#include "tests/unit/sim_svc/sampler.hpp"

namespace roci::sim::components {
namespace {

using temporal::State;

// A sampler that has brought the sample to the inlet.
SamplerFlight delivered(const Sampler& sampler, const std::string& site, const std::string& target,
                        std::uint64_t seed = 1) {
  SamplerFlight run(sampler, seed);
  run.arm("prepare");
  run.arm("excavate", {{"site", site}});
  run.arm("collect", {{"site", site}, {"target", target}});
  EXPECT_EQ(run.arm("transport"), "done");
  return run;
}

TEST(Laboratory, KnowsNothingOfAnySampleAtFirst) {
  const SamplerFlight run;
  for (const char* sample : {"0_0", "0_1", "1_0", "1_1"})
    EXPECT_EQ(run.state(std::string("lander.signature.") + sample), (State{"unknown", {}}));
  EXPECT_EQ(run.state("lander.laboratory"), (State{"idle", {}}));
}

TEST(Laboratory, LooksWithOneInstrumentAfterTheOtherAndSaysWhatIsTrue) {
  SamplerFlight run = delivered({}, "0", "0");
  run.start("laboratory", "analyze", {{"site", "0"}, {"target", "0"}, {"form", "raw"}});
  EXPECT_EQ(run.state("lander.laboratory"), (State{"analyzing", {"0", "0", "mass-spectrometer"}}));
  run.pass(5401);
  EXPECT_EQ(run.state("lander.laboratory"), (State{"analyzing", {"0", "0", "microscope"}}));
  run.pass(1800);
  EXPECT_EQ(run.state("lander.laboratory"), (State{"analyzing", {"0", "0", "raman-spectrometer"}}));
  EXPECT_EQ(run.state("lander.signature.0_0"), (State{"unknown", {}}));
  run.pass(2700);
  EXPECT_EQ(run.code(run.newest), "done");
  EXPECT_NEAR(run.joules_taken(), 5400 * 120 + 1800 * 30 + 2700 * 60, 1);
  EXPECT_EQ(run.state("lander.signature.0_0"), (State{"positive", {}}));
  EXPECT_EQ(run.state("lander.signature.0_1"), (State{"unknown", {}}));
  run.arm("collect", {{"site", "0"}, {"target", "1"}});
  run.arm("transport");
  EXPECT_EQ(run.analyze("0", "1"), "done");
  EXPECT_EQ(run.state("lander.signature.0_1"), (State{"negative", {}}));
}

TEST(Laboratory, NeedsThatVerySampleInItsInlet) {
  SamplerFlight run;
  EXPECT_EQ(run.analyze("0", "0"), "no-sample");
  run = delivered({}, "0", "1");
  EXPECT_EQ(run.analyze("0", "0"), "no-sample");
  EXPECT_EQ(run.analyze("0", "7"), "unknown-sample");
  EXPECT_EQ(run.state("lander.signature.0_0"), (State{"unknown", {}}));
}

TEST(Laboratory, DrawsWhatIsNotGivenByTheSeed) {
  const auto found = [](double share, std::uint64_t seed) {
    Sampler sampler;
    sampler.laboratory.positive_share = share;
    SamplerFlight run = delivered(sampler, "1", "1", seed);
    EXPECT_EQ(run.analyze("1", "1"), "done");
    return run.state("lander.signature.1_1").name;
  };
  EXPECT_EQ(found(0, 1), "negative");
  EXPECT_EQ(found(1, 1), "positive");
  int positive = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) positive += found(0.5, seed) == "positive" ? 1 : 0;
  EXPECT_GT(positive, 3);
  EXPECT_LT(positive, 17);
}

TEST(Laboratory, AStoppedAnalysisFindsNothingAndAHollowOneNeither) {
  SamplerFlight run = delivered({}, "0", "0");
  const std::string first =
      run.start("laboratory", "analyze", {{"site", "0"}, {"target", "0"}, {"form", "raw"}});
  run.pass(6000);
  run.command(run.now, execute("halt", "laboratory", "stop"));
  EXPECT_EQ(run.stage(first), services::owner::Stage::cancelled);
  EXPECT_EQ(run.state("lander.laboratory"), (State{"idle", {}}));
  run.disturb(run.now, world::HollowSuccess{"lander", "laboratory", "analyze"});
  EXPECT_EQ(run.analyze("0", "0"), "done");
  EXPECT_EQ(run.state("lander.signature.0_0"), (State{"unknown", {}}));
  EXPECT_EQ(run.analyze("0", "0"), "done");
  EXPECT_EQ(run.state("lander.signature.0_0"), (State{"positive", {}}));
}

// Sizes of the products that were said to be on board, by kind.
std::map<std::string, std::uint64_t> stored(const SamplerFlight& run) {
  std::map<std::string, std::uint64_t> out;
  for (const world::Output& one : run.said)
    if (const auto* product = std::get_if<world::Product>(&one)) out[product->kind] = product->bytes;
  return out;
}

Sampler with_products() {
  Sampler out;
  const ProductForm summary{"summary_{site}_{target}", world::Tier::decisional, 1e6, 0, {0.1}};
  out.laboratory.products = {
      {"raw", {summary, {"raw_{site}_{target}", world::Tier::mandatory, 30e6, 0, {}}}},
      {"compressed", {summary, {"compressed_{site}_{target}", world::Tier::mandatory, 8e6, 0, {}}}}};
  return out;
}

TEST(Laboratory, MakesTheProductsOfTheFormAndMoreOfWhatHoldsASignature) {
  SamplerFlight run = delivered(with_products(), "0", "0");
  EXPECT_EQ(run.analyze("0", "0", "cooked"), "unknown-form");
  EXPECT_EQ(run.analyze("0", "0", "raw"), "done");
  EXPECT_EQ(stored(run),
            (std::map<std::string, std::uint64_t>{{"summary_0_0", 1200000}, {"raw_0_0", 36000000}}));
  run.arm("collect", {{"site", "0"}, {"target", "1"}});
  run.arm("transport");
  EXPECT_EQ(run.analyze("0", "1", "compressed"), "done");
  EXPECT_EQ(stored(run).at("summary_0_1"), 1000000u);
  EXPECT_EQ(stored(run).at("compressed_0_1"), 8000000u);
  EXPECT_FALSE(stored(run).contains("raw_0_1"));
}

TEST(Laboratory, WithoutRoomOnBoardTheSignatureIsKnownAndTheProductLost) {
  Sampler sampler = with_products();
  sampler.data_bytes = 5e6;
  SamplerFlight run = delivered(sampler, "0", "0");
  EXPECT_EQ(run.analyze("0", "0", "raw"), "data-full");
  EXPECT_EQ(run.state("lander.signature.0_0"), (State{"positive", {}}));
  EXPECT_TRUE(stored(run).contains("summary_0_0")) << "the more urgent one had room";
  EXPECT_FALSE(stored(run).contains("raw_0_0"));
}

TEST(Laboratory, AHollowAnalysisBringsNoProduct) {
  SamplerFlight run = delivered(with_products(), "0", "0");
  run.disturb(run.now, world::HollowSuccess{"lander", "laboratory", "analyze"});
  EXPECT_EQ(run.analyze("0", "0", "raw"), "done");
  EXPECT_TRUE(stored(run).empty());
}

TEST(Laboratory, WarmsItsZoneFirst) {
  Sampler sampler;
  sampler.make_cold();
  SamplerFlight run = delivered(sampler, "0", "0");
  EXPECT_EQ(run.analyze("0", "0"), "done");
  EXPECT_GT(run.seconds_taken(), 9900 + 7000) << "20 kJ/K through 70 K at less than 200 W";
  EXPECT_GT(run.joules_taken(), 5400 * 120 + 1800 * 30 + 2700 * 60 + 20000 * 70);
}

TEST(Laboratory, RemembersWhatItFoundWhenItsProcessIsStartedAgain) {
  SamplerFlight run = delivered({}, "0", "0");
  run.analyze("0", "0");
  world::World again(Sampler().build(), 1);
  again.restore(run.world.memory());
  const world::Outputs said = again.advance(run.now);
  EXPECT_EQ(last_value(said, "lander.signature.0_0"), temporal::state("positive"));
  EXPECT_EQ(last_value(said, "lander.signature.0_1"), temporal::state("unknown"));
}

}  // namespace
}  // namespace roci::sim::components
