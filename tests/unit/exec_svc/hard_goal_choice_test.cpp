// Which hard goals fail when not even those all fit: against brute force over all sets (B2).
#include "exec_svc/reactor/hard_goal_choice.hpp"

#include <bit>
#include <optional>
#include <random>
#include <set>

#include "tests/unit/exec_svc/reactor_fixture.hpp"

namespace roci::exec::testing {
namespace {

using goals::GoalClass;
using goals::GoalRequest;
using goals::GoalState;
using reactor::PlanRequest;
using temporal::Verdict;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Names = std::vector<std::string>;

// Goals of which no plan has all of any of these sets.
struct Conflicts {
  std::vector<std::set<std::string>> sets;
  bool allow(const std::set<std::string>& goals) const {
    return std::ranges::none_of(sets, [&](const auto& set) { return std::ranges::includes(goals, set); });
  }
};

class HardGoalChoice : public ReactorTest {
 protected:
  // A planner that has a plan of what is asked for unless that holds a conflict.
  void set_conflicts(Conflicts conflicts) {
    planner = [this, conflicts = std::move(conflicts)](const PlanRequest& call) {
      std::set<std::string> asked;
      for (const problem::ProblemGoal& goal : call.problem.goals) asked.insert(goal.key.id);
      calls.emplace_back(asked.begin(), asked.end());
      if (conflicts.allow(asked)) return image_every_goal(call);
      for (const auto& set : conflicts.sets)
        if (set.size() == 1 && asked.contains(*set.begin())) return blocked({*set.begin()});
      return reply(Verdict::unsolvable, "too much");
    };
  }
  Names in_state(GoalState state) const {
    Names out;
    for (const goals::GoalRecord* goal : reactor.goals().all())
      if (goal->state == state) out.push_back(goal->request.key.id);
    return out;
  }

  std::vector<Names> calls;
};

// The big one came first, and each of the small ones fits without it alone.
const Conflicts kBigAgainstSmall{{{"big", "a"}, {"big", "b"}}};

TEST_F(HardGoalChoice, WithoutTrialsTheNewestFailUntilTheOthersFit) {
  set_conflicts(kBigAgainstSmall);
  run(1000, robot_and({photo("big"), photo("a"), photo("b")}));
  EXPECT_THAT(in_state(GoalState::failed), ElementsAre("a", "b"));
}

TEST_F(HardGoalChoice, OfGoalsWorthTheSameTheLowestPriorityFails) {
  set_conflicts({{{"a", "b"}}});
  GoalRequest low = photo("a");
  low.priority = -1;
  run(1000, robot_and({low, photo("b")}));
  EXPECT_THAT(in_state(GoalState::failed), ElementsAre("a")) << "though b is newer";
}

TEST_F(HardGoalChoice, ATrialBeginsWithTheLowestPriority) {
  mission.executive.hard_goal_trials = 10;
  set_conflicts({{{"a", "b"}}});
  GoalRequest low = photo("a");
  low.priority = -1;
  run(1000, robot_and({low, photo("b")}));
  EXPECT_THAT(in_state(GoalState::failed), ElementsAre("a"));
  EXPECT_EQ(std::count(trace.begin(), trace.end(), "goal.weighed"), 1);
}

TEST_F(HardGoalChoice, TheFewestFailThatLeaveAPlanForTheOthers) {
  mission.executive.hard_goal_trials = 10;
  set_conflicts(kBigAgainstSmall);
  run(1000, robot_and({photo("big", GoalClass::hard, 9), photo("a"), photo("b")}));
  EXPECT_THAT(in_state(GoalState::failed), ElementsAre("big"));
  EXPECT_THAT(in_state(GoalState::achieved), ElementsAre("a", "b"));
  EXPECT_THAT(reasons["big"], HasSubstr("no plan achieves all of big, a, b; with what leaves gone, the other "
                                        "hard goals have a plan\ndetails: too much"));
  EXPECT_EQ(std::count(trace.begin(), trace.end(), "goal.weighed"), 3) << "without b, a, big";
}

TEST_F(HardGoalChoice, AfterAsManyTrialsAsTheMissionAllowsItIsAsWithout) {
  mission.executive.hard_goal_trials = 2;
  set_conflicts(kBigAgainstSmall);
  run(1000, robot_and({photo("big", GoalClass::hard, 9), photo("a"), photo("b")}));
  EXPECT_THAT(in_state(GoalState::failed), ElementsAre("a", "b"));
  EXPECT_THAT(reasons["b"],
              ::testing::StartsWith(
                  "no plan achieves all of big, a, b; this one leaves first, as the newest hard goal\n"))
      << "none was found that it saves";
}

TEST_F(HardGoalChoice, SoftGoalsGoBeforeAnyTrial) {
  mission.executive.hard_goal_trials = 10;
  set_conflicts({{{"big", "soft"}}});
  run(1000, robot_and({photo("big"), photo("soft", GoalClass::optional, 9)}));
  EXPECT_THAT(in_state(GoalState::dropped), ElementsAre("soft"));
  EXPECT_EQ(std::count(trace.begin(), trace.end(), "goal.weighed"), 0);
}

TEST_F(HardGoalChoice, OneThatIsProvedOutOfReachFailsWithoutTrials) {
  mission.executive.hard_goal_trials = 10;
  set_conflicts({{{"walled"}}});
  run(1000, robot_and({photo("walled"), photo("a"), photo("b")}));
  EXPECT_THAT(in_state(GoalState::failed), ElementsAre("walled"));
  EXPECT_EQ(std::count(trace.begin(), trace.end(), "goal.weighed"), 0);
}

TEST_F(HardGoalChoice, AGoalThatComesMeanwhileBeginsAnew) {
  mission.executive.hard_goal_trials = 10;
  planning_time = seconds(10);
  set_conflicts(kBigAgainstSmall);
  run(35, robot_and({photo("big"), photo("a"), photo("b")}));
  ASSERT_GE(std::count(trace.begin(), trace.end(), "goal.weighed"), 1);
  calls.clear();
  reactor::ReactorInputs more;
  more.goals = {photo("c")};
  run(3000, std::move(more));
  EXPECT_THAT(calls.front(), ElementsAre("a", "b", "big", "c"));
  EXPECT_THAT(in_state(GoalState::failed), ElementsAre("big"));
  EXPECT_THAT(in_state(GoalState::achieved), ElementsAre("a", "b", "c"));
}

// What should fail, by trying every set: the fewest, then the least utility, then the newest.
struct Failing {
  unsigned goals;  // a bit each, in order of arrival
  int utility;
  bool better_than(const Failing& other) const {
    const int count = std::popcount(goals) - std::popcount(other.goals);
    if (count != 0) return count < 0;
    if (utility != other.utility) return utility < other.utility;
    return goals > other.goals;
  }
};

TEST(HardGoalChoiceOverAllSets, FailsWhatBruteForceWouldLetFail) {
  std::mt19937 random(20261124);
  const auto below = [&](unsigned limit) { return static_cast<unsigned>(random() % limit); };
  int several = 0;
  for (int round = 0; round < 150; ++round) {
    const unsigned count = 2 + below(4);
    std::vector<GoalRequest> wanted;
    std::vector<int> utility;
    for (unsigned i = 0; i < count; ++i) {
      utility.push_back(static_cast<int>(below(3)));
      wanted.push_back(photo("g" + std::to_string(i), GoalClass::hard, utility.back()));
    }
    Conflicts conflicts;
    for (unsigned i = 0, sets = 1 + below(4); i < sets; ++i) {
      std::set<std::string> one;
      for (unsigned size = 1 + below(3); one.size() < std::min(size, count);)
        one.insert("g" + std::to_string(below(count)));
      conflicts.sets.push_back(one);
    }
    std::optional<Failing> best;
    for (unsigned failing = 0; failing < 1U << count; ++failing) {
      std::set<std::string> kept;
      Failing one{failing, 0};
      for (unsigned i = 0; i < count; ++i) {
        if ((failing >> i & 1U) != 0) {
          one.utility += utility[i];
        } else {
          kept.insert("g" + std::to_string(i));
        }
      }
      if (conflicts.allow(kept) && (!best || one.better_than(*best))) best = one;
    }
    struct Flight : HardGoalChoice {
      using HardGoalChoice::in_state, HardGoalChoice::mission, HardGoalChoice::robot_and, HardGoalChoice::run,
          HardGoalChoice::set_conflicts;
      void TestBody() override {}
    } flight;
    flight.mission.executive.hard_goal_trials = 100;
    flight.set_conflicts(conflicts);
    flight.run(3000, flight.robot_and(wanted));
    Names expected;
    for (unsigned i = 0; i < count; ++i)
      if ((best->goals >> i & 1U) != 0) expected.push_back("g" + std::to_string(i));
    EXPECT_EQ(flight.in_state(GoalState::failed), expected) << "round " << round;
    several += expected.size() > 1 ? 1 : 0;
  }
  EXPECT_GE(several, 20) << "rounds in which one goal was not enough";
}

TEST(LeavingSets, AreBoundedHoweverManyGoalsThereAre) {
  const mission::MissionModel mission = planetary();
  goals::GoalSet goals(mission);
  std::vector<goals::GoalKey> among;
  for (int i = 0; i < 300; ++i) {
    goals.submit(photo("g" + std::to_string(i)), seconds(0));
    among.push_back({"ground", "g" + std::to_string(i)});
  }
  const auto sets = reactor::leaving_sets(goals, among, 100'000);
  ASSERT_EQ(sets.size(), 300U) << "of pairs there are too many";
  EXPECT_THAT(sets.front(), ElementsAre(goals::GoalKey{"ground", "g299"}));
}

}  // namespace
}  // namespace roci::exec::testing
