#include "services/vendors/instance_table.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

namespace roci::services::vendors {
namespace {

transport::Guid writer(std::uint8_t number) {
  transport::Guid guid{};
  guid[15] = number;
  return guid;
}

transport::Payload payload_of(const InstanceTable::Key& key) {
  return transport::Payload(key.begin(), key.end());
}
InstanceTable::Key key_of(const transport::Payload& payload) {
  return InstanceTable::Key(payload.begin(), payload.end());
}

// Against the plainest model: a set of writers per living instance.
TEST(InstanceTable, AgreesWithAModelUnderRandomLives) {
  std::mt19937_64 random(7);
  InstanceTable table;
  std::map<InstanceTable::Key, std::set<transport::Guid>> model;
  for (int step = 0; step < 20000; ++step) {
    const InstanceTable::Key key(1, static_cast<char>('a' + random() % 20));
    const transport::Guid who = writer(static_cast<std::uint8_t>(random() % 5));
    const auto action = random() % 10;
    if (action < 7) {
      EXPECT_EQ(table.wrote(key, who), model.contains(key));
      if (!model.contains(key)) table.introduce(key, who, payload_of(key));
      model[key].insert(who);
    } else if (action < 9) {
      const auto ended = table.ended(key);
      ASSERT_EQ(ended.has_value(), model.erase(key) > 0);
      if (ended) {
        EXPECT_EQ(*ended, payload_of(key));
      }
    } else {
      std::multiset<InstanceTable::Key> expected;
      for (auto it = model.begin(); it != model.end();) {
        const bool orphaned = it->second.erase(who) > 0 && it->second.empty();
        if (orphaned) expected.insert(it->first);
        it = orphaned ? model.erase(it) : std::next(it);
      }
      std::multiset<InstanceTable::Key> orphans;
      for (const auto& orphan : table.writer_left(who)) {
        EXPECT_EQ(orphan.key, key_of(orphan.key_payload));
        orphans.insert(orphan.key);
      }
      EXPECT_EQ(orphans, expected);
    }
  }
}

}  // namespace
}  // namespace roci::services::vendors
