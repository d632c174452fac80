// A robot, a planner and a ground that do what they like, by seed, and what must hold whatever they do.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "exec_svc/reactor/reactor.hpp"
#include "tests/unit/exec_svc/planetary_fixture.hpp"

namespace roci::exec::testing {

class RandomWorld {
 public:
  explicit RandomWorld(std::uint64_t seed);

  /// Rules fire for a while; then all is well again until nothing more happens; then the ground recalls what
  /// is still open. Fails the test that calls it if an invariant does not hold.
  void run();

  std::map<std::string, int> events;  ///< how often each code was told, and each rule fired

 private:
  bool one_in(std::uint64_t n) { return random_() % n == 0; }
  temporal::Time time_up_to(std::int64_t seconds);
  void fire_rule();
  void send_goal();
  void step();
  void let_pass(temporal::Time until);
  void take(const reactor::ReactorOutputs& out);
  void obey(const executive::Command& command);
  void execute(const executive::Command& command);
  void end_job(const std::string& activity);
  reactor::PlanReply answer_of(const reactor::PlanRequest& call);
  void acknowledge(const executive::Command& command, executive::CommandStage stage);
  void observe(const std::string& timeline, temporal::Value value);
  void check(const reactor::ReactorOutputs& out);
  void check_steps();

  using Key = std::pair<std::string, std::uint32_t>;
  struct Job {
    executive::Command command;
    temporal::Time ends{0};
  };

  std::mt19937_64 random_;
  mission::MissionModel mission_;
  reactor::Reactor reactor_;
  temporal::Time now_{0};
  reactor::ReactorInputs pending_;
  std::map<std::string, Job> jobs_;
  std::multimap<temporal::Time, reactor::PlanReply> answers_;
  std::optional<temporal::Time> wake_;
  bool wild_ = true;  ///< rules fire; else everybody does what is asked
  bool dead_ = false;
  int outstanding_calls_ = 0;
  int steps_at_this_time_ = 0;
  std::set<Key> executed_;
  std::map<goals::GoalKey, goals::GoalState> final_;
};

}  // namespace roci::exec::testing
