// What must survive a crash of exec_svc, in one SQLite file (write-ahead log): the goals, the epoch, and a
// record of all that was planned, commanded, answered and observed. A goal is acknowledged only after
// commit().
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/temporal/duration.hpp"
#include "exec_svc/goals/goal_set.hpp"

namespace roci::exec {

class JournalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class Durability {
  process,  // survives the death of the process; commits do not wait for the disk
  power,    // survives the loss of power
};

class Journal {
 public:
  // Opens or creates the file. Throws JournalError naming the file when it is not a journal or cannot be
  // written.
  Journal(const std::filesystem::path& file, Durability durability);
  ~Journal();

  // Entries since the last commit become durable together.
  void commit();

  // Rises by one with each call: the epoch of this start of the executive.
  std::uint64_t next_epoch();

  void put_goal(const GoalRecord& record);
  std::vector<GoalRecord> goals() const;

  // kind: "plan", "command", "ack", "observation" (these four make the trace), "event", "product", "step",
  // "call".
  void append(temporal::Time time, std::string_view kind, std::string_view text);
  // In order of writing.
  void for_each(
      const std::function<void(temporal::Time, std::string_view kind, std::string_view text)>& visit) const;

  void set_number(std::string_view name, std::int64_t value);
  std::int64_t number(std::string_view name, std::int64_t fallback) const;

 private:
  struct Database;
  std::unique_ptr<Database> database_;
};

}  // namespace roci::exec
