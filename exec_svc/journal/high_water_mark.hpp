/// How far a journal was written, kept outside of the database: SQLite drops the tail of a write-ahead log that is cut
/// short or damaged without a word ("WAL-mode File Format", section 4), and the journal looks whole all the same.
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <optional>

namespace roci::exec::journal {

/// How far a journal goes. Neither number ever falls while it is the same journal.
struct Extent {
  std::int64_t epoch = 0;
  std::int64_t record = 0;  ///< the number of the newest record; 0: there is none
  bool operator==(const Extent&) const = default;
};

/// The file JOURNAL-mark. It is written after each commit and never waits for the disk, so that it may be behind the
/// journal, and is before it only when the journal has lost something.
class HighWaterMark {
 public:
  /// Opens nothing yet.
  explicit HighWaterMark(const std::filesystem::path& journal);
  ~HighWaterMark();
  HighWaterMark(HighWaterMark&& other) noexcept;
  HighWaterMark& operator=(HighWaterMark&&) = delete;

  const std::filesystem::path& file() const { return file_; }
  /// Nothing: there is no mark, or one whose checksum is wrong.
  std::optional<Extent> read() const;
  /// Puts the mark there. What goes wrong is left out: an older mark says less, and nothing that is not true.
  void write(const Extent& extent) noexcept;
  void remove() noexcept;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace roci::exec::journal
