// A worse network for tests: a Transport around another one that loses and delays best-effort samples at its
// readers. Reliable topics pass untouched. No writer's samples change their order; the fate of a writer's
// n-th sample on a topic depends on seed, topic and n alone, so runs repeat.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string_view>

#include "services/transport/transport.hpp"

namespace roci::services::transport {

struct Loss {
  double fraction = 0;  ///< Share of the best-effort samples that are lost, 0 to 1.
  std::uint64_t seed = 1;
  std::chrono::milliseconds delay{0};  ///< Delay of the samples that arrive.
};

/// Reads "fraction:seed:delay_ms", e.g. "0.2:7:30" (environment variable ROCI_LOSS). Throws TransportError.
Loss parse_loss(std::string_view text);

std::unique_ptr<Transport> make_lossy(std::unique_ptr<Transport>, const Loss&);

}  // namespace roci::services::transport
