// What a transport knows of other participants: their names and their USER_DATA, on every vendor and both mixed
// directions.
#include "services/transport/announcement.hpp"

#include <gmock/gmock.h>

#include "services/topics/topics.hpp"
#include "tests/contract/support/inbox.hpp"
#include "tests/contract/support/pairing.hpp"
#include "tests/contract/support/profiles.hpp"

namespace roci::services::contract {
namespace {

class Announcements : public PairingTest {};

TEST_P(Announcements, AreKnownOfTheWriterOfEachSampleWhenItArrives) {
  const auto sender = open_writing({.announcement = "roci;build=far;Goal=12345678"});
  const auto receiver = open_reading();
  std::optional<transport::Participant> found;
  Inbox inbox;
  auto events = inbox.reader_events();
  events.on_sample = [&, inner = events.on_sample](transport::Sample&& sample) {
    found = receiver->participant_of(sample.writer);
    inner(std::move(sample));
  };
  const auto writer = sender->create_writer(goal_endpoint(latched(1)), {});
  ASSERT_TRUE(writer->write(goal("photo", 1)));
  const auto reader = receiver->create_reader(goal_endpoint(latched(1)), std::move(events));
  ASSERT_TRUE(inbox.wait_for_samples(1));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->name, "contract");
  EXPECT_EQ(found->announcement, "roci;build=far;Goal=12345678");
}

TEST_P(Announcements, EachSideNamesTheOtherWhenTheyMatch) {
  const auto sender = open_writing({.announcement = "of the writer"});
  const auto receiver = open_reading({.announcement = "of the reader"});
  std::mutex mutex;
  std::condition_variable changed;
  std::string seen_by_reader, seen_by_writer;
  const auto note = [&](std::string& where, transport::Transport& transport, const transport::Guid& remote) {
    const auto participant = transport.participant_of(remote);
    const std::lock_guard lock(mutex);
    where = participant ? participant->announcement : "unknown";
    changed.notify_all();
  };
  const auto writer = sender->create_writer(
      goal_endpoint(latched(1)),
      {.on_matched = {}, .on_reader = [&](const transport::Guid& g) { note(seen_by_writer, *sender, g); }});
  const auto reader =
      receiver->create_reader(goal_endpoint(latched(1)),
                              {.on_sample = {}, .on_matched = {}, .on_writer = [&](const transport::Guid& g) {
                                 note(seen_by_reader, *receiver, g);
                               }});
  std::unique_lock lock(mutex);
  EXPECT_TRUE(changed.wait_for(
      lock, kDeadline,
      [&] { return seen_by_reader == "of the writer" && seen_by_writer == "of the reader"; }))
      << seen_by_reader << ", " << seen_by_writer;
}

TEST_P(Announcements, AParticipantKnowsItselfAndRemembersWhoHasLeft) {
  const auto receiver = open_reading();
  Inbox inbox;
  const auto reader = receiver->create_reader(goal_endpoint(latched(1)), inbox.reader_events());
  transport::Guid left{};
  {
    const auto sender = open_writing({.announcement = "roci;build=gone"});
    const auto writer = sender->create_writer(goal_endpoint(latched(1)), {});
    left = writer->guid();
    EXPECT_EQ(sender->participant_of(left)->announcement, "roci;build=gone");
    ASSERT_TRUE(writer->write(goal("photo", 1)));
    ASSERT_TRUE(inbox.wait_for_samples(1));
    ASSERT_TRUE(receiver->participant_of(left));
  }
  ASSERT_TRUE(inbox.wait_for_match(0));
  ASSERT_TRUE(receiver->participant_of(left));
  EXPECT_EQ(receiver->participant_of(left)->announcement, "roci;build=gone");
  EXPECT_FALSE(receiver->participant_of({1, 2, 3}));
}

TEST_P(Announcements, AreThisBuildsByDefault) {
  EXPECT_EQ(open_writing()->announcement(), transport::own_announcement());
  EXPECT_EQ(open_writing({.announcement = ""})->announcement(), "");
}

INSTANTIATE_TEST_SUITE_P(Transports, Announcements, kEveryPairing, pairing_name);

TEST(Announcement, OfThisBuildIsShortAndHoldsEachTypeOfTheTopicTable) {
  const std::string text = transport::own_announcement();
  EXPECT_LT(text.size(), 1000U) << "it travels in each announcement of the participant";
  const auto own = transport::parse_announcement(text);
  ASSERT_TRUE(own);
  EXPECT_FALSE(own->build.empty());
  for (const char* type :
       {topics::goal.type_name, topics::exec_journal.type_name, topics::clock_step.type_name,
        topics::plan_request.reply.type_name, topics::event.type_name})
    EXPECT_EQ(own->hash_of(type).size(), 8U) << type;
  EXPECT_EQ(own->hash_of("roci::v1::Property"), "");
}

TEST(Announcement, OfAnotherFormIsNone) {
  using transport::parse_announcement;
  EXPECT_FALSE(parse_announcement(""));
  EXPECT_FALSE(parse_announcement("enclave=/;"));
  EXPECT_FALSE(parse_announcement("roci;Goal"));
  EXPECT_TRUE(parse_announcement("roci"));
  EXPECT_EQ(parse_announcement("roci;build=2;Goal=ab")->hash_of("roci::v1::Goal"), "ab");
}

}  // namespace
}  // namespace roci::services::contract
