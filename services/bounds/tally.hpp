// A tally counts what is refused without a line or an event for each: a sender of a million bad samples causes seven
// lines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace roci::services::bounds {

/// Reports a count the first time, and then each time that it has grown tenfold. Names beyond kNames share one count.
class Tally {
 public:
  /// Counts one more of `what`, and returns the count if it is to be reported, else 0.
  std::uint64_t note(std::string_view what);
  std::uint64_t count(std::string_view what) const;

  static constexpr std::size_t kNames = 256;  ///< some eight for each topic

 private:
  std::map<std::string, std::uint64_t, std::less<>> counts_;
};

}  // namespace roci::services::bounds
