// What of its own commands a dedicated executive must know after its death: in which epoch it commanded, and which
// command was under way.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "services/commander/command_client.hpp"

namespace roci::dedicated {

/// Is kept in a small file, whole or not at all, before a command goes out.
class CallRecord {
 public:
  /// Reads the file, if there is one. An empty path keeps nothing.
  explicit CallRecord(std::filesystem::path file);

  /// The file is there and cannot be read: nothing is known of the process before this one, and owners tell the epoch.
  bool damaged() const { return damaged_; }
  /// The newest epoch of the processes before this one; 0: there was none.
  std::uint64_t epoch() const { return epoch_; }
  /// The command that was under way when the process before this one died.
  const std::optional<services::commander::Issued>& open() const { return open_; }

  /// Both throw std::system_error if the disk does not take it.
  void begin(const services::commander::Issued& issued);
  void end();

 private:
  void write() const;

  std::filesystem::path file_;
  bool damaged_ = false;
  std::uint64_t epoch_ = 0;
  std::optional<services::commander::Issued> open_;
};

}  // namespace roci::dedicated
