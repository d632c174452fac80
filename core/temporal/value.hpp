// A value is what a timeline has at one time.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace roci::temporal {

/// Holds a named state with arguments: going-to (wp-2).
struct State {
  std::string name;
  std::vector<std::string> arguments;
  friend bool operator==(const State&, const State&) = default;
};

/// Holds none, a boolean, a number or a state, in the order of ValueKind in idl/basic.idl.
using Value = std::variant<std::monostate, bool, double, State>;

/// Returns a state as a value.
inline Value state(std::string name, std::vector<std::string> arguments = {}) {
  return State{std::move(name), std::move(arguments)};
}

/// Prints "none", "true", "12.5" or "going-to(wp-2)".
std::string to_text(const Value& value);

}  // namespace roci::temporal
