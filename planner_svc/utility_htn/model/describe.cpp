#include "planner_svc/utility_htn/model/describe.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace roci::planner::utility_htn::model {

std::string to_text(double number) {
  if (!std::isfinite(number)) return "none";
  std::array<char, 32> digits{};
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  return error == std::errc() ? std::string(digits.data(), end) : "none";
}

std::string to_text(const Amount& amount, const Network& network) {
  if (!amount.parameter) return to_text(amount.constant);
  const std::string& name = network.parameters.at(*amount.parameter).name;
  std::string out = amount.factor == 1    ? name
                    : amount.factor == -1 ? "-" + name
                                          : to_text(amount.factor) + " * " + name;
  if (amount.constant > 0) out += " + " + to_text(amount.constant);
  if (amount.constant < 0) out += " - " + to_text(-amount.constant);
  return out;
}

std::string to_text(const temporal::timelines::Constraint& constraint, const Network& network) {
  const auto& timeline = network.timelines.at(constraint.timeline);
  if (timeline.kind == temporal::timelines::Kind::state) {
    std::string permitted;
    int count = 0;
    for (std::size_t state = 0; state < timeline.states.size(); ++state) {
      if ((constraint.states >> state & 1U) == 0) continue;
      permitted += (count++ == 0 ? "" : ", ") + timeline.states[state];
    }
    return timeline.name + (count == 1 ? " = " : " in ") + permitted;
  }
  if (constraint.lowest == constraint.highest) return timeline.name + " = " + to_text(constraint.lowest);
  const bool below = std::isfinite(constraint.highest), above = std::isfinite(constraint.lowest);
  if (above && !below) return timeline.name + " >= " + to_text(constraint.lowest);
  if (below && !above) return timeline.name + " <= " + to_text(constraint.highest);
  return timeline.name + " in " + to_text(constraint.lowest) + " .. " + to_text(constraint.highest);
}

std::string_view to_text(temporal::timelines::Kind kind) {
  static constexpr std::array<std::string_view, 5> words{"atomic", "state", "claimable", "cumulative",
                                                         "cumulative_rate"};
  return words.at(static_cast<std::size_t>(kind));
}

std::string_view to_text(Tier tier) {
  static constexpr std::array<std::string_view, 4> words{"critical", "decisional", "mandatory", "residual"};
  return words.at(static_cast<std::size_t>(tier));
}

std::string_view to_text(Measure measure) {
  static constexpr std::array<std::string_view, 4> words{"duration_s", "energy", "power", "values"};
  return words.at(static_cast<std::size_t>(measure));
}

}  // namespace roci::planner::utility_htn::model
