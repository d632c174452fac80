// A journal that is replaced by another one's may hold goals that only it knows. They are kept in a file of their own
// before it goes, until the executive that leads has them.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "exec_svc/journal/journal.hpp"

namespace roci::exec::standby {

/// Keeps goals of replaced journals beside the journal, as JOURNAL.apart-1, -2 and so on; each is a journal itself,
/// so that it can be read with the same tools.
class GoalsApart {
 public:
  GoalsApart(std::filesystem::path journal, journal::Durability durability)
      : journal_(std::move(journal)), durability_(durability) {}

  /// Keeps the goals of this journal: they are durable before this returns. Throws DiskError, with nothing changed, if
  /// the disk does not take them.
  void keep(const journal::Journal& replaced) const;
  /// Returns what is kept, oldest first. Of a file that is damaged it returns what can be read; the damaged file is
  /// kept (journal/salvage.hpp), and take_damage() tells of it.
  std::vector<goals::GoalRecord> goals();
  /// Returns whether there are files that the disk did not let goals() read; a later call may.
  bool waits_for_disk() const { return waits_for_disk_; }
  /// Returns in plain words what goals() found damaged since the last call.
  std::vector<std::string> take_damage() { return std::exchange(damage_, {}); }
  /// Returns those of `kept` that these goals do not contain (goals/goal_merge.hpp).
  static std::vector<goals::GoalRecord> missing(const std::vector<goals::GoalRecord>& kept,
                                                const std::vector<goals::GoalRecord>& in);
  /// Removes the files that goals() has read: somebody has what stood in them.
  void remove();

 private:
  std::map<int, std::filesystem::path> files() const;

  std::filesystem::path journal_;
  journal::Durability durability_;
  std::set<std::filesystem::path> read_;
  std::set<std::filesystem::path> unreadable_;  // which stay where they are, and are told of once
  std::vector<std::string> damage_;
  bool waits_for_disk_ = false;
};

}  // namespace roci::exec::standby
