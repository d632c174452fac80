// The failure back-off is for commands that fail again and again: it says how long to wait before the next
// plan, and when to stop trying.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "core/temporal/duration.hpp"

namespace roci::exec::reactor {

/// Counts failures in a row for each component, and lets the pause before the next plan grow with them.
class FailureBackoff {
 public:
  /// Takes the `limit` of failures of one component in a row, at least 1, and the `first_pause`, which
  /// follows the second failure and doubles with each further one up to `longest_pause`. All tries together
  /// thus wait for less than limit × longest_pause.
  FailureBackoff(std::uint32_t limit, temporal::Duration first_pause, temporal::Duration longest_pause)
      : limit_(limit), first_pause_(first_pause), longest_pause_(longest_pause) {}

  struct Count {
    std::uint32_t in_a_row = 0;
    bool used_up = false;         ///< the limit is reached; the next failure counts as the first
    temporal::Duration pause{0};  ///< pause before the next plan; none after the first failure and the last
  };
  Count failed(const std::string& component);
  void succeeded(const std::string& component) { in_a_row_.erase(component); }

  template <class Archive, class Self>
  static void fields(Archive& archive, Self& self) {
    archive(self.in_a_row_);
  }

 private:
  std::uint32_t limit_;
  temporal::Duration first_pause_;
  temporal::Duration longest_pause_;
  std::map<std::string, std::uint32_t> in_a_row_;
};

}  // namespace roci::exec::reactor
