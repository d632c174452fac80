#include "science_svc/patches.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "science_svc/limits.hpp"

namespace roci::science {

using terrain::GreyImage;

namespace {

constexpr double kGroundSide = 0.8;  // m, of the ground that a patch shows, if it has the pixels
constexpr int kLeastWidth = 6;
constexpr int kLeastHeight = 4;
constexpr double kMargin = 0.06;  // of light, below which a neighbour is as light as the middle
constexpr double kFaint = 0.01;   // of light, added before a logarithm

constexpr std::array<std::array<int, 2>, 8> kRing{
    {{-1, -1}, {0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}}};

// Is an image in shares of the median light of its ground.
class Light {
 public:
  Light(const GreyImage& image, const std::vector<Patch>& patches) : image_(image) {
    std::vector<std::uint16_t> seen;
    for (const Patch& one : patches)
      for (int row = one.window.top; row < one.window.top + one.window.height; row += 2)
        for (int column = one.window.left; column < one.window.left + one.window.width; column += 2)
          seen.push_back(pixel(column, row));
    if (seen.empty()) return;
    const auto middle = seen.begin() + static_cast<std::ptrdiff_t>(seen.size() / 2);
    std::nth_element(seen.begin(), middle, seen.end());
    scale_ = 1 / std::max(4.0, static_cast<double>(*middle));
  }

  double at(int column, int row) const {
    return scale_ * pixel(std::clamp(column, 0, image_.width - 1), std::clamp(row, 0, image_.height - 1));
  }

 private:
  std::uint16_t pixel(int column, int row) const {
    return image_.pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(image_.width) +
                         static_cast<std::size_t>(column)];
  }

  const GreyImage& image_;
  double scale_ = 1.0 / 128;
};

// Says whether the local binary pattern around a pixel is flat (0), a uniform edge (1), or neither (2).
int pattern(const Light& light, int column, int row) {
  const double middle = light.at(column, row) + kMargin;
  std::array<bool, 8> above{};
  int ones = 0, changes = 0;
  for (std::size_t i = 0; i < kRing.size(); ++i) {
    above[i] = light.at(column + kRing[i][0], row + kRing[i][1]) > middle;
    ones += above[i];
  }
  for (std::size_t i = 0; i < above.size(); ++i) changes += above[i] != above[(i + 1) % above.size()];
  if (ones == 0) return 0;
  return changes <= 2 ? 1 : 2;
}

Features describe(const Light& light, const Window& w) {
  double sum = 0, squares = 0, along = 0, across = 0, least = 1e9, most = 0;
  int light_ones = 0, dark_ones = 0;
  std::array<int, 3> patterns{};
  const int count = w.width * w.height;
  for (int row = w.top; row < w.top + w.height; ++row) {
    for (int column = w.left; column < w.left + w.width; ++column) {
      const double here = light.at(column, row);
      sum += here;
      squares += here * here;
      along += std::abs(light.at(column + 1, row) - here);
      across += std::abs(light.at(column, row + 1) - here);
      least = std::min(least, here);
      most = std::max(most, here);
      light_ones += here > 1.4;
      dark_ones += here < 0.5;
      ++patterns[static_cast<std::size_t>(pattern(light, column, row))];
    }
  }
  const double mean = sum / count;
  Features out;
  out << std::log(mean + kFaint), std::log(std::sqrt(std::max(0.0, squares / count - mean * mean)) + kFaint),
      std::log(along / count + kFaint), std::log(across / count + kFaint), std::log(most - mean + kFaint),
      std::log(mean - least + kFaint), static_cast<double>(light_ones) / count,
      static_cast<double>(dark_ones) / count, static_cast<double>(patterns[0]) / count,
      static_cast<double>(patterns[2]) / count;
  return out;
}

// Returns the size of a patch of kGroundSide metres that is seen at a slant, in the image's middle column; nothing
// where the row shows no ground within reach.
std::optional<Window> patch_in_row(const GreyImage& image, const CameraModel& camera, const Viewpoint& from,
                                   const MappedGround& ground, double reach, int row) {
  const auto seen = ground_at(ground, camera, from, image.width, image.height, image.width / 2.0, row, reach);
  if (!seen) return std::nullopt;
  const double range = std::max(0.5, terrain::distance(*seen, from.at));
  const double width = focal_px(camera, image.width) * kGroundSide / range;
  // Of a small image a patch may be more than a quarter.
  const auto even = [](double v, int least, int most) {
    return std::clamp(static_cast<int>(std::lround(v / 2)) * 2, least, std::max(least, most));
  };
  return Window{0, row, even(width, kLeastWidth, image.width / 4),
                even(width * camera.mast_m / range, kLeastHeight, image.height / 4)};
}

}  // namespace

std::vector<Patch> patches_of(const GreyImage& image, const CameraModel& camera, const Viewpoint& from,
                              const MappedGround& ground, double reach) {
  std::vector<Patch> out;
  for (int top = 0; top < image.height;) {
    const Window size = patch_in_row(image, camera, from, ground, reach, top)
                            .value_or(Window{0, top, kLeastWidth, kLeastHeight});
    const int width = size.width, height = size.height;
    if (top + height > image.height) break;
    for (int left = 0; left + width <= image.width && out.size() < kPatches; left += width / 2) {
      Patch patch{{left, top, width, height}, {}, 0, Features::Zero()};
      const double middle = left + width / 2.0;
      // The upper edge is the farthest part of it.
      if (!ground_at(ground, camera, from, image.width, image.height, middle, top, reach)) continue;
      const auto place =
          ground_at(ground, camera, from, image.width, image.height, middle, top + height / 2.0, reach);
      if (!place) continue;
      patch.ground = *place;
      patch.range = terrain::distance(*place, from.at);
      out.push_back(patch);
    }
    top += height / 2;
  }
  const Light light(image, out);
  for (Patch& one : out) one.features = describe(light, one.window);
  return out;
}

}  // namespace roci::science
