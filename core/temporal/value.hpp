// The value of a timeline at one time.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace roci::temporal {

/// A named state with arguments: going-to (wp-2).
struct State {
  std::string name;
  std::vector<std::string> arguments;
  friend bool operator==(const State&, const State&) = default;
};

/// none | boolean | number | state, in the order of ValueKind in idl/basic.idl.
using Value = std::variant<std::monostate, bool, double, State>;

inline Value state(std::string name, std::vector<std::string> arguments = {}) {
  return State{std::move(name), std::move(arguments)};
}

/// "none", "true", "12.5", "going-to(wp-2)".
std::string to_text(const Value& value);

}  // namespace roci::temporal
