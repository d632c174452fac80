// The kinds of submessages, one by one.
#pragma once

#include "services/vendors/guard/byte_view.hpp"
#include "services/vendors/guard/parameters.hpp"
#include "services/vendors/guard/verdict.hpp"

namespace roci::services::vendors::guard {

struct Submessage {
  std::uint8_t id = 0;
  std::uint8_t flags = 0;
  ByteView body;  ///< What follows the four bytes of its header.
};

/// `id` is below 0x80; `sender` is the participant of the message's header.
Verdict examine_submessage(const Submessage&, const GuidPrefix& sender);

}  // namespace roci::services::vendors::guard
