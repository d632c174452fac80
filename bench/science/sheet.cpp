#include "bench/science/sheet.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace roci::bench::science {

using roci::science::Window;
using terrain::Point;

namespace {

using Colour = std::array<std::uint8_t, 3>;
constexpr Colour kRight{60, 220, 60}, kWrong{230, 50, 50}, kMissed{70, 120, 255};

class Canvas {
 public:
  Canvas(int width, int height) : width_(width), height_(height) {
    pixels_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  }
  void set(int x, int y, Colour colour) {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
    pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)] =
        colour;
  }
  void frame(int left, int top, int width, int height, Colour colour) {
    for (int x = left; x < left + width; ++x) {
      set(x, top, colour);
      set(x, top + height - 1, colour);
    }
    for (int y = top; y < top + height; ++y) {
      set(left, y, colour);
      set(left + width - 1, y, colour);
    }
  }
  std::string ppm() const {
    std::string out = "P6\n" + std::to_string(width_) + " " + std::to_string(height_) + "\n255\n";
    for (const Colour& one : pixels_)
      out.append({static_cast<char>(one[0]), static_cast<char>(one[1]), static_cast<char>(one[2])});
    return out;
  }

 private:
  int width_;
  int height_;
  std::vector<Colour> pixels_;
};

// Returns the pixels around all that show a target.
Window window_of(const sim::world::Oddity& odd, const World& world, const Trial& trial, double reach) {
  const auto& image = trial.photo.pixels;
  int left = image.width, top = image.height, right = 0, bottom = 0;
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const auto p = roci::science::ground_at({world.site.get()}, {}, trial.photo.from, image.width,
                                              image.height, column + 0.5, row + 0.5, 2 * reach);
      if (!p || terrain::distance(*p, {odd.x, odd.y}) > odd.radius) continue;
      left = std::min(left, column);
      right = std::max(right, column + 1);
      top = std::min(top, row);
      bottom = std::max(bottom, row + 1);
    }
  }
  return {left, top, right - left, bottom - top};
}

}  // namespace

std::string sheet(const std::vector<World>& worlds, double threshold, double reach, int columns, int rows,
                  int zoom) {
  const auto& first = worlds.front().trials.front().photo.pixels;
  const int width = first.width * zoom + 4, height = first.height * zoom + 4;
  Canvas canvas(columns * width, rows * height);
  int index = 0;
  for (const World& world : worlds) {
    roci::science::Detector detector({}, world.site);
    for (const Trial& trial : world.trials) {
      const auto finds = detector.candidates(trial.photo, threshold);
      if (index >= columns * rows) return canvas.ppm();
      if (&trial - world.trials.data() < 2 || (trial.to_see.empty() && finds.empty()))
        continue;  // it has learnt little yet
      const int x0 = index % columns * width, y0 = index / columns * height;
      ++index;
      for (int y = 0; y < first.height * zoom; ++y) {
        for (int x = 0; x < first.width * zoom; ++x) {
          const auto grey = static_cast<std::uint8_t>(
              trial.photo.pixels
                  .pixels[static_cast<std::size_t>(y / zoom) * static_cast<std::size_t>(first.width) +
                          static_cast<std::size_t>(x / zoom)]);
          canvas.set(x0 + x, y0 + y, {grey, grey, grey});
        }
      }
      std::vector<Point> places;
      const auto frame = [&](const Window& w, Colour colour, int wider) {
        canvas.frame(x0 + w.left * zoom - wider, y0 + w.top * zoom - wider, w.width * zoom + 2 * wider,
                     w.height * zoom + 2 * wider, colour);
      };
      for (const auto& find : finds) {
        frame(find.window, score_of(trial, {find.place}).right > 0 ? kRight : kWrong, 1);
        places.push_back(find.place);
      }
      for (const auto& odd : trial.to_see) {
        Trial alone = trial;
        alone.to_see = {odd};
        if (score_of(alone, places).found == 0) frame(window_of(odd, world, trial, reach), kMissed, 2);
      }
    }
  }
  return canvas.ppm();
}

}  // namespace roci::bench::science
