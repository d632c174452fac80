#include "core/temporal/value.hpp"

#include <array>
#include <cstdio>

namespace roci::temporal {
namespace {

struct ToText {
  std::string operator()(std::monostate) const { return "none"; }
  std::string operator()(bool truth) const { return truth ? "true" : "false"; }
  std::string operator()(double number) const {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.9g", number);
    return text.data();
  }
  std::string operator()(const State& state) const {
    std::string text = state.name;
    for (std::size_t i = 0; i < state.arguments.size(); ++i)
      text += (i == 0 ? "(" : ", ") + state.arguments[i];
    return state.arguments.empty() ? text : text + ")";
  }
};

}  // namespace

std::string to_text(const Value& value) { return std::visit(ToText{}, value); }

}  // namespace roci::temporal
