#include "services/transport/announcement.hpp"

#include <algorithm>
#include <cstddef>

#include "roci_idl/contract.h"

namespace roci::services::transport {

std::string Announcement::hash_of(std::string_view type) const {
  const auto module_end = type.rfind("::");
  const auto found = hashes.find(module_end == type.npos ? type : type.substr(module_end + 2));
  return found == hashes.end() ? std::string() : found->second;
}

std::string own_announcement() { return ROCI_ANNOUNCEMENT; }

std::optional<Announcement> parse_announcement(std::string_view text) {
  Announcement announcement;
  for (std::size_t begin = 0, part = 0; begin <= text.size(); ++part) {
    const std::size_t end = std::min(text.find(';', begin), text.size());
    const std::string_view field = text.substr(begin, end - begin);
    begin = end + 1;
    if (part == 0) {
      if (field != "roci") return std::nullopt;
      continue;
    }
    const auto equals = field.find('=');
    if (equals == field.npos) return std::nullopt;
    const std::string name(field.substr(0, equals)), value(field.substr(equals + 1));
    if (name == "build") {
      announcement.build = value;
    } else {
      announcement.hashes[name] = value;
    }
  }
  return announcement;
}

}  // namespace roci::services::transport
