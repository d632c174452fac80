// Our transports against participants that are not ours, so that the wire is proved against code of others:
// one side is a program on a vendor's own API with the vendor's own generated types.
#include <gmock/gmock.h>

#include "tests/contract/support/native_pairing.hpp"
#include "tests/contract/support/peers.hpp"

namespace roci::services::contract {
namespace {

class Native : public testing::TestWithParam<Pairing> {
 protected:
  process::DomainClaim domain_;
};

TEST_P(Native, KeyedStateReachesALateJoiner) {
  constexpr int kCount = 30;  // more than the ten instances that Fast DDS keeps by default
  Peer writer(GetParam().writer, "goal-writer", domain_.id());
  for (int i = 1; i <= kCount; ++i) {
    writer.send("write ground goal-" + std::to_string(i) + " " + std::to_string(i));
    writer.send("write ground goal-" + std::to_string(i) + " " + std::to_string(100 + i));
  }
  ASSERT_TRUE(writer.wait_for("ready"));
  Peer reader(GetParam().reader, "goal-reader", domain_.id());
  for (int i = 1; i <= kCount; ++i) {
    ASSERT_TRUE(reader.wait_for("goal ground goal-" + std::to_string(i) + " " + std::to_string(100 + i)));
  }
  EXPECT_EQ(writer.finish(), 0);
  EXPECT_EQ(reader.finish(), 0);
}

TEST_P(Native, AThousandKeysReachALateJoiner) {
  constexpr int kCount = 1000;
  Peer writer(GetParam().writer, "goal-writer", domain_.id());
  for (int i = 1; i <= kCount; ++i)
    writer.send("write ground goal-" + std::to_string(i) + " " + std::to_string(i));
  ASSERT_TRUE(writer.wait_for("ready"));
  Peer reader(GetParam().reader, "goal-reader", domain_.id());
  for (int i = 1; i <= kCount; ++i)
    ASSERT_TRUE(reader.wait_for("goal ground goal-" + std::to_string(i) + " " + std::to_string(i))) << i;
  EXPECT_EQ(writer.finish(), 0);
  EXPECT_EQ(reader.finish(), 0);
}

class NativeDispose : public Native {};

TEST_P(NativeDispose, EndsTheInstanceUntilItIsWrittenAgain) {
  Peer writer(GetParam().writer, "goal-writer", domain_.id());
  Peer reader(GetParam().reader, "goal-reader", domain_.id());
  for (const std::string id : {"photo", "an-identifier-that-is-longer-than-a-key-hash"}) {
    for (const std::string priority : {"1", "2"}) {
      writer.send("write ground " + id + " " + priority);
      ASSERT_TRUE(reader.wait_for("goal ground " + id + " " + priority));
    }
    writer.send("dispose ground " + id);
    ASSERT_TRUE(reader.wait_for("disposed ground " + id));
    writer.send("write ground " + id + " 3");
    ASSERT_TRUE(reader.wait_for("goal ground " + id + " 3"));
  }
  EXPECT_EQ(writer.finish(), 0);
  EXPECT_EQ(reader.finish(), 0);
}

INSTANTIATE_TEST_SUITE_P(Wire, Native, kEveryNativePairing, native_pairing_name);

// Without fastdds to native-cyclonedds: a Fast DDS writer disposes by key hash alone, and the generated types
// of Cyclone DDS cannot find the instance of a hash; no two native participants of these versions can either.
INSTANTIATE_TEST_SUITE_P(
    Wire, NativeDispose,
    testing::Values(Pairing{"native-fastdds", "fastdds"}, Pairing{"native-fastdds", "cyclonedds"},
                    Pairing{"native-cyclonedds", "fastdds"}, Pairing{"native-cyclonedds", "cyclonedds"},
                    Pairing{"fastdds", "native-fastdds"}, Pairing{"cyclonedds", "native-fastdds"},
                    Pairing{"cyclonedds", "native-cyclonedds"}),
    native_pairing_name);

}  // namespace
}  // namespace roci::services::contract
