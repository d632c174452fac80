// This file reads a site from its files: map_server YAML with images, or a GeoTIFF.
#pragma once
#include <filesystem>

#include "core/terrain/site.hpp"

namespace roci::terrain {

/// Reads a site from a map description of the map_server format (wiki.ros.org/map_server, "Map format") with
/// the keys image, resolution, origin, negate, occupied_thresh, free_thresh and optionally mode (trinary,
/// scale), extended by
///
///   rocks:     {max_height: 1.0}                      a black pixel is a rock of that height (default 1) [m]
///   elevation: {image: e.pgm, min: -4.0, max: 9.0}    pixel 0 lies at min, the largest value at max [m];
///                                                     `nodata: 0` names the value of a pixel that is a hole
///   elevation: {image: e.tif}                         a GeoTIFF in metres (geotiff.hpp)
///   keep_out:  [{polygon: [[x, y], …]}, …]            ground that nobody may enter [m]
///
/// Both images have the same size and cover the same cells; without `elevation` the site is flat at 0 m. With
/// mode scale, grey is a rock of that share of max_height; with mode trinary (the default) grey is unknown.
/// Cells are square: resolution is one number, from 0.01 to 10000 m. Where the elevation is a GeoTIFF, `image` and the
/// keys that go with it may be left out: then the GeoTIFF says where the cells lie, there are no rocks, and an `origin`
/// shifts the map. `description` may be a GeoTIFF itself. A hole becomes ground that is unknown (holes.hpp). Throws
/// mission::FileError (description) or MapError (images): file, line and column, what is wrong, and the remedy.
Site load_site(const std::filesystem::path& description);

}  // namespace roci::terrain
