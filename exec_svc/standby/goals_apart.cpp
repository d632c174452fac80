#include "exec_svc/standby/goals_apart.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>

#include "exec_svc/goals/goal_merge.hpp"
#include "exec_svc/journal/database_files.hpp"
#include "exec_svc/journal/salvage.hpp"

namespace roci::exec::standby {

using goals::GoalKey;
using goals::GoalRecord;
using journal::DiskError;
using journal::Durability;
using journal::Journal;
using journal::JournalError;

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kApart = ".apart-";

fs::path numbered(const fs::path& journal, int number) {
  return fs::path(journal).concat(std::string(kApart) + std::to_string(number));
}

// Returns the number of a file of these goals; 0: it is another one, e.g. the log of one.
int number_of(const fs::path& file, const fs::path& journal) {
  const std::string name = file.filename().string(), start = journal.filename().string().append(kApart);
  if (!name.starts_with(start)) return 0;
  int number = 0;
  const char* const end = name.data() + name.size();
  const auto read = std::from_chars(name.data() + start.size(), end, number);
  return read.ec == std::errc{} && read.ptr == end && number > 0 ? number : 0;
}

// The file is whole without its log when this returns, and can be read.
void write_goals(const fs::path& file, const std::vector<GoalRecord>& goals) {
  {
    Journal apart(file, Durability::process);
    for (const GoalRecord& goal : goals) apart.put_goal(goal);
    apart.commit();
    apart.checkpoint();
  }
  journal::remove_database_logs(file);
  if (Journal(file, Durability::process).goals().size() != goals.size())
    throw DiskError(file.string() + " does not hold what was written into it");
}

}  // namespace

std::map<int, fs::path> GoalsApart::files() const {
  std::map<int, fs::path> out;
  std::error_code none;
  const fs::path folder = journal_.has_parent_path() ? journal_.parent_path() : fs::path(".");
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (const int number = number_of(entry.path(), journal_)) out[number] = numbered(journal_, number);
  return out;
}

void GoalsApart::keep(const Journal& replaced) const {
  const std::vector<GoalRecord> goals = replaced.goals();
  if (goals.empty()) return;
  const auto there = files();
  const fs::path file = numbered(journal_, there.empty() ? 1 : there.rbegin()->first + 1);
  const fs::path unfinished = fs::path(file).concat(".new");
  journal::remove_database(unfinished);
  try {
    write_goals(unfinished, goals);
    if (durability_ == Durability::power) journal::sync_path(unfinished);
    journal::put_in_place(unfinished, file, durability_);
  } catch (const std::exception& error) {
    journal::remove_database(unfinished);
    throw DiskError("the goals of a journal that is to be replaced cannot be kept: " +
                    std::string(error.what()));
  }
}

std::vector<GoalRecord> GoalsApart::goals() {
  std::map<GoalKey, GoalRecord> kept;
  waits_for_disk_ = false;
  for (const auto& [number, file] : files()) {
    try {
      journal::salvage_if_damaged(file);
      const Journal apart(file, Durability::process);
      const std::string damage = apart.text(journal::kDamage);
      for (const GoalRecord& goal : apart.goals()) {
        const auto [known, is_new] = kept.try_emplace(goal.request.key, goal);
        if (is_new) continue;
        if (const auto both = goals::merged(known->second, goal)) known->second = *both;
      }
      if (read_.insert(file).second && !damage.empty()) damage_.push_back(damage);
    } catch (const DiskError&) {
      waits_for_disk_ = true;
    } catch (const JournalError& error) {
      if (unreadable_.insert(file).second) damage_.emplace_back(error.what());
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

void GoalsApart::remove() {
  for (const fs::path& file : std::exchange(read_, {})) journal::remove_database(file);
}

}  // namespace roci::exec::standby
