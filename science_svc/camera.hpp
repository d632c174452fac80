// This file leads from pixels to places: where on the ground lies what a pixel shows.
#pragma once
#include <optional>

#include "core/terrain/site.hpp"

namespace roci::science {

/// Holds what is known of a camera: a pinhole on a mast, that looks ahead and down; pixels are square (Hartley
/// and Zisserman, "Multiple View Geometry in Computer Vision", 2nd ed. 2004, chapter 6).
struct CameraModel {
  double mast_m = 1.9;
  double tilt_deg = 18;  ///< of the middle of the image below the horizon
  double view_deg = 60;  ///< from the left edge to the right one
};

/// Returns the focal length, in pixels, of an image so many pixels wide.
double focal_px(const CameraModel&, int width);

/// Says where the camera's robot stood, and whereto the camera looked, in radians from east towards north.
struct Viewpoint {
  terrain::Point at;
  double heading = 0;
};

/// Holds the ground as the map has it; flat at 0 m, without an end, where there is none. The site outlives
/// this.
struct MappedGround {
  const terrain::Site* site = nullptr;

  double elevation(terrain::Point p) const { return site ? site->elevation(p) : 0; }
  bool contains(terrain::Point p) const { return !site || site->grid().contains(p); }
};

/// Returns where the ray through a pixel (fractions count from the upper left corner of the image) meets the ground, or
/// nothing if that is above the horizon, beyond `reach` metres, or off the map.
std::optional<terrain::Point> ground_at(const MappedGround&, const CameraModel&, const Viewpoint&, int width,
                                        int height, double column, double row, double reach);

}  // namespace roci::science
