#include "ground_console/cli/map/picture.hpp"

#include <algorithm>
#include <cmath>

namespace roci::console::cli::map {
namespace {

constexpr Colour kHalo{255, 255, 255};

double distance_to_segment(Spot a, Spot b, double x, double y) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double length2 = dx * dx + dy * dy;
  const double share = length2 > 0 ? std::clamp(((x - a.x) * dx + (y - a.y) * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(x - a.x - share * dx, y - a.y - share * dy);
}

}  // namespace

Picture::Picture(int width, int height, Colour ground) : width_(width), height_(height) {
  pixels_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), ground);
  clip_nothing();
}

std::vector<std::uint8_t> Picture::bytes() const {
  std::vector<std::uint8_t> out;
  out.reserve(pixels_.size() * 3);
  for (const Colour& pixel : pixels_) out.insert(out.end(), {pixel.red, pixel.green, pixel.blue});
  return out;
}

void Picture::mix(int x, int y, Colour colour, double share) {
  if (share <= 0 || x < clip_.left || y < clip_.top || x + 1 > clip_.right || y + 1 > clip_.bottom) return;
  Colour& pixel = pixels_[index(x, y)];
  const auto mixed = [share = std::min(share, 1.0)](std::uint8_t below, std::uint8_t above) {
    return static_cast<std::uint8_t>(std::lround(below + (above - below) * share));
  };
  pixel = {mixed(pixel.red, colour.red), mixed(pixel.green, colour.green), mixed(pixel.blue, colour.blue)};
}

void Picture::fill(const Frame& frame, Colour colour, double share) {
  const auto first = [](double v) { return static_cast<int>(std::lround(v)); };
  for (int y = first(frame.top); y < first(frame.bottom); ++y) {
    for (int x = first(frame.left); x < first(frame.right); ++x) mix(x, y, colour, share);
  }
}

template <typename ShareOf>
void Picture::near_segment(Spot from, Spot to, double reach, Colour colour, ShareOf share_of) {
  // What lies outside the clip is not even looked at: a line may lead far out of the picture.
  const auto column = [this](double v) { return static_cast<int>(std::clamp(v, -1.0, width_ + 1.0)); };
  const auto row = [this](double v) { return static_cast<int>(std::clamp(v, -1.0, height_ + 1.0)); };
  const int left = column(std::min(from.x, to.x) - reach - 1);
  const int right = column(std::max(from.x, to.x) + reach + 1);
  const int top = row(std::min(from.y, to.y) - reach - 1);
  const int bottom = row(std::max(from.y, to.y) + reach + 1);
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      mix(x, y, colour, share_of(distance_to_segment(from, to, x + 0.5, y + 0.5)));
    }
  }
}

void Picture::line(Spot from, Spot to, double width, Colour colour, double share) {
  near_segment(from, to, width / 2, colour,
               [&](double distance) { return share * std::clamp(width / 2 + 0.5 - distance, 0.0, 1.0); });
}

double Picture::dashes(Spot from, Spot to, double width, double dash, Colour colour, double done) {
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  if (length == 0) return done;
  const auto at = [&](double along) {
    return Spot{from.x + (to.x - from.x) * along / length, from.y + (to.y - from.y) * along / length};
  };
  // A dash is drawn, and then as much is left out.
  for (double along = -std::fmod(done, 2 * dash); along < length; along += 2 * dash) {
    const double begin = std::max(along, 0.0);
    const double end = std::min(along + dash, length);
    if (end > begin) line(at(begin), at(end), width, colour);
  }
  return done + length;
}

void Picture::disc(Spot centre, double radius, Colour colour, double share) {
  line(centre, centre, 2 * radius, colour, share);
}

void Picture::ring(Spot centre, double radius, double width, Colour colour) {
  near_segment(centre, centre, radius + width / 2, colour, [&](double distance) {
    return std::clamp(width / 2 + 0.5 - std::abs(distance - radius), 0.0, 1.0);
  });
}

double Picture::text_width(std::string_view words, double size) {
  return words.empty() ? 0 : (6 * static_cast<double>(words.size()) - 1) * size;
}

void Picture::text(Spot corner, std::string_view words, double size, Colour colour, bool halo) {
  if (halo) strokes(corner, words, size, size * 0.9 + 4, kHalo);
  strokes(corner, words, size, size * 0.95, colour);
}

// Each dot of a letter is joined with the dots beside it, and with one across a corner where nothing else joins them.
void Picture::strokes(Spot corner, std::string_view words, double size, double width, Colour colour) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::uint8_t* columns = letter(words[i]);
    const auto lit = [columns](int x, int y) {
      return x >= 0 && x < 5 && y >= 0 && y < 8 && (columns[x] >> y & 1) != 0;
    };
    const auto spot = [&](int x, int y) {
      return Spot{corner.x + (static_cast<double>(6 * i) + x + 0.5) * size, corner.y + (y + 0.5) * size};
    };
    for (int x = 0; x < 5; ++x) {
      for (int y = 0; y < 8; ++y) {
        if (!lit(x, y)) continue;
        const bool right = lit(x + 1, y);
        const bool below = lit(x, y + 1);
        if (right) line(spot(x, y), spot(x + 1, y), width, colour);
        if (below) line(spot(x, y), spot(x, y + 1), width, colour);
        if (!right && !below && lit(x + 1, y + 1)) line(spot(x, y), spot(x + 1, y + 1), width, colour);
        if (!lit(x - 1, y) && !below && lit(x - 1, y + 1))
          line(spot(x, y), spot(x - 1, y + 1), width, colour);
        line(spot(x, y), spot(x, y), width, colour);
      }
    }
  }
}

}  // namespace roci::console::cli::map
