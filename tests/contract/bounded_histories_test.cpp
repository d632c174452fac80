// What the vendors themselves keep is bounded: of a writer whose reader has stopped, and of a reader whose writer
// floods it with keys.
#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <condition_variable>
#include <cstdlib>
#include <fstream>
#include <mutex>

#include "services/topics/topics.hpp"
#include "services/transport/scope.hpp"
#include "services/transport/type_support.hpp"
#include "services/vendors/history_limits.hpp"
#include "services/vendors/key_slots.hpp"
#include "tests/contract/support/child_process.hpp"
#include "tests/contract/support/inbox.hpp"
#include "tests/contract/support/pairing.hpp"
#include "tests/contract/support/profiles.hpp"

namespace roci::services::contract {
namespace {

constexpr std::size_t kMegabyte = std::size_t{1} << 20;

// ROCI_FLOOD_KEYS: how many keys the flood has; ./check --full sends more.
std::size_t flood_keys() {
  const char* given = std::getenv("ROCI_FLOOD_KEYS");
  return given == nullptr ? vendors::KeySlots::kSlots + 2'000 : static_cast<std::size_t>(std::atoll(given));
}

template <class T>
transport::EndpointDescription live_endpoint(const topics::Topic<T>& topic) {
  return {topic.name, transport::describe_type<T>(topic.type_name),
          transport::writer_qos(topic.qos, topic.clocking, clock::ClockMode::live),
          transport::partitions_of(topic.scope, "")};
}

// Of a topic whose writer waits for its readers.
transport::Payload command(std::size_t number, const std::string& name) {
  v1::Command out;
  out.commander("flood");
  out.activity(std::to_string(number));
  out.command_name(name);
  return transport::serialize(out);
}

void write_all(transport::Writer& writer, std::size_t from, std::size_t to) {
  for (std::size_t i = from; i < to; ++i)
    while (!writer.write(command(i, "first"))) {
    }
}

// Counts what is read, and keeps none of it.
class Count {
 public:
  transport::ReaderEvents events() {
    return {[this](transport::Sample&& sample) {
              v1::Command value;
              const bool data = sample.kind == transport::SampleKind::data;
              if (data && !transport::deserialize(sample.payload, value)) return;
              const std::lock_guard lock(mutex_);
              read_ += data ? 1 : 0;
              again_ += value.command_name() == "again" ? 1 : 0;
              disposed_ += sample.kind == transport::SampleKind::disposed ? 1 : 0;
              left_ += sample.kind == transport::SampleKind::no_writers ? 1 : 0;
              changed_.notify_all();
            },
            {}};
  }
  bool wait_for_again() { return wait_for(again_, 1); }
  bool wait_for_disposed() { return wait_for(disposed_, 1); }
  bool wait_for_left(std::size_t keys) { return wait_for(left_, keys); }
  std::size_t read() const {
    const std::lock_guard lock(mutex_);
    return read_;
  }

 private:
  bool wait_for(const std::size_t& count, std::size_t least) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kDeadline, [&] { return count >= least; });
  }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t read_ = 0, again_ = 0, disposed_ = 0, left_ = 0;
};

class BoundedHistories : public PairingTest {
 protected:
  // A participant of its own with a reader on every topic.
  ChildProcess every_reader() const {
    return ChildProcess(
        {ROCI_BINARY_DIR "/tests/contract-reader", GetParam().reader, std::to_string(domain_.id())});
  }
};

// A reader that stopped (SIGSTOP) is one that confirms nothing; it is matched until its lease is over.
TEST_P(BoundedHistories, AWriterWhoseReaderHasStoppedRefusesWhatIsBeyondItsBound) {
  const auto sender = open_writing();
  Inbox matches;
  const auto writer =
      sender->create_writer(live_endpoint(topics::function_call.request), matches.writer_events());
  ChildProcess reader = every_reader();
  ASSERT_TRUE(reader.wait_for("ready"));
  ASSERT_TRUE(matches.wait_for_match());
  v1::FunctionRequest request;
  request.module_name(std::string(4 * kMegabyte, 'x'));
  const transport::Payload payload = transport::serialize(request);
  ASSERT_EQ(::kill(reader.pid(), SIGSTOP), 0);
  const std::size_t before = peak_memory(getpid());
  std::size_t taken = 0;
  // On a slow machine its lease may be over first: nothing is kept for it then.
  while (taken < 200 && matches.matched() > 0 && writer->write(payload)) ++taken;
  EXPECT_GT(taken, 0U);
  EXPECT_LE(taken, vendors::kUnconfirmedBytes / payload.size() + 1) << "of 200";
  EXPECT_LE(peak_memory(getpid()) - before, vendors::kUnconfirmedBytes + 40 * kMegabyte);
  // It does not go on: one that leaves while samples are sent to it again can stop a Fast DDS writer for good
  // (docs/dds.md, quirk 25).
  ASSERT_EQ(::kill(reader.pid(), SIGKILL), 0);
}

// Beyond the bound Cyclone DDS reads the keys that it knows, and Fast DDS all; both go on.
TEST_P(BoundedHistories, AFloodOfKeysEndsNoTopic) {
  const auto sender = open_writing();
  const auto receiver = open_reading();
  Count count;
  Inbox matches;
  const auto reader = receiver->create_reader(live_endpoint(topics::command), count.events());
  auto writer = sender->create_writer(live_endpoint(topics::command), matches.writer_events());
  ASSERT_TRUE(matches.wait_for_match());
  const std::size_t sent = vendors::kKeysOfTopic + 4'000;
  write_all(*writer, 0, sent);
  ASSERT_TRUE(writer->write(command(7, "again")));
  EXPECT_TRUE(count.wait_for_again()) << "a key of before";
  // Within one process Cyclone DDS hands samples over without the type's leave.
  const bool bounded = GetParam().reader == "cyclonedds" && GetParam().writer != "cyclonedds";
  EXPECT_EQ(count.read(), (bounded ? vendors::kKeysOfTopic : sent) + 1);
  // Who goes makes room for others.
  writer.reset();
  EXPECT_TRUE(count.wait_for_left(vendors::kKeysOfTopic));
  Inbox new_matches;
  writer = sender->create_writer(live_endpoint(topics::command), new_matches.writer_events());
  ASSERT_TRUE(new_matches.wait_for_match());
  ASSERT_TRUE(writer->write(command(sent, "first")));
  ASSERT_TRUE(writer->dispose(command(sent, "first")));
  EXPECT_TRUE(count.wait_for_disposed()) << "the end of a new key";
}

class BoundedKeys : public BoundedHistories {};

TEST_P(BoundedKeys, AFloodTakesBoundedMemoryFromItsReader) {
  const auto sender = open_writing();
  Inbox flood_matches, goal_matches;
  const auto flood = sender->create_writer(live_endpoint(topics::command), flood_matches.writer_events());
  const auto goals = sender->create_writer(live_endpoint(topics::goal), goal_matches.writer_events());
  ChildProcess reader = every_reader();
  ASSERT_TRUE(reader.wait_for("ready"));
  ASSERT_TRUE(flood_matches.wait_for_match());
  ASSERT_TRUE(goal_matches.wait_for_match());
  write_all(*flood, 0, flood_keys());
  ASSERT_TRUE(goals->write(goal("photo", 1)));
  EXPECT_TRUE(reader.wait_for("goal ground photo")) << "other topics go on";
  const std::size_t before = peak_memory(reader.pid());
  EXPECT_LE(before, 160 * kMegabyte);
  write_all(*flood, flood_keys(), flood_keys() * 3 / 2);
  ASSERT_TRUE(goals->write(goal("drive", 1)));
  EXPECT_TRUE(reader.wait_for("goal ground drive"));
  EXPECT_LE(peak_memory(reader.pid()) - before, 4 * kMegabyte) << "further keys take no more";
  EXPECT_EQ(reader.finish(), 0);
}

INSTANTIATE_TEST_SUITE_P(Transports, BoundedHistories, kEveryNetworkPairing, pairing_name);
INSTANTIATE_TEST_SUITE_P(Transports, BoundedKeys, kEveryNetworkPairing, pairing_name);

}  // namespace
}  // namespace roci::services::contract
