#include "science_svc/picture.hpp"

#include <algorithm>

#include "core/terrain/map_error.hpp"
#include "science_svc/limits.hpp"

namespace roci::science {

using terrain::GreyImage;

GreyImage read_picture(std::string_view file, const std::string& id) {
  const auto fail = [&](const std::string& what) { throw terrain::MapError(id + ": " + what); };
  if (file.empty()) fail("the image has no pixels");
  if (file.size() > kFileBytes) {
    fail(std::to_string(file.size()) + " bytes are more than an image may have (" +
         std::to_string(kFileBytes) + ")");
  }
  if (!file.starts_with("P5")) fail("not a binary PGM image (it must begin with P5)");
  GreyImage out = terrain::parse_pgm(file, id);
  if (out.max_value > 255) fail("16 bits a pixel; an image has 8 (a largest value of at most 255)");
  if (std::min(out.width, out.height) < kLeastSidePixels || std::max(out.width, out.height) > kSidePixels) {
    fail(std::to_string(out.width) + " x " + std::to_string(out.height) + " pixels; an image has " +
         std::to_string(kLeastSidePixels) + " to " + std::to_string(kSidePixels) + " a side");
  }
  return out;
}

std::string cut(const GreyImage& image, const Window& window) {
  GreyImage out;
  const int left = std::clamp(window.left, 0, image.width - 1),
            top = std::clamp(window.top, 0, image.height - 1);
  out.width = std::clamp(window.width, 1, image.width - left);
  out.height = std::clamp(window.height, 1, image.height - top);
  out.max_value = image.max_value;
  for (int row = top; row < top + out.height; ++row) {
    const auto first = image.pixels.begin() + static_cast<std::ptrdiff_t>(row) * image.width + left;
    out.pixels.insert(out.pixels.end(), first, first + out.width);
  }
  return terrain::to_pgm(out, "");
}

}  // namespace roci::science
