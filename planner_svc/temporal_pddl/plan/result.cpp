#include "planner_svc/temporal_pddl/plan/result.hpp"

namespace roci::planner::temporal_pddl {

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::solved:
      return "solved";
    case Verdict::unsolvable:
      return "unsolvable";
    case Verdict::timeout:
      return "timeout";
    case Verdict::out_of_memory:
      return "out_of_memory";
    case Verdict::unsupported:
      return "unsupported";
    case Verdict::function_unavailable:
      return "function_unavailable";
    case Verdict::cancelled:
      return "cancelled";
    case Verdict::invalid_input:
      return "invalid_input";
  }
  return "unknown";
}

}  // namespace roci::planner::temporal_pddl
