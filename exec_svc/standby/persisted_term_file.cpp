#include "exec_svc/standby/persisted_term_file.hpp"

#include <fstream>
#include <string>
#include <system_error>

#include "core/bytes/crc_32.hpp"
#include "core/durable/durable_file.hpp"
#include "exec_svc/journal/database_files.hpp"

namespace roci::exec::standby {

using journal::DiskError;
using journal::Durability;
using journal::JournalError;

namespace fs = std::filesystem;

namespace {

// Exceeds the epochs in which a member may have led since its journal was last written.
constexpr std::uint64_t kEpochsBeyondJournal = 100;

// Returns the term as the file has it; a checksum of this text stands behind it.
std::string term_text(const PersistedTerm& term) {
  return std::to_string(term.epoch) + ' ' + std::to_string(term.alone) + ' ' + std::to_string(term.holds);
}

}  // namespace

PersistedTerm PersistedTermFile::read() const {
  if (!fs::exists(file_)) return {};
  PersistedTerm out;
  std::ifstream in(file_);
  std::uint32_t stated = 0;
  if (!(in >> out.epoch >> out.alone >> out.holds >> stated) || stated != bytes::crc_32(term_text(out)))
    throw JournalError(file_.string() + " is damaged");
  return out;
}

fs::path PersistedTermFile::begin_anew(const journal::Position& newest) {
  const fs::path kept = journal::free_damaged_name(file_);
  insist([&] { fs::copy_file(file_, kept, fs::copy_options::overwrite_existing); });
  const PersistedTerm in_doubt{newest.epoch + kEpochsBeyondJournal, false, 0};
  insist([&] { write(in_doubt); });
  kept_ = in_doubt;
  return kept;
}

void PersistedTermFile::keep(const PersistedTerm& persisted_term) {
  if (!kept_) kept_ = read();
  if (*kept_ == persisted_term) return;
  insist([&] { write(persisted_term); });
  kept_ = persisted_term;
}

void PersistedTermFile::write(const PersistedTerm& persisted_term) const {
  const std::string term = term_text(persisted_term);
  const std::string text = term + ' ' + std::to_string(bytes::crc_32(term)) + '\n';
  durable::replace_file(
      file_, text,
      durability_ == Durability::power ? durable::Durability::power : durable::Durability::process);
}

void PersistedTermFile::insist(const std::function<void()>& write) const {
  for (bool waited = false;; waited = true) {
    try {
      write();
      if (waited && disk_wait_.over) disk_wait_.over();
      return;
    } catch (const std::system_error& error) {
      if (!disk_wait_.wait) throw DiskError(error.what());
      disk_wait_.wait(error.what());
    }
  }
}

}  // namespace roci::exec::standby
