// The journal's way from a leading executive to a following one, on every transport.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "exec_svc/standby/follower_service.hpp"
#include "exec_svc/standby/leader_service.hpp"
#include "exec_svc/standby/standby_wire_service.hpp"
#include "services/clock/wall.hpp"
#include "services/owner/commander_leases.hpp"
#include "services/process/domain_claim.hpp"
#include "services/transport/plug_ins.hpp"

namespace roci::exec {

using journal::Durability;
using journal::Journal;
using journal::Position;
using standby::Chunk;
using standby::FollowerService;
using standby::LeaderService;
using standby::Lease;
using standby::LeaseSettings;
using standby::Member;
using standby::moment;
using standby::PersistedTerm;
using standby::PersistedTermFile;
using standby::StandDown;

namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

constexpr auto kLimit = 20s;

struct Vendors {
  const char* name;
  const char* leader;
  const char* follower;
};

services::node::NodeOptions options_of(const std::string& name, services::clock::ClockMode clock) {
  services::node::NodeOptions options;
  options.name = name;
  options.clock = clock;
  return options;
}

std::string everything(const Journal& journal) {
  std::string out;
  journal.for_each([&](temporal::Time time, std::string_view kind, std::string_view text) {
    out += std::to_string(time.count()) + " " + std::string(kind) + " " + std::string(text) + "\n";
  });
  return out;
}

class StandbyTest : public ::testing::TestWithParam<Vendors> {
 protected:
  StandbyTest() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    leader_journal_.emplace(folder_ / "leader.sqlite", Durability::process);
    follower_journal_.emplace(folder_ / "follower.sqlite", Durability::process);
  }
  ~StandbyTest() override {
    stop_leader();
    stop_follower();
    fs::remove_all(folder_);
  }

  std::unique_ptr<services::transport::Transport> transport(const char* vendor) const {
    services::transport::TransportOptions options;
    options.domain = domain_.id();
    options.participant = "test";
    return services::transport::open_transport(vendor, options);
  }

  // Leads at once: it was alone before.
  void start_leader() {
    leader_lease_.emplace(Member::first, settings_, PersistedTerm{1, true}, false, -10s + moment());
    ASSERT_EQ(leader_lease_->turn(leader_journal_->position(), moment()).change, Lease::Change::lead);
    leader_node_.emplace(options_of("exec_svc", services::clock::ClockMode::live),
                         transport(GetParam().leader));
    leader_lease_->require(owners_);
    leader_.emplace(*leader_node_, "exec_svc", *leader_lease_, *leader_journal_, leader_standing_);
  }
  void start_follower() {
    follower_lease_.emplace(Member::second, settings_, PersistedTerm{}, false, moment());
    follower_node_.emplace(options_of("exec_svc.second", services::clock::ClockMode::observer),
                           transport(GetParam().follower));
    follower_.emplace(*follower_node_, "exec_svc", *follower_lease_, *follower_journal_, follower_standing_,
                      standby::GoalsApart(folder_ / "follower.sqlite", Durability::process));
  }
  void stop_leader() {
    leader_.reset();
    leader_node_.reset();
  }
  void stop_follower() {
    follower_.reset();
    follower_node_.reset();
  }

  bool wait(const std::function<bool()>& done) {
    for (const auto limit = services::clock::wall_now() + kLimit; services::clock::wall_now() < limit;) {
      if (leader_node_) leader_node_->spin_once(2ms);
      if (follower_node_) follower_node_->spin_once(2ms);
      if (done()) return true;
    }
    return false;
  }
  bool wait_for_copy() {
    return wait([&] { return follower_journal_->position() == leader_journal_->position(); });
  }
  bool wait_for_pair() {
    return wait(
        [&] { return leader_lease_->message({}).entitled && follower_lease_->message(newest()).entitled; });
  }
  Position newest() const { return follower_journal_->position(); }

  void write(int from, int to) {
    for (int i = from; i < to; ++i) {
      leader_journal_->append(temporal::seconds(i), "event", std::string(100, 'x') + std::to_string(i));
      leader_journal_->commit();
      leader_->send_once_copied([this] { ++sent_; }, false);
    }
  }
  void expect_copy() const { EXPECT_TRUE(everything(*follower_journal_) == everything(*leader_journal_)); }

  services::process::DomainClaim domain_;
  fs::path folder_ = fs::temp_directory_path() / ("roci_standby_" + std::to_string(domain_.id()));
  std::optional<Journal> leader_journal_, follower_journal_;
  LeaseSettings settings_;
  PersistedTermFile leader_standing_{folder_ / "leader", Durability::process};
  PersistedTermFile follower_standing_{folder_ / "follower", Durability::process};
  std::optional<Lease> leader_lease_, follower_lease_;
  std::optional<services::Node> leader_node_, follower_node_;
  std::optional<LeaderService> leader_;
  std::optional<FollowerService> follower_;
  std::set<std::string> owners_;
  int sent_ = 0;
};

TEST_P(StandbyTest, NothingIsSentThatTheFollowerDoesNotHave) {
  start_leader();
  start_follower();
  ASSERT_TRUE(wait_for_pair());
  for (int i = 0; i < 200; ++i) {
    sent_ = 0;
    write(i, i + 1);
    EXPECT_EQ(sent_, 0) << "before the follower could know";
    ASSERT_TRUE(wait([&] { return sent_ == 1; }));
    ASSERT_EQ(follower_journal_->position(), leader_journal_->position());
  }
  expect_copy();
}

TEST_P(StandbyTest, CommandsWaitForTheLeasesOfTheirOwners) {
  owners_ = {"drill"};
  start_leader();
  const auto send = [this](bool commands) {
    leader_journal_->append(temporal::seconds(1), "event", "something");
    leader_journal_->commit();
    leader_->send_once_copied([this] { ++sent_; }, commands);
  };
  send(false);
  EXPECT_EQ(sent_, 1);
  send(true);
  EXPECT_EQ(sent_, 1);
  EXPECT_FALSE(leader_->may_command());
  services::Node drill(options_of("drill", services::clock::ClockMode::observer),
                       transport(GetParam().follower));
  const auto states = services::advertise(drill, services::topics::lease_state);
  services::owner::CommanderLeases leases;
  services::subscribe(drill, services::topics::lease_request, [&](const v1::LeaseRequest& request) {
    const auto grant =
        leases.ask({request.commander(), request.member(), request.epoch(), request.wanted(), request.leads(),
                    standby::Moment(request.term_us()), standby::Moment(request.said_us())},
                   0, moment());
    v1::LeaseState state;
    state.owner("drill");
    state.commander(request.commander());
    state.member(grant.member);
    state.epoch(grant.epoch);
    state.echo_us(grant.echo.count());
    state.term_us(grant.term.count());
    states.write(std::move(state));
  });
  ASSERT_TRUE(wait([&] {
    drill.spin_once(2ms);
    return leader_->may_command();
  }));
  ASSERT_TRUE(wait([&] { return sent_ == 2; }));
  ASSERT_TRUE(wait([&] { return !leader_->may_command(); })) << "the drill is silent, and its lease runs out";
}

// The other one led apart, and its journal goes; its goals do not.
TEST_P(StandbyTest, GoalsOfAReplacedJournalAreHandedOver) {
  goals::GoalRecord goal;
  goal.request.key = {"ground", "ridge"};
  goal.request.kind = "photo";
  goal.request.recalled = true;
  goal.state = goals::GoalState::recalled;
  goal.revision = 1;
  follower_journal_->begin_epoch(1);
  follower_journal_->put_goal(goal);
  follower_journal_->commit();
  start_leader();
  write(0, 3);
  leader_->on_hand_over([this](const goals::GoalRecord& theirs) {
    if (!leader_journal_->goals().empty()) return;
    leader_journal_->put_goal(theirs);
    leader_journal_->commit();
    leader_->send_once_copied([] {}, false);
  });
  start_follower();
  const fs::path apart = folder_ / "follower.sqlite.apart-1";
  ASSERT_TRUE(wait([&] { return fs::exists(apart); })) << "before the journal is replaced";
  ASSERT_TRUE(wait([&] { return !fs::exists(apart); })) << "once the leader has them";
  ASSERT_EQ(leader_journal_->goals().size(), 1U);
  EXPECT_TRUE(leader_journal_->goals()[0].request.recalled);
  EXPECT_EQ(leader_journal_->goals()[0].state, goals::GoalState::recalled);
  ASSERT_EQ(follower_journal_->goals().size(), 1U);
}

// The other one led apart and took orders, of which the leader hears one again from who gave it.
TEST_P(StandbyTest, OrdersOfAReplacedJournalAreToldIfTheLeaderDoesNotKnowThem) {
  const auto order = [](Journal& journal, const std::string& key, const std::string& what, int stage) {
    journal.append(temporal::seconds(9), "trace", "9000000 order " + key + " " + what);
    journal.append(temporal::seconds(9), "trace",
                   "9000000 ordered " + key + " stage=" + std::to_string(stage) + " 0 ");
  };
  follower_journal_->begin_epoch(1);
  order(*follower_journal_, "ground/heard", "hold arm", 3);
  order(*follower_journal_, "ground/unheard", "hold wheels", 3);
  order(*follower_journal_, "ground/refused", "approve no-such", 2);
  follower_journal_->commit();
  order(*leader_journal_, "ground/heard", "hold arm", 3);
  start_leader();
  write(0, 3);
  std::vector<std::string> told;
  services::subscribe(*leader_node_, services::topics::event, [&](const v1::Event& event) {
    if (event.code() == "order.lost") told.push_back(event.text());
  });
  start_follower();
  ASSERT_TRUE(wait([&] { return !told.empty(); }));
  ASSERT_EQ(told.size(), 1U);
  EXPECT_TRUE(told[0].starts_with("order ground/unheard (hold wheels) was taken")) << told[0];
}

TEST_P(StandbyTest, ALateJoinerGetsTheWholeJournal) {
  // The leader stands still while all of its journal is compared, which takes a sanitizer seconds.
  settings_ = {.term = 8s};
  for (int i = 0; i < 6000; ++i)
    leader_journal_->append(temporal::seconds(i), "event", std::string(100, 'y'));
  leader_journal_->commit();
  start_leader();
  write(0, 50);
  EXPECT_EQ(sent_, 50) << "alone";
  start_follower();
  ASSERT_TRUE(wait_for_copy());
  expect_copy();
  write(50, 100);
  ASSERT_TRUE(wait_for_copy());
  expect_copy();
}

TEST_P(StandbyTest, AFollowerThatComesBackGetsWhatItMissed) {
  start_leader();
  start_follower();
  ASSERT_TRUE(wait_for_pair());
  write(0, 20);
  ASSERT_TRUE(wait_for_copy());
  stop_follower();
  write(20, 40);
  start_follower();
  ASSERT_TRUE(wait_for_copy());
  ASSERT_TRUE(wait([&] { return sent_ == 40; }));
  expect_copy();
}

TEST_P(StandbyTest, AnUnknownPastIsReplaced) {
  follower_journal_->begin_epoch(1);
  for (int i = 0; i < 9; ++i) {
    follower_journal_->append(temporal::seconds(i), "event", "another past");
    follower_journal_->commit();
  }
  start_leader();
  write(0, 3);
  start_follower();
  ASSERT_TRUE(wait_for_copy());
  expect_copy();
}

// Garbled, repeated, out of order, of a leader that is none any more: the copy stays a copy.
TEST_P(StandbyTest, StrayParcelsDoNoHarm) {
  start_leader();
  start_follower();
  ASSERT_TRUE(wait_for_pair());
  write(0, 5);
  ASSERT_TRUE(wait_for_copy());
  const Position has = newest();
  services::Node stranger(options_of("stranger", services::clock::ClockMode::observer),
                          transport(GetParam().leader));
  const auto chunks = services::advertise(stranger, services::topics::exec_journal);
  ASSERT_TRUE(wait([&] {
    stranger.spin_once(1ms);
    return chunks.matched_readers() > 0;
  }));
  const auto stray = [&](std::uint64_t leader, Position after, Position at, bool sealed) {
    Chunk chunk{leader, after, at, 0, 0, 0, "no changes"};
    chunk.checksum = checksum(chunk) + (sealed ? 0 : 1);
    chunks.write(standby::to_wire(chunk, "exec_svc"));
  };
  const Position next{has.epoch, has.sequence + 1};
  stray(has.epoch, has, next, false);                                  // garbled
  stray(has.epoch, {has.epoch, 2}, {has.epoch, 3}, true);              // known
  stray(has.epoch, next, {has.epoch, next.sequence + 1}, true);        // a gap before it
  stray(has.epoch - 1, has, {has.epoch - 1, has.sequence + 1}, true);  // an old leader's
  write(5, 60);
  ASSERT_TRUE(wait_for_copy());
  ASSERT_TRUE(wait([&] { return sent_ == 60; }));
  expect_copy();
  stray(has.epoch, newest(), {has.epoch, newest().sequence + 1}, true);  // fits, and is no change
  write(60, 70);
  ASSERT_TRUE(wait_for_copy());
  expect_copy();
}

// Another pair of the same run: its leader has led longer, its journal would fit.
TEST_P(StandbyTest, AnotherPairConcernsNobody) {
  start_leader();
  start_follower();
  ASSERT_TRUE(wait_for_pair());
  write(0, 5);
  ASSERT_TRUE(wait_for_copy());
  services::Node stranger(options_of("other", services::clock::ClockMode::observer),
                          transport(GetParam().leader));
  const auto chunks = services::advertise(stranger, services::topics::exec_journal);
  const auto members = services::advertise(stranger, services::topics::exec_member);
  ASSERT_TRUE(wait([&] {
    stranger.spin_once(1ms);
    return chunks.matched_readers() > 0 && members.matched_readers() > 1;
  }));
  const Position has = newest();
  standby::LeaseMessage message = leader_lease_->message(has);
  message.member = Member::second;
  message.role = standby::Role::leading;
  message.epoch += 7;
  members.write(standby::to_wire(message, {}, "other"));
  Chunk chunk{has.epoch, has, {has.epoch, has.sequence + 1}, 0, 0, 0, "no changes"};
  chunk.checksum = checksum(chunk);
  chunks.write(standby::to_wire(chunk, "other"));
  write(5, 20);
  ASSERT_TRUE(wait_for_copy());
  ASSERT_TRUE(wait([&] { return sent_ == 20; }));
  expect_copy();
}

TEST_P(StandbyTest, TheFollowerLeadsWhenTheLeaderIsGoneAndTheOldOneStandsDown) {
  start_leader();
  start_follower();
  ASSERT_TRUE(wait_for_pair());
  ASSERT_TRUE(wait([&] { return sent_ == 0; }));
  const auto stopped_at = services::clock::wall_now();
  ASSERT_TRUE([&] {  // the leader's loop stands still
    while (!follower_->lead() && services::clock::wall_now() < stopped_at + kLimit)
      follower_node_->spin_once(5ms);
    return follower_->lead().has_value();
  }());
  EXPECT_EQ(follower_lease_->epoch(), 4U);
  EXPECT_EQ(follower_standing_.read(), (PersistedTerm{4, true, 3}));
  EXPECT_THROW(write(0, 1), StandDown);
  EXPECT_EQ(sent_, 0);
}

INSTANTIATE_TEST_SUITE_P(Transports, StandbyTest,
                         ::testing::Values(Vendors{"inproc", "inproc", "inproc"},
                                           Vendors{"fastdds", "fastdds", "fastdds"},
                                           Vendors{"cyclonedds", "cyclonedds", "cyclonedds"},
                                           Vendors{"fastdds_cyclonedds", "fastdds", "cyclonedds"},
                                           Vendors{"cyclonedds_fastdds", "cyclonedds", "fastdds"}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace roci::exec
