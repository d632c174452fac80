#include "tests/architecture/floors.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <optional>

namespace roci::architecture {
namespace {

// From the ground up. An entry is a folder (with its own subfolders) or a file; the longest entry that fits
// counts.
struct House {
  std::string folder;
  std::vector<std::string> floors;
};

const std::vector<House> kHouses = {
    {"core/",
     {"core/bytes/", "core/durable/", "core/temporal/", "core/words/", "core/pseudorandom/", "core/mission/",
      "core/pddl/", "core/kinematics/", "core/terrain/"}},
    {"services/",
     {"services/bounds/", "services/clock/", "services/link/", "services/log/", "services/wire/",
      "services/transport/", "services/certificate/", "services/vendors/", "services/topics/",
      "services/health/", "services/node/", "services/rpc/", "services/", "services/owner/",
      "services/commander/", "services/security/", "services/process/", "services/launch/"}},
    {"planner_svc/",
     {"planner_svc/engine/", "planner_svc/temporal_pddl/", "planner_svc/utility_htn/",
      "planner_svc/timeline_htn/", "planner_svc/"}},
    // The checker shares the readers alone with what it checks.
    {"planner_svc/utility_htn/",
     {"planner_svc/utility_htn/model/", "planner_svc/utility_htn/reading/",
      "planner_svc/utility_htn/checking/", "planner_svc/utility_htn/flattening/",
      "planner_svc/utility_htn/assessor/", "planner_svc/utility_htn/downlink/",
      "planner_svc/utility_htn/search/", "planner_svc/utility_htn/strategies/",
      "planner_svc/utility_htn/delivery/", "planner_svc/utility_htn/cycle/",
      "planner_svc/utility_htn/adapter/", "planner_svc/utility_htn/cli/", "planner_svc/utility_htn/"}},
    {"dedicated_svc/", {"dedicated_svc/methods/", "dedicated_svc/method_run/", "dedicated_svc/"}},
    {"planner_svc/timeline_htn/",
     {"planner_svc/timeline_htn/model/", "planner_svc/timeline_htn/reading/",
      "planner_svc/timeline_htn/request/", "planner_svc/timeline_htn/checking/",
      "planner_svc/timeline_htn/search/", "planner_svc/timeline_htn/extraction/",
      "planner_svc/timeline_htn/adapter/", "planner_svc/timeline_htn/cli/", "planner_svc/timeline_htn/"}},
    {"exec_svc/",
     {"exec_svc/archive/", "exec_svc/executive/", "exec_svc/mission/", "exec_svc/goals/", "exec_svc/orders/",
      "exec_svc/beliefs/", "exec_svc/problem/", "exec_svc/reactor/", "exec_svc/journal/", "exec_svc/standby/",
      "exec_svc/", "exec_svc/replay/", "exec_svc/trace/"}},
    {"sim_svc/",
     {"sim_svc/world/", "sim_svc/setup/", "sim_svc/components/", "sim_svc/scenario/", "sim_svc/"}},
};

// The floor of a file in a house, counted from the ground.
std::optional<std::size_t> floor_of(const House& house, const std::string& path) {
  std::optional<std::size_t> found;
  std::size_t length = 0;
  for (std::size_t floor = 0; floor < house.floors.size(); ++floor) {
    const std::string& entry = house.floors[floor];
    const bool face = entry == house.folder;  // its own files, none of its folders
    const bool fits = face ? path.starts_with(entry) && path.find('/', entry.size()) == std::string::npos
                           : path.starts_with(entry);
    if (!fits || entry.size() < length) continue;
    found = floor;
    length = entry.size();
  }
  return found;
}

using Includes = std::map<std::string, const std::vector<std::string>*>;

// What `start` reaches, each with the file that includes it on the shortest chain.
std::map<std::string, std::string> reach(const std::string& start, const Includes& includes) {
  std::map<std::string, std::string> from{{start, ""}};
  std::deque<std::string> open{start};
  while (!open.empty()) {
    const std::string file = open.front();
    open.pop_front();
    for (const std::string& include : *includes.at(file)) {
      if (includes.contains(include) && from.emplace(include, file).second) open.push_back(include);
    }
  }
  return from;
}

std::string chain_to(const std::string& end, const std::map<std::string, std::string>& from) {
  std::string text = end;
  for (std::string file = from.at(end); !file.empty(); file = from.at(file)) text = file + " -> " + text;
  return text;
}

void check(const House& house, const SourceFile& file, const Includes& includes,
           std::vector<std::string>& out) {
  const auto own = floor_of(house, file.path);
  if (!own) {
    out.push_back(file.path + ": stands on no floor of " + house.folder + "; give its folder one");
    return;
  }
  const auto from = reach(file.path, includes);
  for (const auto& [reached, by] : from) {
    const auto other = floor_of(house, reached);
    if (other && *other > *own) {
      out.push_back(file.path + ": reaches " + reached + ", a floor above it: " + chain_to(reached, from));
      return;
    }
  }
}

}  // namespace

std::vector<std::string> upward_includes(const std::vector<SourceFile>& files) {
  Includes includes;
  for (const SourceFile& file : files) includes[file.path] = &file.includes;
  std::vector<std::string> out;
  for (const SourceFile& file : files) {
    for (const House& house : kHouses) {
      if (file.path.starts_with(house.folder)) check(house, file, includes, out);
    }
  }
  return out;
}

std::vector<std::string> pddl_outside_its_door(const std::vector<SourceFile>& files) {
  static const std::vector<std::string> door = {"exec_svc/mission", "exec_svc/problem"};
  Includes includes;
  for (const SourceFile& file : files) includes[file.path] = &file.includes;
  std::vector<std::string> out;
  for (const SourceFile& file : files) {
    const auto holds = [&](const std::string& folder) { return file.under(folder); };
    if (!file.under("exec_svc") || std::ranges::any_of(door, holds)) continue;
    const auto from = reach(file.path, includes);
    const auto pddl = std::ranges::find_if(
        from, [](const auto& reached) { return reached.first.starts_with("core/pddl/"); });
    if (pddl != from.end())
      out.push_back(file.path + ": reaches " + pddl->first +
                    ", which of exec_svc mission/ and problem/ do alone: " + chain_to(pddl->first, from));
  }
  return out;
}

}  // namespace roci::architecture
