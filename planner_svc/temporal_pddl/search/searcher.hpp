// A search that goes on where it stopped, so that several can take turns.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"

namespace roci::planner::temporal_pddl {

struct SearchOutcome {
  std::optional<PlanPrefix> plan;  // none: there is no plan
  std::vector<Word> final_state;   // with a plan
  std::string reason;              // without: what stood in the way
};

class Searcher {
 public:
  virtual ~Searcher() = default;

  // Goes on for as much work as so many evaluations are; none: not at its end yet. bytes_elsewhere count as
  // used too. Throws what Watch throws, and Refusal (out_of_memory) if plans of more than kMaxSteps steps
  // would have to be tried.
  virtual std::optional<SearchOutcome> run(std::size_t evaluations, std::size_t bytes_elsewhere) = 0;
  // Whether there is no plan if it finds none.
  virtual bool complete() const = 0;
  // Without the heuristic's, which all searches share.
  virtual std::size_t bytes() const = 0;
};

}  // namespace roci::planner::temporal_pddl
