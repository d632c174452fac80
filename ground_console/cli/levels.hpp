// This file arranges the levels of a plan: activities, each followed by its parts.
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace roci::console::cli {

/// Holds an activity at its depth in the hierarchy; 0 is the top.
template <class Activity>
struct InLevels {
  const Activity* activity = nullptr;
  std::size_t depth = 0;
};

/// However parents may be linked, no view is deeper.
inline constexpr std::size_t kDeepest = 20;

/// Returns the activities with their depths: parts behind what they are parts of, those of one parent by `start_of`,
/// equal ones as they stood. Who names a parent that is not there stands at the top. What stands in a circle of
/// parents, or deeper than kDeepest, comes last, at the top, so that nothing is missing.
template <class Activity, class StartOf>
std::vector<InLevels<Activity>> in_levels(const std::vector<Activity>& activities, StartOf start_of) {
  std::set<std::string> known;
  for (const Activity& one : activities) known.insert(one.id());
  std::map<std::string, std::vector<const Activity*>> parts;
  for (const Activity& one : activities)
    parts[one.parent() != one.id() && known.contains(one.parent()) ? one.parent() : ""].push_back(&one);
  for (auto& [parent, list] : parts) std::ranges::stable_sort(list, {}, start_of);
  std::vector<InLevels<Activity>> out;
  std::set<const Activity*> placed;
  std::vector<InLevels<Activity>> open;  // the next one last
  const auto open_parts = [&](const std::string& parent, std::size_t depth) {
    const auto found = parts.find(parent);
    if (found == parts.end() || depth > kDeepest) return;
    for (auto one = found->second.rbegin(); one != found->second.rend(); ++one) open.push_back({*one, depth});
  };
  open_parts("", 0);
  while (!open.empty()) {
    const InLevels<Activity> next = open.back();
    open.pop_back();
    if (!placed.insert(next.activity).second) continue;
    out.push_back(next);
    if (!next.activity->id().empty()) open_parts(next.activity->id(), next.depth + 1);
  }
  for (const Activity& one : activities)
    if (!placed.contains(&one)) out.push_back({&one, 0});
  return out;
}

}  // namespace roci::console::cli
