// The records of a run say what really happened in the world, for whoever asks after the run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>

#include "sim_svc/world/world.hpp"

namespace roci::sim {

/// Writes effects.jsonl, products.jsonl and begun.json of the run folder. Each entry is written at once and each file
/// is whole after it, so that the death of the process loses none.
class RunRecords {
 public:
  /// Without a folder nothing is written. Effects are marked with the incarnation of the process.
  RunRecords(const std::filesystem::path& run_folder, std::uint32_t incarnation);

  void add(const world::Effect& effect);
  /// Adds what has become of a data product now.
  void add(const world::Product& product, temporal::Time now);
  void add(const world::Begun& begun);

 private:
  std::uint32_t incarnation_;
  std::ofstream effects_;
  std::ofstream products_;
  std::ofstream begun_;
  const char* begun_separator_ = "\n";
};

}  // namespace roci::sim
