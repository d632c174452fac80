// The rules of the lease one by one, then all together under random cuts, losses, delays, pauses and deaths.
#include "exec_svc/standby/lease.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include "tests/unit/exec_svc/standby/pair_world.hpp"

namespace roci::exec {

using standby::Lease;
using standby::Member;

namespace {

using namespace std::chrono_literals;
using ::testing::IsEmpty;
using testing::PairWorld;

constexpr Member kFirst = Member::first;
constexpr Member kSecond = Member::second;

// Two members that found each other, the first one leads, the second one has its whole journal.
PairWorld paired(std::uint64_t seed = 1) {
  PairWorld world(seed, {});
  world.run(2s);
  EXPECT_EQ(world.leader(), kFirst);
  EXPECT_EQ(world.last_change(kFirst), Lease::Change::paired);
  return world;
}

TEST(Lease, TwoNewMembersBeginAtOnceWithTheFirstOne) {
  PairWorld world(1, {});
  world.run(100ms);
  EXPECT_EQ(world.leader(), kFirst);
}

TEST(Lease, ANewMemberThatHearsNobodyLeadsInTheEnd) {
  PairWorld world(1, {});
  world.kill(kFirst);
  world.run(19s);
  EXPECT_EQ(world.leader(), std::nullopt);
  world.run(2s);
  EXPECT_EQ(world.leader(), kSecond);
}

TEST(Lease, AGoalIsAcknowledgedWhenBothHaveIt) {
  PairWorld world = paired();
  world.network.longest_delay = 60ms;
  for (int goal = 1; goal <= 50; ++goal) {
    world.ask_for_a_goal();
    while (world.acknowledged() < static_cast<std::size_t>(goal)) {
      ASSERT_FALSE(world.acknowledged_goals().contains(goal));
      world.run(10ms);
    }
    ASSERT_TRUE(world.has_goal(kSecond, goal));
  }
}

TEST(Lease, TheFollowerTakesOverFromADeadLeader) {
  PairWorld world = paired();
  for (int round = 0; round < 6; ++round) {
    const Member old = *world.leader();
    world.kill(old);
    world.run(1700ms);
    EXPECT_EQ(world.leader(), std::nullopt);
    world.run(400ms);
    ASSERT_TRUE(world.leader());
    EXPECT_NE(*world.leader(), old);
    world.start(old);
    world.run(3s);
    EXPECT_EQ(world.last_change(*world.leader()), Lease::Change::paired);
  }
  EXPECT_EQ(world.leads(), 7);
  EXPECT_THAT(world.faults, IsEmpty());
}

TEST(Lease, ALeaderThatStoodStillSendsNothingMore) {
  PairWorld world = paired();
  world.pause(kFirst);
  world.run(2500ms);
  EXPECT_EQ(world.leader(), kSecond);
  world.resume(kFirst);
  world.run(3s);
  EXPECT_EQ(world.leader(), kSecond);
  EXPECT_EQ(world.refused(), 0U) << "nothing was sent that an owner had to refuse";
  EXPECT_THAT(world.faults, IsEmpty());
}

TEST(Lease, ALeaderThatStoodStillAloneBeginsAnew) {
  PairWorld world = paired();
  world.kill(kSecond);
  world.run(5s);
  ASSERT_EQ(world.last_change(kFirst), Lease::Change::alone);
  world.pause(kFirst);
  world.run(3s);
  world.resume(kFirst);
  world.run(10ms);
  EXPECT_EQ(world.last_change(kFirst), Lease::Change::stand_down);
  world.run(2500ms);
  EXPECT_EQ(world.leader(), kFirst);
  EXPECT_EQ(world.leads(), 2);
}

// Nobody heard that it stood still, and still it knows by itself.
TEST(Lease, ALeaderWhoseOwnLeaseRanOutStandsDownUnheard) {
  PairWorld world = paired();
  world.pause(kFirst);
  world.network.cut = true;
  world.run(2500ms);
  world.resume(kFirst);
  world.ask_for_a_goal();
  world.run(10ms);
  EXPECT_EQ(world.last_change(kFirst), Lease::Change::stand_down);
  EXPECT_EQ(world.refused(), 0U);
}

TEST(Lease, WhatALeaderSendsAfterItsLastLookAtTheLeaseIsRefusedByTheOwner) {
  PairWorld world = paired();
  world.stop_before_sending(kFirst);
  world.ask_for_a_goal();
  while (!world.paused(kFirst)) world.run(10ms);
  world.run(3s);
  ASSERT_EQ(world.leader(), kSecond);
  world.resume(kFirst);
  EXPECT_EQ(world.refused(), 1U);
  world.run(3s);
  EXPECT_EQ(world.leader(), kSecond);
  EXPECT_THAT(world.faults, IsEmpty());
}

TEST(Lease, WithoutItsFollowerALeaderGoesOnAlone) {
  PairWorld world = paired();
  world.kill(kSecond);
  world.ask_for_a_goal();
  world.run(1900ms);
  EXPECT_EQ(world.acknowledged(), 0U);
  world.run(2350ms);  // a second of patience, then term and margin
  EXPECT_EQ(world.acknowledged(), 1U);
  EXPECT_EQ(world.last_change(kFirst), Lease::Change::alone);
  EXPECT_TRUE(world.disk(kFirst).persisted_term.alone);
  world.start(kSecond);
  world.run(2s);
  EXPECT_EQ(world.last_change(kFirst), Lease::Change::paired);
  EXPECT_FALSE(world.disk(kFirst).persisted_term.alone);
  EXPECT_TRUE(world.has_goal(kSecond, 1));
}

TEST(Lease, WhoWasAloneLeadsAgainAfterItsDeath) {
  PairWorld world = paired();
  world.kill(kSecond);
  world.run(5s);
  world.kill(kFirst);
  world.start(kFirst);
  world.run(2500ms);
  EXPECT_EQ(world.leader(), kFirst);
}

TEST(Lease, OfTwoThatDiedTheLongerJournalLeads) {
  PairWorld world = paired();
  world.kill(kFirst);
  world.run(4s);
  ASSERT_EQ(world.leader(), kSecond);
  world.ask_for_a_goal();
  world.run(1s);
  ASSERT_EQ(world.acknowledged(), 1U) << "by the second one, alone";
  world.kill(kSecond);
  world.start(kFirst);
  world.run(1s);
  world.start(kSecond);
  world.run(4s);
  EXPECT_EQ(world.leader(), kSecond);
  EXPECT_TRUE(world.has_goal(*world.leader(), 1));
}

TEST(Lease, AFollowerThatLacksSomethingDoesNotLead) {
  PairWorld world = paired();
  world.kill(kSecond);
  world.run(5s);
  world.network.loss_percent = 0;
  world.start(kSecond);
  world.lose_disk(kSecond);
  world.run(20ms);  // it has heard the leader, and has not got the journal yet
  world.kill(kFirst);
  world.run(60s);
  EXPECT_EQ(world.leader(), std::nullopt);
  world.start(kFirst);
  world.run(5s);
  EXPECT_EQ(world.leader(), kFirst);
}

// Its right ended while it was stopped: the leader went on alone, unheard, and died.
TEST(Lease, AFollowerThatWasStoppedDoesNotTakeOverLate) {
  PairWorld world = paired();
  world.pause(kSecond);
  world.ask_for_a_goal();
  world.run(5s);
  ASSERT_EQ(world.acknowledged(), 1U);
  world.kill(kFirst);
  world.drop_messages();
  world.resume(kSecond);
  world.run(10s);
  EXPECT_EQ(world.leader(), std::nullopt);
  world.start(kFirst);
  world.run(5s);
  EXPECT_EQ(world.leader(), kFirst);
}

// Between the members only: both hear the owners, which obey the one that they know.
TEST(Lease, CutApartWhoHasTheOwnersGoesOnLeading) {
  PairWorld world = paired();
  world.network.cut = true;
  for (int goal = 0; goal < 3; ++goal) world.ask_for_a_goal();
  world.run(60s);
  EXPECT_EQ(world.leader(), kFirst);
  EXPECT_EQ(world.leads(), 1) << "who stands by does not even try";
  EXPECT_EQ(world.refused(), 0U);
  EXPECT_EQ(world.acknowledged(), 3U);
  EXPECT_EQ(world.carried_out(), 3U);
  world.network.cut = false;
  world.run(10s);
  EXPECT_EQ(world.leader(), kFirst);
  EXPECT_THAT(world.lost(), IsEmpty());
  EXPECT_TRUE(world.copy_is_near());
  EXPECT_THAT(world.faults, IsEmpty());
}

void cut_owners(PairWorld& world, Member member, bool cut = true) {
  world.network.owner_cut[member == kFirst ? 0 : 1] = {cut, cut, cut};
}
void cut_off(PairWorld& world, Member member, bool cut = true) {
  world.network.cut = cut;
  cut_owners(world, member, cut);
}

// For how long the first one cannot command once an owner is heard again that it has not heard for `lost`; the members
// do not hear each other since `apart` before that.
standby::Moment unable_after(PairWorld& world, standby::Moment apart, standby::Moment lost) {
  world.network.cut = true;
  world.run(apart);
  world.network.owner_cut[0] = {false, false, true};
  world.run(lost);
  world.network.owner_cut = {};
  const standby::Moment healed = world.now();
  while (!world.commands(kFirst) && world.now() - healed < 10s) world.run(10ms);
  return world.now() - healed;
}

// It hears from the owners that its leader lives.
TEST(Lease, AStandbyThatHearsNoLeaderTakesNothingWhileThatOneRenews) {
  for (const standby::Moment apart : {0ms, 30'000ms}) {
    for (const standby::Moment lost : {1600ms, 1700ms, 1800ms, 2000ms, 2200ms, 2600ms}) {
      PairWorld world = paired();
      EXPECT_LE(unable_after(world, apart, lost), 400ms)
          << lost.count() << " us, apart for " << apart.count();
      EXPECT_EQ(world.leads(), 1);
      EXPECT_THAT(world.faults, IsEmpty());
    }
  }
}

TEST(Lease, AStandbyThatHearsNobodyNeverLeads) {
  PairWorld world = paired();
  cut_off(world, kSecond);
  world.run(120s);
  EXPECT_EQ(world.leads(), 1);
  EXPECT_TRUE(world.commands(kFirst));
  cut_off(world, kSecond, false);
  world.run(5s);
  EXPECT_EQ(world.leader(), kFirst);
  EXPECT_EQ(world.last_change(kFirst), Lease::Change::paired);
}

TEST(Lease, ALeaderThatIsCutOffIsReplacedAndItsGoalsAndRecallsAreMerged) {
  PairWorld world = paired();
  for (int goal = 0; goal < 3; ++goal) world.ask_for_a_goal();
  while (world.acknowledged() < 3) world.run(10ms);
  cut_off(world, kFirst);
  world.network.ground_cut[1] = true;  // the ground is where the old leader is
  world.run(5s);
  EXPECT_EQ(world.leader().has_value(), true);
  EXPECT_FALSE(world.commands(kFirst));
  EXPECT_TRUE(world.commands(kSecond));
  world.ask_for_a_goal();
  world.recall(4);
  world.ask_for_a_goal();
  world.recall(3);
  world.change(2);
  world.run(2s);
  EXPECT_TRUE(world.recall_acknowledged(4));
  cut_off(world, kFirst, false);
  world.network.ground_cut[1] = false;
  world.run(10s);
  EXPECT_EQ(world.leader(), kSecond);
  EXPECT_THAT(world.lost(), IsEmpty());
  EXPECT_EQ(world.effects(4), 0);
  EXPECT_EQ(world.effects(5), 1);
  EXPECT_TRUE(world.copy_is_near());
  EXPECT_THAT(world.faults, IsEmpty());
}

// It keeps its partner and loses the robot, which the other one still has.
TEST(Lease, ALeaderWithoutTheOwnersHandsOver) {
  PairWorld world = paired();
  cut_owners(world, kFirst);
  world.run(1s);
  EXPECT_EQ(world.leader(), kFirst);
  world.run(6s);
  EXPECT_EQ(world.leader(), kSecond);
  EXPECT_TRUE(world.commands(kSecond));
  world.run(30s);
  EXPECT_EQ(world.leads(), 2);
  EXPECT_THAT(world.faults, IsEmpty());
}

TEST(Lease, WithoutAnOwnerThatNobodyHasTheLeaderStays) {
  PairWorld world = paired();
  cut_owners(world, kFirst);
  cut_owners(world, kSecond);
  world.run(30s);
  EXPECT_EQ(world.leader(), kFirst);
  EXPECT_EQ(world.leads(), 1);
  EXPECT_FALSE(world.commands(kFirst));
  cut_owners(world, kFirst, false);
  world.run(1s);
  EXPECT_TRUE(world.commands(kFirst));
}

// Each has a part of the owners, so nobody commands; in the end the one that can have all has them.
TEST(Lease, ASplitSetEndsWithOneThatHasAll) {
  PairWorld world = paired();
  world.network.cut = true;
  world.network.owner_cut[0] = {true, false, false};
  world.network.owner_cut[1] = {false, false, true};
  world.run(40s);
  EXPECT_FALSE(world.commands(kFirst));
  EXPECT_FALSE(world.commands(kSecond));
  world.network.owner_cut[0] = {};
  world.run(12s);
  EXPECT_TRUE(world.commands(kFirst));
  world.network.cut = false;
  world.network.owner_cut = {};
  world.run(10s);
  EXPECT_THAT(world.faults, IsEmpty());
  EXPECT_TRUE(world.leader() && world.commands(*world.leader()));
}

// Cuts of log-uniform length of any link, deaths, stops, lost disks, an owner that begins anew; goals, recalls and
// changes meanwhile.
class Disturbance {
 public:
  Disturbance(PairWorld& world, std::uint64_t seed) : world_(world), random_(seed) {}

  void step() {
    for (const Member member : {kFirst, kSecond}) {
      if (world_.alive(member) && one_in(2000)) kill(member);
      if (!world_.alive(member) && one_in(300)) world_.start(member);
      if (world_.alive(member) && !world_.paused(member) && one_in(2000)) world_.pause(member);
      if (one_in(2500)) world_.stop_before_sending(member);
      if (world_.paused(member) && one_in(250)) world_.resume(member);
    }
    if (one_in(100)) world_.ask_for_a_goal();
    const auto known = world_.acknowledged_goals();
    if (!known.empty() && one_in(200)) world_.recall(any_of(known));
    if (!known.empty() && one_in(200)) world_.change(any_of(known));
    if (one_in(500)) world_.network.loss_percent = static_cast<int>(random_() % 30);
    if (one_in(500)) world_.network.longest_delay = 1ms * (random_() % 200);
    if (one_in(4000)) world_.restart_owner(static_cast<int>(random_() % PairWorld::kOwners));
    if (one_in(600)) cut_something();
    for (Cut& cut : cuts_) {
      if (cut.link && world_.now() >= cut.until) *std::exchange(cut.link, nullptr) = false;
    }
    // Goals of a journal that was replaced are on one disk until they are merged.
    whole_ = whole_ || (world_.alive(kFirst) && world_.alive(kSecond) && world_.copy_is_near() &&
                        world_.disk(kFirst).apart.empty() && world_.disk(kSecond).apart.empty());
  }
  // All is mended, and both live.
  void heal() {
    world_.network = {};
    cuts_ = {};
    for (const Member member : {kFirst, kSecond}) {
      if (!world_.alive(member)) world_.start(member);
      world_.resume(member);
    }
    world_.run(90s);
  }

 private:
  struct Cut {
    bool* link = nullptr;
    standby::Moment until{0};
  };
  bool one_in(std::uint64_t n) { return random_() % n == 0; }
  int any_of(const std::set<int>& goals) {
    return *std::next(goals.begin(), static_cast<std::ptrdiff_t>(random_() % goals.size()));
  }
  void kill(Member member) {
    world_.kill(member);
    // What both hold survives one disk, and is held by both again before the next one goes.
    if (!whole_ || !one_in(8)) return;
    world_.lose_disk(member);
    whole_ = false;
  }
  void cut_something() {
    const double seconds = 0.2 * std::pow(300.0, static_cast<double>(random_() % 1000) / 1000);
    const auto until = world_.now() + standby::Moment(static_cast<std::int64_t>(seconds * 1e6));
    const std::size_t member = random_() % 2;
    switch (random_() % 4) {
      case 0:
        return cut(world_.network.cut, until);
      case 1:
        return cut(world_.network.owner_cut[member][random_() % PairWorld::kOwners], until);
      case 2:
        return cut(world_.network.ground_cut[member], until);
      default:  // a host
        cut(world_.network.cut, until);
        for (bool& link : world_.network.owner_cut[member]) cut(link, until);
    }
  }
  void cut(bool& link, standby::Moment until) {
    if (std::exchange(link, true)) return;
    const auto free = std::ranges::find(cuts_, nullptr, &Cut::link);
    if (free != cuts_.end()) {
      *free = {&link, until};
    } else {
      link = false;
    }
  }

  PairWorld& world_;
  std::mt19937_64 random_;
  std::array<Cut, 16> cuts_;
  bool whole_ = false;
};

// What a run of two minutes does wrong; empty: nothing.
std::vector<std::string> faults_of_run(std::uint64_t seed, testing::Bug bug = testing::Bug::none) {
  PairWorld world(seed, {}, bug);
  Disturbance disturbance(world, seed);
  for (int step = 0; step < 12000 && world.faults.empty(); ++step) {
    disturbance.step();
    world.run(10ms);
  }
  if (!world.faults.empty()) return world.faults;
  disturbance.heal();
  std::vector<std::string> out = world.faults;
  for (const std::string& lost : world.lost()) out.push_back("lost: " + lost);
  if (!world.leader() || !world.commands(*world.leader())) {
    out.push_back("nobody leads");
  } else if (!world.copy_is_near()) {
    out.push_back("the copy is far behind");
  }
  return out;
}

// So many runs of the pair are tried; ROCI_PAIR_RUNS=5000 for a campaign.
std::uint64_t runs() {
  const char* setting = std::getenv("ROCI_PAIR_RUNS");
  return setting == nullptr ? 12 : std::stoull(setting);
}

TEST(LeaseAtRandom, NothingIsLostAndNothingIsDoneTwice) {
  for (std::uint64_t seed = 1; seed <= runs(); ++seed) ASSERT_THAT(faults_of_run(seed), IsEmpty()) << seed;
}

// The runs above could find what they look for.
class PlantedBug : public ::testing::TestWithParam<testing::Bug> {};

TEST_P(PlantedBug, IsFound) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed)
    if (!faults_of_run(seed, GetParam()).empty()) return;
  FAIL() << "300 runs found nothing";
}

INSTANTIATE_TEST_SUITE_P(Bugs, PlantedBug,
                         ::testing::Values(testing::Bug::no_owner_leases, testing::Bug::goals_not_merged,
                                           testing::Bug::recall_not_merged,
                                           testing::Bug::acknowledges_early));

}  // namespace
}  // namespace roci::exec
