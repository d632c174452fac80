#include <algorithm>
#include <charconv>
#include <cmath>

#include "planner_svc/utility_htn/adapter/plan_of.hpp"

namespace roci::planner::utility_htn::adapter {

using temporal::timelines::Definition, temporal::timelines::Kind;

std::string activity_id(const model::Network& network, const cycle::Link& link, cycle::TaskId id) {
  return network.tasks[link.task].id + "#" + std::to_string(cycle::block_of(id)) + "." +
         std::to_string(cycle::link_of(id));
}

std::optional<cycle::TaskId> task_of(const std::string& activity) {
  const std::size_t mark = activity.rfind('#');
  const std::size_t dot = activity.rfind('.');
  if (mark == std::string::npos || dot == std::string::npos || dot < mark) return std::nullopt;
  const auto number = [&](std::size_t from, std::size_t to) -> std::optional<std::uint32_t> {
    std::uint32_t out = 0;
    const char* const end = activity.data() + to;
    const auto [stop, error] = std::from_chars(activity.data() + from, end, out);
    return error == std::errc{} && stop == end ? std::optional(out) : std::nullopt;
  };
  const auto block = number(mark + 1, dot);
  const auto link = number(dot + 1, activity.size());
  if (!block || !link) return std::nullopt;
  return cycle::task_id(*block, *link);
}

std::optional<double> number_of(const Definition& timeline, const temporal::Value& value) {
  if (timeline.kind == Kind::state) {
    const auto found = std::ranges::find(timeline.states, temporal::to_text(value));
    if (found == timeline.states.end()) return std::nullopt;
    return static_cast<double>(found - timeline.states.begin());
  }
  if (const auto* truth = std::get_if<bool>(&value)) return *truth ? 1.0 : 0.0;
  const auto* number = std::get_if<double>(&value);
  return number != nullptr && std::isfinite(*number) ? std::optional(*number) : std::nullopt;
}

temporal::Value value_of(const Definition& timeline, double number) {
  if (timeline.kind != Kind::state) return number;
  const std::string& text = timeline.states.at(static_cast<std::size_t>(number));
  if (text == "true") return true;
  if (text == "false") return false;
  const std::size_t open = text.find('(');
  if (open == std::string::npos) return temporal::state(text);
  temporal::State out{text.substr(0, open), {}};
  std::size_t from = open + 1;
  while (from < text.size()) {
    const std::size_t to = std::min(text.find_first_of(",)", from), text.size());
    out.arguments.push_back(text.substr(from, to - from));
    from = text.find_first_not_of(", ", to);
    if (from == std::string::npos || text[to] == ')') break;
  }
  return out;
}

}  // namespace roci::planner::utility_htn::adapter
