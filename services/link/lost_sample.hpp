// A lost sample is one that a link did not carry.
#pragma once

#include <cstdint>
#include <string>

#include "core/temporal/duration.hpp"

namespace roci::services::link {

/// Says what becomes of a sample that did not arrive at an attempt.
enum class Fate {
  repeated,    ///< the link sends it again
  superseded,  ///< a newer one of its instance is sent instead
  lost,        ///< the link does no more about it; docs/links.md says who does
};

/// Names a sample that did not arrive at an attempt to send it, as the receiver's side of the link knows it.
struct LostSample {
  temporal::Time at{};
  std::string link;  ///< by name
  std::string topic;
  std::string key;  ///< in words; empty for topics without a key
  std::string sender;
  std::uint32_t incarnation = 0;
  std::uint64_t number = 0;  ///< place among the sender's samples on the topic, from 1
  std::uint32_t attempt = 1;
  Fate fate = Fate::lost;
  bool operator==(const LostSample&) const = default;
};

}  // namespace roci::services::link
