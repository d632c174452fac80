// Counts what is refused without a line or an event for each: whoever sends a million bad samples writes seven lines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace roci::services::bounds {

/// Tells a count the first time, and then each time that it has grown tenfold. Beyond kNames names the rest share one.
class Tally {
 public:
  /// Counts one more of `what`, and returns the count if it is worth telling, else 0.
  std::uint64_t note(std::string_view what);
  std::uint64_t count(std::string_view what) const;

  static constexpr std::size_t kNames = 256;  ///< Some eight for each topic that there is.

 private:
  std::map<std::string, std::uint64_t, std::less<>> counts_;
};

}  // namespace roci::services::bounds
