// What an executive reads of its own past: journal files, snapshots and inputs in them, and what its standby is sent.
#include "exec_svc/journal/journal.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>
#include <string>

#include "exec_svc/journal/journaled_reactor.hpp"
#include "exec_svc/journal/replay.hpp"
#include "exec_svc/reactor/message_fields.hpp"
#include "exec_svc/standby/journal_copy.hpp"
#include "exec_svc/standby/lease.hpp"
#include "tests/fuzz/files/damage.hpp"
#include "tests/fuzz/rounds.hpp"
#include "tests/unit/exec_svc/planetary_fixture.hpp"

namespace roci::fuzz {
namespace {

namespace fs = std::filesystem;
using exec::archive::ArchiveError;
using exec::journal::Durability;
using exec::journal::Journal;
using exec::journal::JournaledReactor;
using exec::journal::JournalError;
using exec::reactor::Reactor;
using exec::reactor::ReactorInputs;

exec::goals::GoalRequest photo(const std::string& id) {
  exec::goals::GoalRequest goal;
  goal.key = {"ground", id};
  goal.kind = "photo";
  goal.arguments = {{"x", "110"}, {"y", "60"}};
  return goal;
}

ReactorInputs robot_stands() {
  ReactorInputs inputs;
  inputs.observations = exec::testing::standing_robot();
  return inputs;
}

class Files : public testing::Test {
 protected:
  Files() : folder_(fs::temp_directory_path() / ("roci-fuzz-files-" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Files() override { fs::remove_all(folder_); }

  // A journal of some steps with goals, a planner call and a refusal.
  fs::path made_journal(const std::string& name = "whole.sqlite") {
    const fs::path file = folder_ / name;
    Journal journal(file, Durability::process);
    journal.begin_epoch(1);
    JournaledReactor reactor(mission_, journal, false);
    reactor.step(temporal::seconds(1), robot_stands(),
                 {"1000000 observation rover.nav idle-at here sampled 0"});
    for (int i = 0; i < 5; ++i) {
      ReactorInputs inputs;
      inputs.goals = {photo("goal-" + std::to_string(i))};
      reactor.step(temporal::seconds(2 + i), inputs, {});
    }
    ReactorInputs reply;
    reply.reply.emplace();
    reply.reply->call = 1;
    reply.reply->verdict = temporal::Verdict::unsolvable;
    reactor.step(temporal::seconds(20), reply, {});
    return file;
  }

  const exec::mission::MissionModel mission_ =
      exec::mission::read_mission(ROCI_SOURCE_DIR "/missions/planetary");
  fs::path folder_;
  std::mt19937_64 random_{1};
};

using FuzzJournal = Files;
using FuzzStandby = Files;

void unless_refused(const std::function<void()>& run) {
  try {
    run();
  } catch (const JournalError&) {
  } catch (const ArchiveError&) {
  }
}

TEST_F(FuzzJournal, ADamagedFileIsReadOrRefused) {
  const std::string whole = read_bytes(made_journal());
  for (int round = 0; round < rounds(60); ++round) {
    const fs::path file = folder_ / ("damaged-" + std::to_string(round) + ".sqlite");
    write_bytes(file, damaged(whole, random_));
    ASSERT_NO_THROW(unless_refused([&] {
      Journal journal(file, Durability::process);
      journal.goals();
      journal.peers();
      JournaledReactor reactor(mission_, journal, false);
      reactor.step(temporal::seconds(30), robot_stands(), {});
    })) << "round "
        << round;
    for (const auto& entry : fs::directory_iterator(folder_))
      if (entry.path().filename().string().starts_with("damaged-")) fs::remove_all(entry.path());
  }
}

TEST_F(FuzzJournal, ADamagedSnapshotIsRefusedOrGoesOn) {
  Reactor reactor(mission_);
  reactor.step(temporal::seconds(1), robot_stands());
  ReactorInputs goals;
  goals.goals = {photo("a"), photo("b")};
  reactor.step(temporal::seconds(2), goals);
  const std::string whole = reactor.snapshot();
  for (int round = 0; round < rounds(1500); ++round) {
    ASSERT_NO_THROW(unless_refused([&] {
      Reactor other(mission_);
      other.restore(damaged(whole, random_));
      other.step(temporal::seconds(3), robot_stands());
      other.snapshot();
    })) << "round "
        << round;
  }
}

// An input that decodes may say anything.
TEST_F(FuzzJournal, DamagedInputsAreRefusedOrTaken) {
  ReactorInputs inputs = robot_stands();
  inputs.goals = {photo("a"), photo("b")};
  inputs.acks = {{"p1.1-drive", 1, exec::executive::CommandStage::completed, "done", "", 1}};
  inputs.models = {{"pathplan_svc", 2}};
  inputs.answers = {{{"ground", "1"}, {}, "d1", "yes", ""}};
  inputs.ground_orders.emplace_back();
  inputs.reply.emplace();
  inputs.deltas.emplace_back();
  const std::string whole = exec::archive::to_bytes(inputs);
  for (int round = 0; round < rounds(1500); ++round) {
    ASSERT_NO_THROW(unless_refused([&] {
      Reactor reactor(mission_);
      exec::journal::Replay replay(reactor);
      replay.take(temporal::seconds(1), "input", exec::archive::to_bytes(robot_stands()));
      replay.take(temporal::seconds(2), "input", damaged(whole, random_));
      replay.finish();
    })) << "round "
        << round;
  }
}

TEST_F(FuzzStandby, ADamagedJournalIsCopiedOrRefused) {
  std::string whole;
  {
    Journal journal(made_journal(), Durability::process);
    whole = journal.serialized();
  }
  for (int round = 0; round < rounds(40); ++round) {
    Journal journal(folder_ / "copy.sqlite", Durability::process);
    exec::standby::JournalCopy copy(journal);
    ASSERT_NO_THROW(unless_refused([&] {
      for (const auto& chunk :
           exec::standby::split(2, {2, static_cast<std::uint64_t>(round) + 9}, damaged(whole, random_)))
        copy.take(chunk, 1);
      journal.goals();
    })) << "round "
        << round;
  }
}

TEST_F(FuzzStandby, DamagedChunksAreTakenOrRefused) {
  Journal leader(folder_ / "leader.sqlite", Durability::process);
  leader.begin_epoch(1);
  JournaledReactor reactor(mission_, leader, false);
  reactor.step(temporal::seconds(1), robot_stands(), {});
  const auto batches = leader.take_batches();
  ASSERT_FALSE(batches.empty());
  Journal journal(folder_ / "copy.sqlite", Durability::process);
  exec::standby::JournalCopy copy(journal);
  for (int round = 0; round < rounds(300); ++round) {
    const auto& batch = batches[random_() % batches.size()];
    exec::standby::Chunk chunk;
    chunk.leader = random_() % 3;
    chunk.after = random_() % 2 == 0 ? copy.has() : batch.after;
    chunk.at = {random_() % 3, random_() % 5};
    chunk.part = static_cast<std::uint32_t>(random_() % 3);
    chunk.parts = static_cast<std::uint32_t>(random_() % 3);
    chunk.bytes = damaged(batch.changes, random_);
    if (random_() % 8 != 0) chunk.checksum = exec::standby::checksum(chunk);
    ASSERT_NO_THROW(copy.take(chunk, 1)) << "round " << round;
  }
}

TEST(FuzzLease, HearsWhateverMembersSay) {
  using namespace exec::standby;
  std::mt19937_64 random(3);
  const auto moment = [&] {
    return Moment(static_cast<std::int64_t>(random() % 4 == 0 ? random() : random() % 10'000'000));
  };
  for (int round = 0; round < rounds(200); ++round) {
    Lease lease(random() % 2 == 0 ? Member::first : Member::second, {}, {}, false, Moment(0));
    Moment now{0};
    for (int i = 0; i < 50; ++i) {
      LeaseMessage message;
      message.member = random() % 2 == 0 ? Member::first : Member::second;
      message.role = random() % 2 == 0 ? Role::leading : Role::following;
      message.epoch = random() % 4 == 0 ? random() : random() % 5;
      message.has = {random() % 5, random()};
      message.receipt = {random() % 5, random()};
      message.entitled = random() % 2 == 0;
      message.searching = random() % 2 == 0;
      message.said = moment();
      message.echo = moment();
      lease.hear(message, now);
      now += Moment(static_cast<std::int64_t>(random() % 1'000'000));
      const auto turn = lease.turn({random() % 5, random() % 100}, now);
      if (turn.change == Lease::Change::stand_down) break;
      lease.may_send({1, 1}, now);
    }
  }
}

}  // namespace
}  // namespace roci::fuzz
