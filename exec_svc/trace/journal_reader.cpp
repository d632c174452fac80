#include "exec_svc/trace/journal_reader.hpp"

#include <sqlite3.h>

#include <charconv>
#include <memory>
#include <string>

#include "exec_svc/journal/format.hpp"

namespace roci::exec::trace {
namespace {

using Database = std::unique_ptr<sqlite3, decltype(&sqlite3_close)>;
using Rows = std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)>;

/// Reads one file; it names the file in its errors.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : file_(file), database_(nullptr, sqlite3_close) {
    sqlite3* opened = nullptr;
    const int status = sqlite3_open_v2(file.c_str(), &opened, SQLITE_OPEN_READONLY, nullptr);
    database_.reset(opened);
    if (status != SQLITE_OK) fail(sqlite3_errmsg(opened));
    check_format();
  }

  std::vector<Line> lines(bool decisions) {
    const Rows rows = select(
        "SELECT seq, time_us, kind, text FROM record "
        "WHERE kind = 'trace' OR (? AND kind IN ('goal', 'event', 'step', 'call')) ORDER BY seq");
    sqlite3_bind_int(rows.get(), 1, decisions ? 1 : 0);
    std::vector<Line> out;
    while (next(rows)) {
      Line line = text(rows, 2) == "trace" ? trace_line(rows) : decision(rows);
      line.number = out.size() + 1;
      out.push_back(std::move(line));
    }
    return out;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw TraceError(file_.string() + " cannot be read as a journal: " + what +
                     "; give a run folder, its journal.sqlite or a text of roci-trace print");
  }

  void check_format() {
    const Rows rows = select("PRAGMA user_version");
    const std::int64_t version = next(rows) ? sqlite3_column_int64(rows.get(), 0) : 0;
    if (version > journal::kFormat) {
      throw TraceError(file_.string() + ": a journal of format " + std::to_string(version) +
                       ", this roci-trace reads up to " + std::to_string(journal::kFormat) +
                       "; read it with the version that wrote it");
    }
  }

  Rows select(const char* sql) const {
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(database_.get(), sql, -1, &statement, nullptr) != SQLITE_OK)
      fail(sqlite3_errmsg(database_.get()));
    return {statement, sqlite3_finalize};
  }

  bool next(const Rows& rows) const {
    const int status = sqlite3_step(rows.get());
    if (status != SQLITE_ROW && status != SQLITE_DONE) fail(sqlite3_errmsg(database_.get()));
    return status == SQLITE_ROW;
  }

  static std::string text(const Rows& rows, int column) {
    const auto* data = static_cast<const char*>(sqlite3_column_blob(rows.get(), column));
    if (data == nullptr) return "";
    return {data, static_cast<std::size_t>(sqlite3_column_bytes(rows.get(), column))};
  }

  /// The journal keeps such a line with its mission time in front, as the hash goes over it.
  Line trace_line(const Rows& rows) const {
    const std::string whole = text(rows, 3);
    std::int64_t microseconds = 0;
    const auto [end, error] = std::from_chars(whole.data(), whole.data() + whole.size(), microseconds);
    if (error != std::errc{} || *end != ' ')
      fail("record " + text(rows, 0) + " is a line of the trace without its mission time");
    const auto stamp = static_cast<std::size_t>(end - whole.data());
    return {temporal::Time(microseconds), whole.substr(stamp + 1), 0};
  }

  static Line decision(const Rows& rows) {
    return {temporal::Time(sqlite3_column_int64(rows.get(), 1)), text(rows, 2) + " " + text(rows, 3), 0};
  }

  const std::filesystem::path& file_;
  Database database_;
};

}  // namespace

std::vector<Line> read_journal(const std::filesystem::path& file, bool decisions) {
  return Reader(file).lines(decisions);
}

}  // namespace roci::exec::trace
