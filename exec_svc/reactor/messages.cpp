#include "exec_svc/reactor/messages.hpp"

namespace roci::exec::reactor {

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
