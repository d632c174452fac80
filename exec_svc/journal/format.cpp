#include "exec_svc/journal/format.hpp"

#include <sqlite3.h>

#include <string>

#include "exec_svc/journal/journal.hpp"

namespace roci::exec::journal {
namespace {

int stated_version(sqlite3* database) {
  int version = 0;
  const auto take = [](void* out, int, char** values, char**) {
    *static_cast<int*>(out) = std::stoi(values[0]);
    return 0;
  };
  if (sqlite3_exec(database, "PRAGMA user_version", take, &version, nullptr) != SQLITE_OK)
    throw JournalError(sqlite3_errmsg(database));
  return version;
}

}  // namespace

void settle_format(sqlite3* database) {
  const int version = stated_version(database);
  if (version == kFormat) return;
  if (version > kFormat) {
    throw NewerJournal("it is of format " + std::to_string(version) + ", this version reads up to " +
                       std::to_string(kFormat) + "; go on with the version that wrote it");
  }
  const std::string stated = "PRAGMA user_version = " + std::to_string(kFormat);
  if (sqlite3_exec(database, stated.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
    throw JournalError(sqlite3_errmsg(database));
}

}  // namespace roci::exec::journal
