// A journal and its copy: batches over a channel that loses, doubles, delays and garbles.
#include "exec_svc/standby/journal_copy.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "exec_svc/standby/journal_feed.hpp"

namespace roci::exec {

using goals::GoalRecord;
using journal::Batch;
using journal::Durability;
using journal::Journal;
using journal::JournalError;
using journal::kForkedHistory;
using journal::Position;
using standby::Chunk;
using standby::JournalCopy;
using standby::JournalFeed;

namespace {

using namespace std::chrono_literals;
using temporal::seconds;
using Result = JournalCopy::Result;

std::string everything(const Journal& journal) {
  std::string out;
  journal.for_each([&](temporal::Time time, std::string_view kind, std::string_view text) {
    out += std::to_string(time.count()) + " " + std::string(kind) + " " + std::string(text) + "\n";
  });
  for (const auto& [service, incarnation] : journal.peers())
    out += service + std::to_string(incarnation) + "\n";
  for (const GoalRecord& goal : journal.goals()) out += goal.request.key.text() + goal.reason + "\n";
  return out + std::to_string(journal.number("anchor", -1)) + journal.text("mission");
}

GoalRecord goal(int number, const std::string& reason) {
  GoalRecord out;
  out.request.key = {"ground", std::to_string(number)};
  out.arrival = static_cast<std::uint64_t>(number);
  out.reason = reason;
  return out;
}

class JournalCopyTest : public ::testing::Test {
 protected:
  JournalCopyTest() {
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("roci_copy_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~JournalCopyTest() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path file(const std::string& name) const { return folder_ / (name + ".sqlite"); }
  Journal open(const std::string& name) const { return Journal(file(name), Durability::process); }

  // Everything that a step may write, now and then.
  static void write_step(Journal& journal, int step) {
    const std::string text = "step " + std::to_string(step);
    const std::int64_t number =
        journal.append_bytes(seconds(step), "input", std::string(step % 300, '\0') + text);
    journal.append(seconds(step), "event", text + std::string(step % 400, '.'));
    if (step % 5 == 0) journal.put_goal(goal(step % 3, text));
    if (step % 7 == 0) journal.put_peer("sim_svc", static_cast<std::uint32_t>(step));
    if (step % 11 == 0) journal.remove_peer("sim_svc");
    if (step % 13 == 0) journal.set_number("anchor", number);
    if (step % 17 == 0) journal.forget_inputs_before(number - 20);
    journal.set_text("mission", text);
    journal.commit();
  }

 private:
  std::filesystem::path folder_;
};

Chunk parcel_of(const Batch& batch) {
  Chunk out{batch.at.epoch, batch.after, batch.at, 0, 0, 0, batch.changes};
  out.checksum = checksum(out);
  return out;
}

TEST_F(JournalCopyTest, BatchAfterBatchTheCopyIsTheJournal) {
  Journal journal = open("journal"), other = open("copy");
  journal.begin_epoch(3);
  JournalCopy copy(other);
  for (int step = 1; step <= 60; ++step) {
    write_step(journal, step);
    for (const Batch& batch : journal.take_batches())
      EXPECT_EQ(copy.take(parcel_of(batch), 3), Result::batch);
    ASSERT_TRUE(everything(other) == everything(journal)) << step;
    ASSERT_EQ(other.position(), journal.position());
  }
  EXPECT_EQ(journal.position(), (Position{3, 61}));
}

TEST_F(JournalCopyTest, ACommitThatChangesNothingIsNoBatch) {
  Journal journal = open("journal");
  journal.begin_epoch(1);
  journal.take_batches();
  journal.set_text("mission", "");
  journal.commit();
  EXPECT_EQ(journal.take_batches().size(), 1U);
  journal.set_text("mission", "");
  journal.commit();
  EXPECT_TRUE(journal.take_batches().empty());
}

TEST_F(JournalCopyTest, EachBatchIsTakenOnceInOrderAndUnharmed) {
  Journal journal = open("journal"), other = open("copy");
  journal.begin_epoch(2);
  write_step(journal, 1);
  write_step(journal, 2);
  const auto batches = journal.take_batches();
  ASSERT_EQ(batches.size(), 3U);
  JournalCopy copy(other);
  EXPECT_EQ(copy.take(parcel_of(batches[0]), 2), Result::batch);
  EXPECT_EQ(copy.take(parcel_of(batches[0]), 2), Result::known);
  EXPECT_EQ(copy.take(parcel_of(batches[2]), 2), Result::gap);
  EXPECT_EQ(copy.take(parcel_of(batches[1]), 4), Result::old) << "another leads already";
  Chunk garbled = parcel_of(batches[1]);
  garbled.bytes[garbled.bytes.size() / 2] ^= 4;
  EXPECT_EQ(copy.take(garbled, 2), Result::corrupt);
  EXPECT_EQ(copy.has(), batches[0].at);
  EXPECT_EQ(copy.take(parcel_of(batches[1]), 2), Result::batch);
  EXPECT_EQ(copy.take(parcel_of(batches[2]), 2), Result::batch);
  EXPECT_TRUE(everything(other) == everything(journal));
}

// The checksum stands before SQLite, which trusts a changeset.
TEST_F(JournalCopyTest, NoGarbledParcelGetsThrough) {
  Journal journal = open("journal"), other = open("copy");
  journal.begin_epoch(2);
  write_step(journal, 1);
  const auto batches = journal.take_batches();
  JournalCopy copy(other);
  copy.take(parcel_of(batches[0]), 2);
  const std::string before = everything(other);
  std::mt19937_64 random(3);
  for (int i = 0; i < 2000; ++i) {
    Chunk garbled = parcel_of(batches[1]);
    const auto bit = std::uint64_t{1} << random() % 64;
    switch (random() % 5) {
      case 0:
        garbled.at.sequence ^= bit;
        break;
      case 1:
        garbled.after.epoch ^= bit;
        break;
      case 2:
        garbled.parts ^= static_cast<std::uint32_t>(1 + bit % 0xffff);
        break;
      case 3:
        garbled.bytes.resize(random() % garbled.bytes.size());
        break;
      default:
        garbled.bytes[random() % garbled.bytes.size()] ^= static_cast<char>(1 + random() % 255);
    }
    ASSERT_EQ(copy.take(garbled, 2), Result::corrupt);
  }
  EXPECT_EQ(everything(other), before);
  EXPECT_EQ(copy.has(), batches[0].at);
}

TEST_F(JournalCopyTest, ABatchThatDoesNotFitChangesNothing) {
  Journal journal = open("journal"), other = open("copy");
  journal.begin_epoch(2);
  other.append(seconds(1), "event", "another past");
  other.commit();
  write_step(journal, 1);
  const std::string before = everything(other);
  const auto batches = journal.take_batches();
  other.apply(batches[0]);
  EXPECT_THROW(other.apply(batches[1]), JournalError) << "the number of its record is taken";
  EXPECT_EQ(everything(other), before);
  EXPECT_EQ(other.position(), batches[0].at);
}

TEST_F(JournalCopyTest, AfterABatchThatDoesNotFitTheWholeJournalIsWanted) {
  Journal journal = open("journal"), other = open("copy");
  journal.begin_epoch(2);
  JournalCopy copy(other);
  Batch batch = journal.take_batches().at(0);
  batch.changes = "no changes";
  EXPECT_EQ(copy.take(parcel_of(batch), 2), Result::corrupt);
  EXPECT_EQ(copy.has(), kForkedHistory);
}

TEST_F(JournalCopyTest, AJournalWithAnotherPastIsReplaced) {
  Journal journal = open("journal"), other = open("copy");
  other.begin_epoch(1);
  for (int step = 1; step < 9; ++step) write_step(other, step);
  journal.begin_epoch(2);
  for (int step = 1; step < 2000; ++step) write_step(journal, step);
  JournalFeed feed(2, journal.position());
  JournalCopy copy(other);
  feed.hear(copy.has(), copy.arrival(), 0us);
  int parts = 0;
  for (auto due = feed.due(0us, [&] { return journal.serialized(); }); !due.empty();
       due = feed.due(0us, [&] { return journal.serialized(); })) {
    for (const Chunk& chunk : due) {
      const Result taken = copy.take(chunk, 2);
      ASSERT_TRUE(taken == Result::part || taken == Result::whole);
      ++parts;
    }
    feed.hear(copy.has(), copy.arrival(), 0us);
  }
  EXPECT_GT(parts, 4);
  EXPECT_TRUE(everything(other) == everything(journal));
  EXPECT_EQ(Journal(file("copy"), Durability::process).position(), journal.position());
}

TEST_F(JournalCopyTest, WhatIsNoJournalReplacesNothing) {
  Journal other = open("copy");
  write_step(other, 1);
  const std::string before = everything(other);
  const std::string whole = other.serialized();
  for (const std::string& bytes :
       {std::string("no journal"), std::string(), whole.substr(0, whole.size() / 2)})
    EXPECT_THROW(other.replace_with(bytes), JournalError);
  EXPECT_EQ(everything(other), before);
}

TEST_F(JournalCopyTest, TheWholeJournalLeavesOutWhatIsNotCommitted) {
  Journal journal = open("journal"), other = open("copy");
  write_step(journal, 1);
  journal.put_peer("arm_svc", 1);
  other.replace_with(journal.serialized());
  EXPECT_TRUE(other.peers().empty());
}

// Whoever sends parts of what is no journal, with checksums that fit, fills no memory and keeps no honest copy away.
TEST_F(JournalCopyTest, AWholeJournalBeyondTheBoundIsForgottenAndAskedForAnew) {
  Journal journal = open("journal"), other = open("copy");
  journal.begin_epoch(2);
  for (int step = 1; step < 2000; ++step) write_step(journal, step);
  const auto parts = standby::split(2, journal.position(), journal.serialized());
  ASSERT_GT(parts.size(), 2U);
  JournalCopy copy(other);
  const auto sealed = [](Chunk chunk) {
    chunk.checksum = checksum(chunk);
    return chunk;
  };
  Chunk endless = parts[0];
  endless.parts = standby::kJournalCopyBytes / standby::kPartBytes + 1;
  EXPECT_EQ(copy.take(sealed(endless), 2), Result::excess);
  Chunk large = parts[0];
  large.bytes.resize(standby::kPartBytes + 1);
  EXPECT_EQ(copy.take(sealed(large), 2), Result::excess);
  EXPECT_EQ(copy.arrival(), standby::TransferProgress{});
  ASSERT_EQ(copy.take(parts[0], 2), Result::part);
  Chunk longer = parts[1];
  ++longer.parts;
  EXPECT_EQ(copy.take(sealed(longer), 2), Result::excess) << "more than was announced";
  EXPECT_EQ(copy.arrival(), standby::TransferProgress{}) << "so the first part is sent again";
  EXPECT_EQ(copy.take(parts[1], 2), Result::gap);
  for (const Chunk& part : parts)
    EXPECT_EQ(copy.take(part, 2), part.part + 1 < part.parts ? Result::part : Result::whole);
  EXPECT_TRUE(everything(other) == everything(journal));
}

// Random losses, repetitions, delays and broken bytes both ways, and a copy that is started anew.
TEST_F(JournalCopyTest, OverABadChannelTheCopyBecomesTheJournal) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    std::mt19937_64 random(seed);
    const auto chance = [&](int percent) { return static_cast<int>(random() % 100) < percent; };
    Journal journal = open("journal" + std::to_string(seed)), other = open("copy" + std::to_string(seed));
    for (int step = 1; step < 20; ++step) write_step(journal, step);  // before there was a pair
    journal.begin_epoch(1);
    journal.take_batches();
    JournalFeed feed(1, journal.position());
    auto copy = std::make_unique<JournalCopy>(other);
    std::vector<Chunk> under_way;
    for (int step = 20; step < 400; ++step) {
      const JournalFeed::Moment now = 100ms * step;
      if (step < 300) write_step(journal, step);
      for (Batch& batch : journal.take_batches()) feed.add(std::move(batch));
      for (Chunk& chunk : feed.due(now, [&] { return journal.serialized(); })) {
        const bool bad = step < 300;
        if (bad && chance(10)) continue;
        if (bad && chance(5)) chunk.bytes[random() % chunk.bytes.size()] ^= 1;
        if (bad && chance(10)) under_way.push_back(chunk);
        under_way.push_back(std::move(chunk));
        if (bad && chance(10)) std::swap(under_way.front(), under_way.back());
      }
      while (!under_way.empty() && !chance(1)) {
        copy->take(under_way.front(), 1);
        under_way.erase(under_way.begin());
      }
      if (step < 300 && chance(2)) copy = std::make_unique<JournalCopy>(other);
      if (!chance(20)) feed.hear(copy->has(), copy->arrival(), now);
    }
    EXPECT_EQ(copy->has(), journal.position()) << seed;
    EXPECT_TRUE(everything(other) == everything(journal)) << seed;
  }
}

}  // namespace
}  // namespace roci::exec
