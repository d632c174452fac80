// These limits bound how far the detector's memory may grow by what comes from the wire (docs/resilience.md,
// "What is bounded").
#pragma once

#include <cstddef>

namespace roci::science {

/// Images that are looked at in one run: one every five minutes for a month. Those beyond show nothing (event
/// science.no_room).
inline constexpr std::size_t kPhotos = 10'000;
/// Bytes of an image's id.
inline constexpr std::size_t kNameBytes = 1'024;
/// Bytes of an image's file, and pixels of its sides. Others are unreadable (event image.unreadable).
inline constexpr std::size_t kFileBytes = 2 << 20;
inline constexpr int kSidePixels = 1'024;
inline constexpr int kLeastSidePixels = 16;
/// Unreadable images that are told of in one run, and bytes of their ids that are told.
inline constexpr std::size_t kUnreadableTold = 100;
inline constexpr std::size_t kNameBytesTold = 100;
/// Images whose patches are the background that a new one is compared with: the newest ones.
inline constexpr std::size_t kBackgroundImages = 24;
/// Patches of one image.
inline constexpr std::size_t kPatches = 4'096;

}  // namespace roci::science
