// A journal that is replaced by another one's may hold goals that only it knows. They are kept in a file of their own
// before it goes, until the executive that leads has them.
#pragma once

#include <filesystem>
#include <vector>

#include "exec_svc/journal/journal.hpp"

namespace roci::exec::standby {

/// Keeps goals of replaced journals beside the journal, as JOURNAL.apart-1, -2 and so on; each is a journal itself,
/// so that it can be read with the same tools.
class GoalsApart {
 public:
  GoalsApart(std::filesystem::path journal, journal::Durability durability)
      : journal_(std::move(journal)), durability_(durability) {}

  /// Keeps the goals of this journal: they are durable before this returns. Throws JournalError.
  void keep(const journal::Journal& replaced) const;
  /// Returns what is kept, oldest first. A file that cannot be read is passed over.
  std::vector<goals::GoalRecord> goals() const;
  /// Returns those of `kept` that these goals do not contain (goals/goal_merge.hpp).
  static std::vector<goals::GoalRecord> missing(const std::vector<goals::GoalRecord>& kept,
                                                const std::vector<goals::GoalRecord>& in);
  /// Removes what is kept: somebody has it.
  void remove() const;

 private:
  std::vector<std::filesystem::path> files() const;

  std::filesystem::path journal_;
  journal::Durability durability_;
};

}  // namespace roci::exec::standby
