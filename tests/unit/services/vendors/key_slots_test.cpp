#include "services/vendors/key_slots.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <string>

namespace roci::services::vendors {
namespace {

KeySlots::KeyHash hash_of(std::uint32_t number) {
  KeySlots::KeyHash hash{};
  for (std::size_t i = 0; i < 4; ++i) hash[i] = static_cast<std::uint8_t>(number >> 8 * i);
  return hash;
}

std::string text(const KeySlots::Handle& handle) { return {handle.begin(), handle.end()}; }

TEST(KeySlots, AHeldSlotIsThatOfItsKeyForAsLongAsItIsHeld) {
  KeySlots slots;
  const std::string handle = text(slots.handle_of(hash_of(0)));
  ASSERT_TRUE(slots.hold(handle));
  ASSERT_TRUE(slots.hold(handle)) << "by another reader";
  slots.release(handle);
  std::set<std::string> others;
  for (std::uint32_t i = 1; i <= 3 * KeySlots::kSlots; ++i) others.insert(text(slots.handle_of(hash_of(i))));
  EXPECT_FALSE(others.contains(handle));
  EXPECT_EQ(others.size(), KeySlots::kIdle);
  EXPECT_EQ(text(slots.handle_of(hash_of(0))), handle);
}

TEST(KeySlots, WhatIsNotHeldIsGivenAnewAfterAsManyOthers) {
  KeySlots slots;
  const std::string first = text(slots.handle_of(hash_of(0)));
  for (std::uint32_t i = 1; i < KeySlots::kIdle; ++i) ASSERT_NE(text(slots.handle_of(hash_of(i))), first);
  EXPECT_EQ(text(slots.handle_of(hash_of(0))), first) << "and begins to wait anew";
  for (std::uint32_t i = 1; i < KeySlots::kIdle; ++i)
    ASSERT_NE(text(slots.handle_of(hash_of(i + 1'000'000))), first);
  EXPECT_EQ(text(slots.handle_of(hash_of(9'000'000))), first);
}

TEST(KeySlots, NoMoreAreHeldThanATopicFollows) {
  KeySlots slots;
  std::string last;
  for (std::uint32_t i = 0; i < KeySlots::kHeld; ++i)
    ASSERT_TRUE(slots.hold(last = text(slots.handle_of(hash_of(i)))));
  EXPECT_EQ(slots.held(), KeySlots::kHeld);
  const std::string another = text(slots.handle_of(hash_of(5'000'000)));
  EXPECT_FALSE(slots.hold(another));
  EXPECT_TRUE(slots.hold(last)) << "what is held already";
  slots.release(last);
  slots.release(last);
  EXPECT_TRUE(slots.hold(another));
}

TEST(KeySlots, AHandleThatNamesNoSlotIsRefused) {
  KeySlots slots;
  std::string handle = text(slots.handle_of(hash_of(0)));
  EXPECT_FALSE(slots.hold("")) << "nothing";
  EXPECT_FALSE(slots.hold(text(hash_of(7)))) << "a key hash";
  ++handle.back();
  EXPECT_FALSE(slots.hold(handle)) << "a slot that was never given";
  slots.release(handle);
  EXPECT_EQ(slots.held(), 0U);
}

// Readers that follow some keys, among many that nobody follows: what is held never changes, and no two keys share it.
TEST(KeySlots, AgreesWithAModelUnderRandomLives) {
  std::mt19937_64 random(11);
  KeySlots slots;
  std::map<std::uint32_t, std::pair<std::string, int>> followed;
  for (int step = 0; step < 400'000; ++step) {
    const auto number = static_cast<std::uint32_t>(random() % 3 == 0 ? random() % 500 : random() % 200'000);
    const std::string handle = text(slots.handle_of(hash_of(number)));
    const auto known = followed.find(number);
    if (known != followed.end()) {
      ASSERT_EQ(known->second.first, handle);
      if (random() % 2 == 0) {
        slots.release(handle);
        if (--known->second.second == 0) followed.erase(known);
        continue;
      }
    }
    if (random() % 4 != 0) continue;
    ASSERT_TRUE(slots.hold(handle));
    auto& [name, times] = followed[number];
    name = handle;
    ++times;
    ASSERT_EQ(slots.held(), followed.size());
  }
  std::set<std::string> names;
  for (const auto& [number, one] : followed) names.insert(one.first);
  EXPECT_EQ(names.size(), followed.size());
}

}  // namespace
}  // namespace roci::services::vendors
