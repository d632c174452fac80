#include "sim_svc/world/data_store.hpp"

#include <gtest/gtest.h>

namespace roci::sim::world {
namespace {

Product of(const std::string& kind, std::uint64_t bytes) {
  Product out;
  out.kind = kind;
  out.bytes = bytes;
  return out;
}

TEST(DataStore, GivesEachProductAnIdThatNoOtherHad) {
  DataStore store(100);
  EXPECT_EQ(store.add(of("quakes", 10))->id, "quakes");
  EXPECT_EQ(store.add(of("panorama", 10))->id, "panorama");
  EXPECT_EQ(store.add(of("quakes", 10))->id, "quakes-2");
  store.set_fate("quakes-2", Fate::discarded);
  EXPECT_EQ(store.add(of("quakes", 10))->id, "quakes-3") << "what was discarded keeps its name";
  EXPECT_EQ(store.products().size(), 3u);
}

TEST(DataStore, RefusesWhatDoesNotFitAndStaysAsItWas) {
  DataStore store(100);
  ASSERT_TRUE(store.add(of("a", 60)));
  EXPECT_FALSE(store.add(of("b", 41)));
  EXPECT_EQ(store.used_bytes(), 60);
  EXPECT_TRUE(store.add(of("b", 40)));
  EXPECT_EQ(store.find("b")->id, "b") << "the refused one took no name";
}

TEST(DataStore, WhatIsSentMakesRoomAndStaysUntilItIsReceived) {
  DataStore store(100);
  store.add(of("a", 100));
  EXPECT_EQ(store.set_fate("a", Fate::sent)->fate, Fate::sent);
  EXPECT_EQ(store.used_bytes(), 0);
  EXPECT_TRUE(store.add(of("b", 100)));
  ASSERT_NE(store.find("a"), nullptr);
  EXPECT_EQ(store.set_fate("a", Fate::received)->fate, Fate::received);
  EXPECT_EQ(store.find("a"), nullptr);
  EXPECT_FALSE(store.set_fate("a", Fate::lost)) << "a final fate is the last";
}

TEST(DataStore, GoesOnFromItsMemory) {
  DataStore store(100);
  store.add(of("a", 10));
  store.add(of("a", 10));
  store.set_fate("a", Fate::sent);
  DataStore next(100);
  next.restore(store.memory());
  EXPECT_EQ(next.products(), store.products());
  EXPECT_EQ(next.add(of("a", 1))->id, "a-3");
}

TEST(DataStore, KnowsTiersByName) {
  EXPECT_EQ(tier_named("decisional"), Tier::decisional);
  EXPECT_EQ(tier_named("urgent"), std::nullopt);
}

}  // namespace
}  // namespace roci::sim::world
