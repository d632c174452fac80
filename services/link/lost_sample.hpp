// What a link did not carry, by name.
#pragma once

#include <cstdint>
#include <string>

#include "core/temporal/duration.hpp"

namespace roci::services::link {

/// What becomes of a sample that did not arrive at an attempt.
enum class Fate {
  repeated,    ///< The link sends it again.
  superseded,  ///< A newer one of its instance is sent instead.
  lost,        ///< The link does no more about it; docs/links.md says who does.
};

/// Is a sample that did not arrive at an attempt to send it, as its receiver's side of the link knows it.
struct LostSample {
  temporal::Time at{};
  std::string link;  ///< by name
  std::string topic;
  std::string key;  ///< in words; empty for topics without a key
  std::string sender;
  std::uint32_t incarnation = 0;
  std::uint64_t number = 0;  ///< of the sender's samples on the topic, from 1
  std::uint32_t attempt = 1;
  Fate fate = Fate::lost;
  bool operator==(const LostSample&) const = default;
};

}  // namespace roci::services::link
