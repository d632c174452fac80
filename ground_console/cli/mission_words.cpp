#include "ground_console/cli/mission_words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/mission/mission_file.hpp"
#include "ground_console/cli/report.hpp"
#include "ground_console/lib/mission_view.hpp"

namespace roci::console::cli {
namespace {

using mission::Entry;

// Where there is no PDDL domain, a goal's window is the engine's business.
GoalKindWords read_kind(const std::string& name, const Entry& entry, bool has_domain) {
  GoalKindWords out;
  out.name = name;
  out.help = entry.text_or("help", "");
  out.has_window = !has_domain || entry.find("window").has_value();
  if (const auto arguments = entry.find("arguments"))
    for (const auto& [argument, kind] : arguments->fields())
      out.arguments.emplace_back(argument, kind.text());
  if (const auto example = entry.find("example"))
    for (const auto& [argument, value] : example->fields()) out.example[argument] = value.text();
  return out;
}

std::string placeholder_of(const std::string& kind) {
  if (kind == "number") return "NUMBER";
  return kind == "goal" ? "GOAL" : "TEXT";
}

}  // namespace

std::string MissionWords::unit_of(const std::string& timeline) const {
  if (const auto own = units.find(timeline); own != units.end()) return own->second;
  for (const auto& [pattern, unit] : units)
    if (pattern.ends_with('*') && timeline.starts_with(pattern.substr(0, pattern.size() - 1))) return unit;
  return "";
}

std::string amount_text(double amount, const std::string& unit) {
  if (unit.empty()) return lib::value_text(amount);
  constexpr std::array kWithPrefix{"J", "W", "Wh", "B", "b"};
  if (std::ranges::find(kWithPrefix, unit) == kWithPrefix.end()) return lib::value_text(amount) + " " + unit;
  constexpr std::array kPrefixes{"", "k", "M", "G"};
  std::size_t prefix = 0;
  for (; std::abs(amount) >= 999.5 && prefix + 1 < kPrefixes.size(); ++prefix) amount /= 1000;
  std::array<char, 32> digits{};
  std::snprintf(digits.data(), digits.size(), std::abs(amount) >= 1000 ? "%.0f" : "%.3g", amount);
  return std::string(digits.data()) + " " + kPrefixes[prefix] + unit;
}

MissionWords read_mission_words(const std::filesystem::path& folder_or_file) {
  const Entry root = mission::load_mission_file(folder_or_file);
  MissionWords out;
  out.name = root.text_or("name", "");
  if (const auto kinds = root.find("goal_kinds"))
    for (const auto& [name, entry] : kinds->fields())
      out.goal_kinds.push_back(read_kind(name, entry, root.find("domain").has_value()));
  if (const auto units = root.find("units"))
    for (const auto& [timeline, unit] : units->fields()) out.units[timeline] = unit.text();
  return out;
}

std::string example_of(const GoalKindWords& kind) {
  std::string out = "roci goal add NAME " + kind.name;
  for (const auto& [argument, of_kind] : kind.arguments) {
    const auto value = kind.example.find(argument);
    out += " " + argument + "=" + (value == kind.example.end() ? placeholder_of(of_kind) : value->second);
  }
  return out;
}

std::string goal_kinds_text(const MissionWords& words) {
  std::string out;
  for (const GoalKindWords& kind : words.goal_kinds) {
    out +=
        (out.empty() ? "" : "\n") + printable(kind.name + (kind.help.empty() ? "" : ": " + kind.help)) + "\n";
    for (const auto& [argument, of_kind] : kind.arguments)
      out +=
          "  " + printable(argument + "  " + (of_kind == "goal" ? "the id of another goal" : of_kind)) + "\n";
    if (kind.has_window) out += "  --opens, --closes  its window, in mission time\n";
    out += "  e.g. " + printable(example_of(kind)) + "\n";
  }
  return out;
}

nlohmann::json goal_kinds_json(const MissionWords& words) {
  nlohmann::json out = nlohmann::json::array();
  for (const GoalKindWords& kind : words.goal_kinds) {
    nlohmann::json arguments = nlohmann::json::object();
    for (const auto& [argument, of_kind] : kind.arguments) arguments[argument] = of_kind;
    out.push_back({{"kind", kind.name},
                   {"help", kind.help},
                   {"arguments", std::move(arguments)},
                   {"window", kind.has_window},
                   {"example", example_of(kind)}});
  }
  return out;
}

}  // namespace roci::console::cli
