// An announcement is what a participant says of itself in its USER_DATA: the build that it runs and a hash of each type
// that it knows (idl/contract.py), so that nobody decodes samples of a type that means something else elsewhere. DDS
// matches types by name alone.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace roci::services::transport {

/// Holds an announcement, taken apart.
struct Announcement {
  std::string build;
  /// Maps type names without module, e.g. "Goal", to hashes of eight hexadecimal digits.
  std::map<std::string, std::string, std::less<>> hashes;

  /// Returns the hash of a type such as "roci::v1::Goal", empty if it is not announced.
  std::string hash_of(std::string_view type) const;
};

/// Returns the announcement of this build: "roci;build=0.1.0;Goal=1a2b3c4d;…".
std::string own_announcement();

/// Parses an announcement. Returns nothing if the text is not of that form, e.g. empty or the USER_DATA of a
/// foreign tool.
std::optional<Announcement> parse_announcement(std::string_view);

}  // namespace roci::services::transport
