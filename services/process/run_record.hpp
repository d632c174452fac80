// A running mission leaves this record, by which tools on the same machine find it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace roci::services::process {

/// Numbers the newest version of the record's schema (docs/formats.md) that this code reads, and the one that
/// it writes. It rises when a key changes its meaning or goes; a record that names no version is of version
/// 1.
inline constexpr int kRunRecordFormat = 1;

/// Holds what a tool needs to join a run.
struct RunRecord {
  std::int64_t pid = 0;  ///< the launcher's
  int domain = 0;
  std::filesystem::path mission;
  std::string scenario;
  std::string dds;  ///< as given to --dds
  std::string address;
  std::vector<std::string> peers;
  std::filesystem::path run_folder;
  std::string clock;  ///< "live" or "simulated"
  std::int64_t started_unix_us = 0;
  std::uint64_t pid_started = 0;    ///< start_of_process(pid); 0: not known
  std::string run{};                // identity; empty in records of before there were any
  std::filesystem::path keys{};     ///< key folder of a secure run; empty: the run is plain
  std::filesystem::path network{};  ///< network file that it was given; empty: none

  bool operator==(const RunRecord&) const = default;
};

/// Returns $XDG_RUNTIME_DIR/rocinante, else /tmp/rocinante-<uid>; it is this user's alone (private_folder.hpp). Throws
/// std::runtime_error where somebody else has made it.
std::filesystem::path runtime_folder();

/// Returns a field of /proc/PID/stat from the third on, by its number in proc(5); empty if there is no such process.
std::string stat_field(std::int64_t pid, int field);

/// Returns when a process began, in the kernel's ticks since the host's start (proc(5), starttime); 0 if it is not
/// known. No two processes of a host have number and beginning in common.
std::uint64_t start_of_process(std::int64_t pid);

/// Publishes the record of a run for as long as this object lives. Records of launchers that have ended without
/// removing theirs are removed.
class PublishedRun {
 public:
  PublishedRun(const std::filesystem::path& folder, const RunRecord&);
  ~PublishedRun();
  PublishedRun(const PublishedRun&) = delete;
  PublishedRun& operator=(const PublishedRun&) = delete;

 private:
  std::filesystem::path file_;
};

/// Returns the runs whose launcher lives, newest first. Records of dead ones are passed over.
std::vector<RunRecord> find_runs(const std::filesystem::path& folder);

/// Describes, with a remedy, the records of a newer format whose launcher may live; find_runs() does not read
/// them.
std::vector<std::string> refused_runs(const std::filesystem::path& folder);

}  // namespace roci::services::process
