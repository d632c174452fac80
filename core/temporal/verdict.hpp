// A verdict says how a call to a planning engine ended, whatever the engine: engines, executive, wire and
// console all use it.
#pragma once

#include <cstdint>

namespace roci::temporal {

/// Says how a call ended, in the order of Verdict in idl/planner.idl.
enum class Verdict : std::uint8_t {
  solved,                ///< a plan came with it
  unsolvable,            ///< proved: no plan achieves all goals
  timeout,               ///< the budget of work or time is spent, nothing is proved
  out_of_memory,         ///< the budget of memory is spent, nothing is proved
  unsupported,           ///< the engine does not take this input; the reason names the place
  function_unavailable,  ///< an external function's owner did not answer
  cancelled,             ///< the caller asked for it
  invalid_input,         ///< malformed; the reason names the place
  crashed,               ///< a defect of the engine or of the process around it
  no_reply,              ///< said by the caller: no answer came within its deadline
};

/// Returns the name above: "solved", "out_of_memory", …
const char* to_string(Verdict verdict);

/// Returns whether it says something about the goals (they do not fit, or no way was found within the budget)
/// rather than about the services or the input.
bool speaks_of_goals(Verdict verdict);

}  // namespace roci::temporal
