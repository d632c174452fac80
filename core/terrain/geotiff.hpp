// This file reads elevations from a GeoTIFF, with GDAL where the build has it.
#pragma once
#include <filesystem>
#include <vector>

#include "core/terrain/grid.hpp"

namespace roci::terrain {

/// Holds what a GeoTIFF says of the ground: elevations in metres by rows from the south, NaN where it has no data.
/// The grid's origin is that of the file, in metres of its projection.
struct ElevationModel {
  Grid grid;
  std::vector<float> elevation;
};

/// Tells by its name whether a file is taken for a GeoTIFF: .tif or .tiff, in any case.
bool is_geotiff_name(const std::filesystem::path& file);

/// Reads a digital elevation model with GDAL (Open Source Geospatial Foundation, gdal.org). It must have one band, a
/// projection in metres (or a local frame in metres), square pixels, north at the top, and at most 16384 pixels a side.
/// Throws MapError with the remedy for any other file, and for all files where this program was built without GDAL
/// (CMake option ROCI_GEOTIFF).
ElevationModel read_geotiff(const std::filesystem::path& file);

}  // namespace roci::terrain
