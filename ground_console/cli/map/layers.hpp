// The layers of the map share colours, and the way from metres to pixels.
#pragma once

#include "ground_console/cli/map/mission_map.hpp"
#include "ground_console/cli/map/picture.hpp"

namespace roci::console::cli::map {

inline constexpr Colour kPaper{250, 249, 246}, kInk{38, 38, 40}, kQuiet{120, 118, 114}, kFrame{90, 88, 84};
inline constexpr Colour kLow{176, 150, 122}, kHigh{236, 220, 196}, kShadow{52, 40, 34}, kLight{255, 250, 238};
inline constexpr Colour kRock{74, 60, 52}, kUnknown{110, 122, 140}, kKeepOut{196, 30, 58},
    kHazard{240, 110, 0};
inline constexpr Colour kDriven{20, 74, 156}, kPlanned{120, 40, 140}, kRim{255, 255, 255}, kPlace{20, 20, 22};

/// Turns metres into pixels: north is up.
class Scale {
 public:
  Scale(const terrain::Grid& grid, const Frame& frame)
      : grid_(grid), frame_(frame), pixels_a_metre_((frame.right - frame.left) / grid.width()) {}

  double pixels(double metres) const { return metres * pixels_a_metre_; }
  Spot spot(terrain::Point p) const {
    return {frame_.left + pixels(p.x - grid_.origin.x), frame_.bottom - pixels(p.y - grid_.origin.y)};
  }
  terrain::Point point(double x, double y) const {
    return {grid_.origin.x + (x - frame_.left) / pixels_a_metre_,
            grid_.origin.y + (frame_.bottom - y) / pixels_a_metre_};
  }
  const Frame& frame() const { return frame_; }
  const terrain::Grid& grid() const { return grid_; }

 private:
  terrain::Grid grid_;
  Frame frame_;
  double pixels_a_metre_;
};

/// Calls visit(x, y) for each pixel of the frame.
template <typename Visit>
void for_each_pixel(const Frame& frame, Visit visit) {
  for (int y = static_cast<int>(frame.top); y < static_cast<int>(frame.bottom); ++y) {
    for (int x = static_cast<int>(frame.left); x < static_cast<int>(frame.right); ++x) visit(x, y);
  }
}

/// Tells whether a pixel lies on a stripe of a hatched area.
inline bool hatched(int x, int y) { return (x + y) % 10 < 3; }

/// Returns 1, 2 or 5 times a power of ten, at most `length`.
double round_length(double length);

/// Draws the ground, what is unknown of it, and its rocks.
void draw_ground(const terrain::Site& site, const Scale& scale, Picture& picture);
/// Draws the keep-out zones.
void draw_zones(const MissionMap& map, const Scale& scale, Picture& picture);

}  // namespace roci::console::cli::map
