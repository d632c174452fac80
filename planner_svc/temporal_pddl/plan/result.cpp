#include "planner_svc/temporal_pddl/plan/result.hpp"

namespace roci::planner::temporal_pddl {

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::kSolved:
      return "solved";
    case Verdict::kUnsolvable:
      return "unsolvable";
    case Verdict::kTimeout:
      return "timeout";
    case Verdict::kOutOfMemory:
      return "out_of_memory";
    case Verdict::kUnsupported:
      return "unsupported";
    case Verdict::kFunctionUnavailable:
      return "function_unavailable";
    case Verdict::kCancelled:
      return "cancelled";
    case Verdict::kInvalidInput:
      return "invalid_input";
  }
  return "unknown";
}

}  // namespace roci::planner::temporal_pddl
