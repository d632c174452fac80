// This file keeps a member's persisted term on its disk.
#pragma once

#include <filesystem>
#include <optional>

#include "exec_svc/journal/journal.hpp"
#include "exec_svc/standby/lease.hpp"

namespace roci::exec::standby {

/// Reads and writes the term of one member.
class PersistedTermFile {
 public:
  PersistedTermFile(std::filesystem::path file, journal::Durability durability)
      : file_(std::move(file)), durability_(durability) {}

  /// Reads the term; it is as new if there is no file. Throws JournalError for one that cannot be read.
  PersistedTerm read() const;
  /// Writes what is new: either all of it stands in the file or nothing. Throws JournalError.
  void keep(const PersistedTerm& persisted_term);

 private:
  void write(const PersistedTerm& persisted_term) const;

  std::filesystem::path file_;
  journal::Durability durability_;
  std::optional<PersistedTerm> kept_;  ///< is as read or written by keep()
};

}  // namespace roci::exec::standby
