#include "core/terrain/geotiff.hpp"
#include "core/terrain/map_error.hpp"

namespace roci::terrain {

ElevationModel read_geotiff(const std::filesystem::path& file) {
  throw MapError(file.string() +
                 ": this program was built without GDAL and cannot read a GeoTIFF; install libgdal-dev and "
                 "build with -DROCI_GEOTIFF=ON (ROCI_GEOTIFF=1 ./run does both), or convert the file to PGM "
                 "(core/terrain/README.md)");
}

}  // namespace roci::terrain
