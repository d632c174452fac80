#include "exec_svc/standby/goals_apart.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "exec_svc/goals/goal_merge.hpp"
#include "exec_svc/journal/database_files.hpp"

namespace roci::exec::standby {

using goals::GoalKey;
using goals::GoalRecord;
using journal::Durability;
using journal::Journal;
using journal::JournalError;

namespace fs = std::filesystem;

namespace {

fs::path numbered(const fs::path& journal, int number) {
  return fs::path(journal).concat(".apart-" + std::to_string(number));
}

}  // namespace

std::vector<fs::path> GoalsApart::files() const {
  std::vector<fs::path> out;
  for (int number = 1; fs::exists(numbered(journal_, number)); ++number)
    out.push_back(numbered(journal_, number));
  return out;
}

void GoalsApart::keep(const Journal& replaced) const {
  const std::vector<GoalRecord> goals = replaced.goals();
  if (goals.empty()) return;
  const fs::path file = numbered(journal_, static_cast<int>(files().size()) + 1);
  const fs::path unfinished = fs::path(file).concat(".new");
  journal::remove_database(unfinished);
  {
    Journal apart(unfinished, Durability::process);
    for (const GoalRecord& goal : goals) apart.put_goal(goal);
    apart.commit();
  }
  journal::remove_database_logs(unfinished);
  if (durability_ == Durability::power) journal::sync_path(unfinished);
  journal::put_in_place(unfinished, file, durability_);
}

std::vector<GoalRecord> GoalsApart::goals() const {
  std::map<GoalKey, GoalRecord> kept;
  for (const fs::path& file : files()) {
    try {
      for (const GoalRecord& goal : Journal(file, Durability::process).goals()) {
        const auto [known, is_new] = kept.try_emplace(goal.request.key, goal);
        if (is_new) continue;
        if (const auto both = goals::merged(known->second, goal)) known->second = *both;
      }
    } catch (const JournalError&) {
      continue;  // the others count all the more
    }
  }
  std::vector<GoalRecord> out;
  for (auto& [key, goal] : kept) out.push_back(std::move(goal));
  std::ranges::stable_sort(out, {}, &GoalRecord::arrival);
  return out;
}

std::vector<GoalRecord> GoalsApart::missing(const std::vector<GoalRecord>& kept,
                                            const std::vector<GoalRecord>& in) {
  std::vector<GoalRecord> out;
  for (const GoalRecord& goal : kept) {
    if (goal.state == goals::GoalState::rejected) continue;
    const auto known = std::ranges::find_if(
        in, [&](const GoalRecord& other) { return other.request.key == goal.request.key; });
    if (known == in.end() || goals::merged(*known, goal)) out.push_back(goal);
  }
  return out;
}

void GoalsApart::remove() const {
  const std::vector<fs::path> all = files();
  for (auto file = all.rbegin(); file != all.rend(); ++file) journal::remove_database(*file);
}

}  // namespace roci::exec::standby
