// Polls budget and cancellation from inside long loops.
#pragma once

#include <cstddef>

#include "planner_svc/temporal_pddl/planner.hpp"

namespace roci::planner::temporal_pddl {

class Watch {
 public:
  Watch(const Budget& budget, const Monitor& monitor) : budget_(budget), monitor_(monitor) {}

  // Throws Refusal: cancelled, timeout.
  void poll() const;
  // As poll(), but only once in a few hundred calls: for steps of about a microsecond.
  void step() {
    if (++steps_ % 256 == 0) poll();
  }
  // Throws Refusal (out_of_memory) if the engine's memory would exceed the budget; keeps the peak.
  void memory(std::size_t bytes);
  // So many bytes stay for good and count on top of all that is reported from now on.
  void hold(std::size_t bytes) { held_bytes_ = bytes; }
  // As memory(), for what comes for a time on top of what was last reported there.
  void memory_on_top(std::size_t more);
  // As memory_on_top(), before it is taken.
  void require_room(std::size_t more) const;
  // Throws Refusal (timeout) if that many heuristic evaluations exceed the budget for the first plan.
  void evaluations(std::size_t count) const;
  // From now on evaluations() lets everything pass.
  void first_plan_found() { has_plan_ = true; }

  void progress(const Statistics& statistics) const {
    if (monitor_.progress) monitor_.progress(statistics);
  }
  bool cancelled() const { return monitor_.cancelled && monitor_.cancelled(); }
  std::size_t memory_limit() const { return budget_.memory_bytes; }
  std::size_t peak_bytes() const { return peak_bytes_; }

 private:
  const Budget& budget_;
  const Monitor& monitor_;
  std::size_t steps_ = 0;
  std::size_t held_bytes_ = 0;
  bool has_plan_ = false;
  std::size_t bytes_ = 0;  // as last reported
  std::size_t peak_bytes_ = 0;
};

}  // namespace roci::planner::temporal_pddl
