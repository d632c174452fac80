#include "exec_svc/journal/format.hpp"

#include <sqlite3.h>

#include <string>

#include "exec_svc/journal/journal.hpp"

namespace roci::exec::journal {
namespace {

std::int32_t stated_number(sqlite3* database, const char* pragma) {
  std::int32_t number = 0;
  const auto take = [](void* out, int, char** values, char**) {
    *static_cast<std::int32_t*>(out) = std::stoi(values[0]);
    return 0;
  };
  if (sqlite3_exec(database, pragma, take, &number, nullptr) != SQLITE_OK)
    throw JournalError(sqlite3_errmsg(database));
  return number;
}

}  // namespace

StatedFormat stated_format(sqlite3* database) {
  return {stated_number(database, "PRAGMA user_version"), stated_number(database, "PRAGMA application_id")};
}

std::string to_text(const StatedFormat& stated) {
  const std::int32_t other = stated.stamp - stamp_of(0);
  return "it states format " + std::to_string(stated.version) + " in one place and " +
         (other > 0 && other < 1000 ? "format " + std::to_string(other) : "none") + " in the other";
}

void require_known_format(const StatedFormat& stated) {
  if (stated.newer()) {
    throw NewerJournal("it is of format " + std::to_string(stated.version) + ", this version reads up to " +
                       std::to_string(kFormat) + "; go on with the version that wrote it");
  }
  if (stated.contradicts_itself()) throw JournalError(to_text(stated));
}

void settle_format(sqlite3* database) {
  const StatedFormat stated = stated_format(database);
  require_known_format(stated);
  if (stated.version == kFormat && stated.stamp == stamp_of(kFormat)) return;
  const std::string statement = "BEGIN; PRAGMA user_version = " + std::to_string(kFormat) +
                                "; PRAGMA application_id = " + std::to_string(stamp_of(kFormat)) + "; COMMIT";
  if (sqlite3_exec(database, statement.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
    throw JournalError(sqlite3_errmsg(database));
}

}  // namespace roci::exec::journal
