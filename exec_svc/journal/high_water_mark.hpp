// The high-water mark says how far a journal was written, outside of the database: SQLite silently drops the tail of a
// write-ahead log that is cut short or damaged ("WAL-mode File Format", section 4), and the journal still looks whole.
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <optional>

namespace roci::exec::journal {

/// Says how far a journal goes. Neither number ever falls while it is the same journal.
struct Extent {
  std::int64_t epoch = 0;
  std::int64_t record = 0;  ///< the number of the newest record; 0: there is none
  bool operator==(const Extent&) const = default;
};

/// Keeps the file JOURNAL-mark. It is written after each commit and never waits for the disk: it may be behind the
/// journal, and is ahead of it only when the journal has lost something.
class HighWaterMark {
 public:
  /// Opens nothing yet.
  explicit HighWaterMark(const std::filesystem::path& journal);
  ~HighWaterMark();
  HighWaterMark(HighWaterMark&& other) noexcept;
  HighWaterMark& operator=(HighWaterMark&&) = delete;

  const std::filesystem::path& file() const { return file_; }
  /// Returns the mark, or nothing if there is none or its checksum is wrong.
  std::optional<Extent> read() const;
  /// Writes the mark. Failures are ignored: an older mark says less, but nothing untrue.
  void write(const Extent& extent) noexcept;
  void remove() noexcept;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace roci::exec::journal
