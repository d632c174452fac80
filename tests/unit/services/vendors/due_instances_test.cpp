#include "services/vendors/due_instances.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

namespace roci::services::vendors {
namespace {

using Key = DueInstances::Key;

struct Change {
  int number = 0;  // 0: given back to the pool
  Key key{};
  bool unregisters = false;
};

/// The history of a keep-last, transient-local writer of Fast DDS 2.9.1, with the walk of
/// StatefulWriter::check_acked_status and what it calls: changes are pointers in an array, and what is taken out leaves
/// the places behind the end as they were.
class History {
 public:
  explicit History(int depth) : depth_(static_cast<std::size_t>(depth)) {}

  void write(const Key& key, bool unregisters = false) {
    auto& of_key = instances_[key];
    if (of_key.size() >= depth_) take_out(of_key, 1);
    changes_.push_back({++newest_, key, unregisters});
    of_key.push_back(newest_);
    places_.resize(size_);
    places_.push_back(newest_);
    ++size_;
  }

  /// Every reader has confirmed everything. False: the walk does not end.
  bool confirm() {
    if (size_ == 0 || next_ > newest_) return true;
    const int end = std::max(places_.front(), next_);
    std::size_t at = size_ - 1;
    for (int steps = 0; steps < 100'000; ++steps) {
      const Change change = at_place(at);
      if (change.number < next_) break;
      if (at != 0) --at;
      if (change.unregisters) remove_instance(change.key, change.number);
      if (change.number <= end) break;
      if (steps == 99'999) return false;
    }
    next_ = newest_ + 1;
    return true;
  }

  std::size_t size() const { return size_; }
  std::set<Key> keys() const {
    std::set<Key> out;
    for (const auto& [key, of_key] : instances_) out.insert(key);
    return out;
  }

 private:
  const Change& of(int number) { return changes_[static_cast<std::size_t>(number - 1)]; }
  // A place behind the end still names what was there: a change that lives, or one that was given back.
  Change at_place(std::size_t place) {
    const int number = places_[place];
    const auto end = places_.begin() + static_cast<std::ptrdiff_t>(size_);
    return std::find(places_.begin(), end, number) == end ? Change{} : of(number);
  }
  void take_out(std::vector<int>& of_key, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const auto end = places_.begin() + static_cast<std::ptrdiff_t>(size_);
      const auto found = std::find(places_.begin(), end, of_key[i]);
      std::copy(found + 1, end, found);  // and the last place stays as it was
      --size_;
    }
    of_key.erase(of_key.begin(), of_key.begin() + static_cast<std::ptrdiff_t>(count));
  }
  void remove_instance(const Key& key, int up_to) {
    const auto found = instances_.find(key);
    if (found == instances_.end()) return;
    auto& of_key = found->second;
    take_out(of_key,
             static_cast<std::size_t>(std::ranges::count_if(of_key, [&](int n) { return n <= up_to; })));
    if (of_key.empty()) instances_.erase(found);
  }

  std::size_t depth_;
  std::vector<Change> changes_;  // all there ever were
  std::vector<int> places_;
  std::size_t size_ = 0;
  std::map<Key, std::vector<int>> instances_;
  int newest_ = 0, next_ = 1;
};

DueInstances::Instance instance(const Key& key) { return {key, {}}; }

void write(History& history, const DueInstances::Group& group) {
  for (const auto& due : group.unregistered) history.write(due.key, true);
  for (int i = 0; i < group.times; ++i) history.write(group.kept->key);
}

TEST(DueInstances, WithoutThemTheWalkOfTheVendorNeverEnds) {
  History history(32);
  for (const char* key : {"a", "b", "a", "c"}) history.write(key, history.size() == 2);
  EXPECT_FALSE(history.confirm());
}

// Random lives at every depth: each walk ends, and nothing is left of what was to be forgotten but one instance.
TEST(DueInstances, EachWalkEndsAndMissesNothing) {
  for (int seed = 0; seed < 300; ++seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    const int depth = static_cast<int>(1 + random() % 12);
    History history(depth);
    DueInstances due(depth);
    int made = 0;
    std::set<Key> alive, forgotten;
    const auto written = [&](const Key& key) {
      due.changed(key);
      history.write(key);
      alive.insert(key);
      forgotten.erase(key);
    };
    for (int step = 0; step < 400; ++step) {
      const auto action = random() % 10;
      if (action < 4) {
        written("new" + std::to_string(made++));
      } else if (action < 6 && !alive.empty()) {
        written(*std::next(alive.begin(), static_cast<std::ptrdiff_t>(random() % alive.size())));
      } else if (action < 8 && !alive.empty()) {
        const Key key = *std::next(alive.begin(), static_cast<std::ptrdiff_t>(random() % alive.size()));
        if (!due.forget(instance(key))) history.write(key);
        alive.erase(key);
        forgotten.insert(key);
      } else if (action == 8) {
        ASSERT_TRUE(history.confirm()) << "seed " << seed << " step " << step;
        if (due.waiting() == 0) continue;
        write(history, due.take());
        for (auto later = random() % 3; later > 0; --later) written("new" + std::to_string(made++));
      } else if (!forgotten.empty() && random() % 20 == 0) {
        written(*forgotten.begin());  // it lives again, whether it was forgotten or waits for that
      }
    }
    ASSERT_TRUE(history.confirm()) << "seed " << seed;
    write(history, due.take());
    ASSERT_TRUE(history.confirm()) << "seed " << seed;
    std::set<Key> left = history.keys();
    for (const Key& key : alive) EXPECT_EQ(left.erase(key), 1U) << "seed " << seed << ": lost " << key;
    EXPECT_LE(left.size(), 1U) << "seed " << seed << " depth " << depth;
  }
}

TEST(DueInstances, WhatIsWrittenAgainIsNotForgotten) {
  DueInstances due(1);
  EXPECT_TRUE(due.forget(instance("a")));
  EXPECT_TRUE(due.forget(instance("b")));
  due.changed("a");
  const auto group = due.take();
  ASSERT_EQ(group.unregistered.size(), 1U);
  EXPECT_EQ(group.unregistered.front().key, "b");
  EXPECT_EQ(group.times, 0);
  EXPECT_EQ(due.waiting(), 0U);
}

TEST(DueInstances, OneIsKeptWhereOlderChangesAreTakenOut) {
  DueInstances due(32);
  for (const char* key : {"a", "b", "c", "c", "c"}) due.changed(key);
  EXPECT_FALSE(due.forget(instance("a")));
  EXPECT_FALSE(due.forget(instance("a")));
  EXPECT_TRUE(due.forget(instance("b")));
  EXPECT_TRUE(due.forget(instance("c")));
  const auto group = due.take();
  EXPECT_EQ(group.unregistered.size(), 2U);
  EXPECT_EQ(group.kept->key, "a");
  EXPECT_EQ(group.times, 3);
}

}  // namespace
}  // namespace roci::services::vendors
