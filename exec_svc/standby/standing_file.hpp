// A member's standing on its disk.
#pragma once

#include <filesystem>

#include "exec_svc/journal/journal.hpp"
#include "exec_svc/standby/lease.hpp"

namespace roci::exec {

class StandingFile {
 public:
  StandingFile(std::filesystem::path file, Durability durability)
      : file_(std::move(file)), durability_(durability) {}

  // As new if there is no file. Throws JournalError for one that cannot be read.
  Standing read() const;
  // Either all of it stands in the file or nothing. Throws JournalError.
  void write(const Standing& standing) const;

 private:
  std::filesystem::path file_;
  Durability durability_;
};

}  // namespace roci::exec
