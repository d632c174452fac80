// How a run was started stands in its folder, so that another launcher can go on with it (--resume).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "services/clock/host_anchor.hpp"

namespace roci::services::launch {

struct Options;

/// Numbers the version of the file's schema (docs/formats.md).
inline constexpr int kContinuationFormat = 1;

/// Names the file in the run folder.
inline constexpr char kContinuationFile[] = "launch.json";

/// Holds what a launcher takes over from the one before.
struct Continuation {
  std::int64_t epoch_unix_us = 0;             ///< mission time 0 of the run
  std::optional<clock::HostAnchor> anchor{};  ///< the host's, if it has not been started anew since
  int launchers = 0;                          ///< number of launchers that have flown the run so far
  /// Returns the incarnation before the first one of this launcher: each start of a service in a run has one of its
  /// own, and no launcher starts one so often.
  std::uint32_t incarnations() const { return static_cast<std::uint32_t>(launchers) * 10'000; }
};

/// Holds a command line, and what of it comes from an earlier launcher.
struct ContinuedCommandLine {
  /// Holds the arguments without the program, in the order that CLI11 takes: the last one first.
  std::vector<std::string> arguments;
  std::optional<Continuation> continued;
  /// Holds those of the launcher before, in the same order; none without --resume.
  std::vector<std::string> earlier{};
};

/// Returns the command line as it is, or, with --resume, with that of the first launcher before it. Throws
/// std::invalid_argument with the remedy when there is no run in the folder to go on with.
ContinuedCommandLine continued_command_line(int argc, const char* const* argv);

/// Writes down how the run was started. Throws std::system_error.
void keep_command_line(const Options&, const clock::HostAnchor&, std::int64_t epoch_unix_us);

/// Keeps a run folder for one launcher.
class FolderLock {
 public:
  /// Throws std::invalid_argument if another launcher flies the run, std::system_error if the lock cannot be made.
  explicit FolderLock(const std::filesystem::path& run_folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace roci::services::launch
