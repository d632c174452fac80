// Large neighbourhood search (Shaw 1998) on plans: a part is taken out at random, the rest is completed
// again, and what comes out stays if it is no worse.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/improvement/completion.hpp"
#include "planner_svc/temporal_pddl/improvement/replay.hpp"

namespace roci::planner::temporal_pddl {

class Neighbourhood {
 public:
  Neighbourhood(const Task& task, std::span<const Guide> guides, const Options& options, Watch& watch,
                Statistics& statistics);

  struct Outcome {
    bool changed = false;
    std::size_t evaluations = 0;  // the work that it was
  };
  // One try: the plan becomes another one of at most its metric and makespan, or stays.
  Outcome vary(PlanPrefix& plan, Replay& replay);

 private:
  struct Unit {              // an action of the plan
    std::uint32_t step = 0;  // of its start
    Ticks start = 0;
    Ticks end = 0;
    ActionId action;
  };

  // A way to complete what is left, and what it has given.
  struct Way {
    CompletionRule rule;
    std::size_t gains = 0;  // better plans
    std::size_t spent = 0;  // evaluations
  };

  Way& choose_way();
  std::size_t below(std::size_t bound) { return static_cast<std::size_t>(random_() % bound); }
  void find_units(const PlanPrefix& plan, Replay& replay);
  std::size_t choose_size();
  void choose_stretch();
  void choose_object();
  void choose_late();

  const Task& task_;
  std::span<const Guide> guides_;
  Completion completion_;
  std::mt19937_64 random_;
  std::vector<Way> ways_;
  std::vector<Unit> units_;  // by start
  std::vector<std::uint32_t> dropped_;
};

}  // namespace roci::planner::temporal_pddl
