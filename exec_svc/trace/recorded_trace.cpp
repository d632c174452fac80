#include "exec_svc/trace/recorded_trace.hpp"

#include <utility>

namespace roci::exec::trace {

bool is_decision_kind(std::string_view kind) {
  return kind == "goal" || kind == "event" || kind == "step" || kind == "call";
}

RecordedTrace without_decisions(RecordedTrace trace) {
  if (!trace.decisions) return trace;
  std::erase_if(trace.lines, [](const Line& line) { return is_decision_kind(line.kind()); });
  for (std::size_t i = 0; i < trace.lines.size(); ++i) trace.lines[i].number = i + 1;
  trace.decisions = false;
  return trace;
}

}  // namespace roci::exec::trace
