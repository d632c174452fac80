// How far the detector's memory may grow by what comes from the wire (docs/resilience.md, "What is bounded").
#pragma once

#include <cstddef>

namespace roci::science {

/// Images that are looked at in one run: one every five minutes for a month. Those beyond show nothing (event
/// science.no_room).
inline constexpr std::size_t kPhotos = 10'000;
/// Bytes of an image's id.
inline constexpr std::size_t kNameBytes = 1'024;

}  // namespace roci::science
