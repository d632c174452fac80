// The file in which an owner keeps what must outlive its process: one JSON object a line, appended.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "services/owner/command_ledger.hpp"

namespace roci::services::owner {

/// Holds the file open. An entry survives the death of the process once append() has returned, though not the
/// loss of power.
class LedgerFile {
 public:
  /// Opens or makes the file. Throws std::system_error if that is impossible.
  explicit LedgerFile(std::filesystem::path file);
  ~LedgerFile();
  LedgerFile(const LedgerFile&) = delete;
  LedgerFile& operator=(const LedgerFile&) = delete;

  /// Returns all entries in order. A last line that is cut short, as its writer died, is none; another line that
  /// cannot be read is left out with a warning in the log.
  std::vector<LedgerEntry> read() const;
  /// Throws std::system_error if the entry cannot be written whole.
  void append(const LedgerEntry&);
  /// Begins the file anew with these entries, in one step: whoever reads it finds the old ones or the new ones, after a
  /// loss of power, too. Throws std::system_error if that is impossible; the entries of before are lost in no case.
  void replace(const std::vector<LedgerEntry>&);
  /// Returns how many entries were appended since the file was opened or replaced.
  std::size_t appended() const { return appended_; }

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
  bool torn_ = false;  // the file ends within a line
  std::size_t appended_ = 0;
};

}  // namespace roci::services::owner
