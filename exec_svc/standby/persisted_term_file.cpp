#include "exec_svc/standby/persisted_term_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <fstream>

#include "exec_svc/journal/database_files.hpp"

namespace roci::exec::standby {

using journal::Durability;
using journal::JournalError;

namespace fs = std::filesystem;

PersistedTerm PersistedTermFile::read() const {
  if (!fs::exists(file_)) return {};
  PersistedTerm out;
  std::ifstream in(file_);
  if (!(in >> out.epoch >> out.alone))
    throw JournalError(file_.string() + " is damaged; remove it if the other member's journal is whole");
  if (!(in >> out.holds)) out.holds = out.epoch;  // written by a member that did not keep it
  return out;
}

void PersistedTermFile::keep(const PersistedTerm& persisted_term) {
  if (!kept_) kept_ = read();
  if (*kept_ == persisted_term) return;
  write(persisted_term);
  kept_ = persisted_term;
}

void PersistedTermFile::write(const PersistedTerm& persisted_term) const {
  const fs::path unfinished = fs::path(file_).concat(".new");
  std::ofstream out(unfinished);
  out << persisted_term.epoch << ' ' << persisted_term.alone << ' ' << persisted_term.holds << '\n'
      << std::flush;
  out.close();
  const int written = open(unfinished.c_str(), O_RDONLY | O_CLOEXEC);
  const bool good = out && written >= 0 && (durability_ == Durability::process || fsync(written) == 0);
  if (written >= 0) close(written);
  if (!good) throw JournalError("cannot write " + unfinished.string());
  journal::put_in_place(unfinished, file_, durability_);
}

}  // namespace roci::exec::standby
