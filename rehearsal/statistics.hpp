// Statistics say what several flights of a mission have in common: how often each effect came about and each kind of
// data came home (R119: predict by flying many).
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace roci::rehearsal {

/// Counts flights by what the world wrote of them. A flight counts once for each effect, however often it came about.
class Statistics {
 public:
  /// Reads the run folder of a flight that has ended; a file that the world did not write counts as empty, and a line
  /// that is none is left out.
  void add(const std::filesystem::path& run_folder, const std::string& result);

  /// Returns sentences, a line each: results, effects, data; the most frequent first.
  std::string text() const;
  /// Holds `results`, `done` and `received`: the number of flights by result, by "kind object" and by kind of data.
  nlohmann::json json() const;

 private:
  using Counts = std::map<std::string, std::size_t>;

  std::size_t flights_ = 0;
  Counts results_;
  Counts done_;
  Counts received_;
};

}  // namespace roci::rehearsal
