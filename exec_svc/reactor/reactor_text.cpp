#include "exec_svc/reactor/reactor.hpp"

namespace roci::exec::reactor {

const char* to_string(PlanVerdict verdict) {
  switch (verdict) {
    case PlanVerdict::solved:
      return "solved";
    case PlanVerdict::unsolvable:
      return "unsolvable";
    case PlanVerdict::timeout:
      return "timeout";
    case PlanVerdict::out_of_memory:
      return "out_of_memory";
    case PlanVerdict::unsupported:
      return "unsupported";
    case PlanVerdict::function_unavailable:
      return "function_unavailable";
    case PlanVerdict::cancelled:
      return "cancelled";
    case PlanVerdict::invalid_input:
      return "invalid_input";
    case PlanVerdict::crashed:
      return "crashed";
    case PlanVerdict::no_reply:
      return "no_reply";
  }
  return "unknown";
}

const char* to_string(MissionPhase phase) {
  switch (phase) {
    case MissionPhase::idle:
      return "idle";
    case MissionPhase::pausing:
      return "pausing";
    case MissionPhase::planning:
      return "planning";
    case MissionPhase::executing:
      return "executing";
    case MissionPhase::safe:
      return "safe";
    case MissionPhase::finished:
      return "finished";
  }
  return "unknown";
}

}  // namespace roci::exec::reactor
