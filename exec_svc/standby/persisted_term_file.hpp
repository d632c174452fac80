// This file keeps a member's persisted term on its disk.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <utility>

#include "exec_svc/journal/journal.hpp"
#include "exec_svc/standby/lease.hpp"

namespace roci::exec::standby {

/// Reads and writes the term of one member.
class PersistedTermFile {
 public:
  PersistedTermFile(std::filesystem::path file, journal::Durability durability)
      : file_(std::move(file)), durability_(durability) {}

  /// Reads the term; it is as new if there is no file. Throws JournalError for one that cannot be read, or
  /// whose checksum is that of another term.
  PersistedTerm read() const;
  /// Keeps a file that cannot be read as FILE.damaged-1 (2, …), whose name it returns, and begins a new one with the
  /// term of a member whose journal ends here. That member is in doubt: it has led, if at all, in epochs that nobody
  /// tells it, and goes beyond them. Throws and waits as keep() does.
  std::filesystem::path begin_anew(const journal::Position& newest);
  /// Writes what is new: either all of it stands in the file or nothing. While the disk takes nothing it waits as
  /// wait_for_disk() says, or throws DiskError.
  void keep(const PersistedTerm& persisted_term);
  void wait_for_disk(journal::DiskWait wait) { disk_wait_ = std::move(wait); }

 private:
  void write(const PersistedTerm& persisted_term) const;
  void insist(const std::function<void()>& write) const;

  std::filesystem::path file_;
  journal::Durability durability_;
  journal::DiskWait disk_wait_;
  std::optional<PersistedTerm> kept_;  ///< is as read or written by keep()
};

}  // namespace roci::exec::standby
