// A picture consists of pixels, and has the few shapes that a map needs, with smooth edges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace roci::console::cli::map {

/// Holds a colour by its parts, 0 to 255.
struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
  bool operator==(const Colour&) const = default;
};

/// Holds a place in the picture: x to the right and y down, in pixels; the first pixel covers 0 … 1.
struct Spot {
  double x = 0;
  double y = 0;
};

/// Holds a part of the picture, in pixels. Shapes are cut at it.
struct Frame {
  double left = 0, top = 0, right = 0, bottom = 0;
};

/// Holds pixels, and draws shapes into them with smooth edges.
class Picture {
 public:
  Picture(int width, int height, Colour ground);

  int width() const { return width_; }
  int height() const { return height_; }
  Colour at(int x, int y) const { return pixels_[index(x, y)]; }
  /// Rows from the top, three bytes a pixel.
  std::vector<std::uint8_t> bytes() const;

  /// Shapes drawn from now on are cut at this frame.
  void clip(const Frame& frame) { clip_ = frame; }
  void clip_nothing() { clip_ = {0, 0, static_cast<double>(width_), static_cast<double>(height_)}; }

  /// Mixes a colour into a pixel by its share, 0 … 1; outside the clip nothing happens.
  void mix(int x, int y, Colour colour, double share);
  void fill(const Frame& frame, Colour colour, double share = 1);
  void line(Spot from, Spot to, double width, Colour colour, double share = 1);
  /// Draws the line in dashes; `done` is the length drawn before, so that dashes go on around corners.
  /// Returns the length after it.
  double dashes(Spot from, Spot to, double width, double dash, Colour colour, double done = 0);
  void disc(Spot centre, double radius, Colour colour, double share = 1);
  void ring(Spot centre, double radius, double width, Colour colour);

  /// Writes printable ASCII, other bytes as "?", from the upper left corner; a letter is 5 units wide and 7 high, and
  /// the next one begins 6 units on. `size`: pixels of a unit. With `halo`, the letters stand on a light rim.
  void text(Spot corner, std::string_view words, double size, Colour colour, bool halo = false);
  static double text_width(std::string_view words, double size);

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  // Calls share_of(distance from the segment) for the pixels near it.
  template <typename ShareOf>
  void near_segment(Spot from, Spot to, double reach, Colour colour, ShareOf share_of);
  void strokes(Spot corner, std::string_view words, double size, double width, Colour colour);

  int width_;
  int height_;
  Frame clip_;
  std::vector<Colour> pixels_;
};

/// Returns the columns of a letter from the left, bit 0 at the top; of the "?" for what is not printable ASCII.
const std::uint8_t* letter(char c);

}  // namespace roci::console::cli::map
