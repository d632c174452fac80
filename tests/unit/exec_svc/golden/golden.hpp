// Journals of earlier versions, from their dumps in this folder.
#pragma once

#include <sqlite3.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace roci::exec::testing {

// Changes a journal, or makes one, by SQL.
inline void execute(const std::filesystem::path& journal, const std::string& sql) {
  sqlite3* database = nullptr;
  char* error = nullptr;
  sqlite3_open(journal.c_str(), &database);
  const int status = sqlite3_exec(database, sql.c_str(), nullptr, nullptr, &error);
  const std::string reason = error == nullptr ? "" : error;
  sqlite3_free(error);
  sqlite3_close(database);
  if (status != SQLITE_OK) throw std::runtime_error(journal.string() + ": " + reason);
}

// Makes the journal that `journal-VERSION.sql` holds; `file` must not exist.
inline void make_golden_journal(int version, const std::filesystem::path& file) {
  std::ifstream in(std::string(ROCI_SOURCE_DIR "/tests/unit/exec_svc/golden/journal-") +
                   std::to_string(version) + ".sql");
  execute(file, {std::istreambuf_iterator<char>(in), {}});
}

}  // namespace roci::exec::testing
