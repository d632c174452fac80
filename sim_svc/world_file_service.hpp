// The file in which a live robot's world outlives the process that simulates it, as its ledger of commands does: where
// it stands, its energy, the images on board, what it holds.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "services/clock/wall.hpp"
#include "sim_svc/world/world.hpp"

namespace roci::sim {

/// As JSON; world_memory_from() returns nothing if `text` is not such a text.
std::string to_text(const world::WorldMemory&);
std::optional<world::WorldMemory> world_memory_from(const std::string& text);

/// Is always whole: it is written beside and renamed. The death of the process loses nothing of it. The disk is waited
/// for once in kSyncEvery, as the world changes many times a second at high speeds; a loss of power may lose so much.
class WorldFile {
 public:
  static constexpr services::clock::WallDuration kSyncEvery = std::chrono::seconds(1);

  explicit WorldFile(std::filesystem::path file) : file_(std::move(file)) {}

  /// Reads the file. Returns nothing if there is none; one that cannot be read is reported in the log and
  /// left out.
  std::optional<world::WorldMemory> read() const;
  /// Writes it if it is another one than the last. What the disk does not take is told once, and written later.
  void keep(const world::WorldMemory&, services::clock::WallTime now);

 private:
  std::filesystem::path file_;
  std::string written_;
  std::optional<services::clock::WallTime> synced_;
  bool told_ = false;
};

}  // namespace roci::sim
