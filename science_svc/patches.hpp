// Images are taken as sets of patches, each described by numbers that say what its ground looks like.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "science_svc/camera.hpp"
#include "science_svc/picture.hpp"

namespace roci::science {

inline constexpr int kFeatures = 10;
/// Are, each of light as a share of that of the image's ground: brightness, contrast, gradients along and across
/// (logarithms), how far the lightest and the darkest pixel lie from the mean, the shares of very light and of very
/// dark pixels, and of the local binary patterns (Ojala, Pietikäinen, Mäenpää, "Multiresolution gray-scale and rotation
/// invariant texture classification with local binary patterns", IEEE TPAMI 24, 2002) those that are flat and those
/// that are no uniform edge.
using Features = Eigen::Matrix<double, kFeatures, 1>;

/// Holds a rectangle of ground in an image.
struct Patch {
  Window window;
  terrain::Point ground;  ///< what its middle shows
  double range = 0;       ///< from the camera to there, m
  Features features = Features::Zero();
};

/// Cuts what lies within `reach` metres into patches that show about as much ground, whether near or far, and overlap
/// by half; from the top down, at most kPatches.
std::vector<Patch> patches_of(const terrain::GreyImage&, const CameraModel&, const Viewpoint&,
                              const MappedGround&, double reach);

}  // namespace roci::science
