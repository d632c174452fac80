// This is the only unit that knows GDAL.
#include "core/terrain/geotiff.hpp"

#include <cpl_error.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "core/terrain/map_error.hpp"

namespace roci::terrain {
namespace {

constexpr int kMaxRasterSide = 16384;
constexpr double kSame = 1e-6;  // relative difference of sides up to which a pixel is square

struct Closes {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<GDALDataset, Closes>;

// Keeps GDAL from printing its errors; they go into what is thrown.
class Quiet {
 public:
  Quiet() { CPLPushErrorHandler(CPLQuietErrorHandler); }
  ~Quiet() { CPLPopErrorHandler(); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;
};

class RasterReader {
 public:
  explicit RasterReader(const std::filesystem::path& file) : name_(file.string()) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) {
      fail("cannot open the GeoTIFF; check the path and the permissions");
    }
    // No other driver is let at the file: some of them follow what a file says to other files and hosts.
    GDALRegister_GTiff();
    const std::array<const char*, 2> drivers{"GTiff", nullptr};
    CPLErrorReset();
    dataset_.reset(GDALDataset::Open(name_.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers.data()));
    if (!dataset_) fail("is not a GeoTIFF that can be read" + said_by_gdal());
  }

  ElevationModel read() {
    const int columns = dataset_->GetRasterXSize();
    const int rows = dataset_->GetRasterYSize();
    if (columns > kMaxRasterSide || rows > kMaxRasterSide) {
      fail("has " + std::to_string(columns) + " x " + std::to_string(rows) + " pixels, more than " +
           std::to_string(kMaxRasterSide) +
           " a side; cut it (gdal_translate -srcwin) or make it coarser (-tr)");
    }
    if (dataset_->GetRasterCount() != 1) {
      fail("has " + std::to_string(dataset_->GetRasterCount()) +
           " bands, one of elevations in metres is needed; choose it with gdal_translate -b");
    }
    check_projection();
    ElevationModel model;
    model.grid = read_grid(columns, rows);
    read_band(*dataset_->GetRasterBand(1), model);
    return model;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw MapError(name_ + ": " + what); }

  static std::string said_by_gdal() {
    const std::string text = CPLGetLastErrorMsg();
    return text.empty() ? "; check the file" : " (GDAL: " + text + "); generate or copy the file again";
  }

  void check_projection() const {
    const OGRSpatialReference* frame = dataset_->GetSpatialRef();
    if (frame == nullptr || frame->IsEmpty()) {
      fail(
          "has no projection, so that nobody knows how many metres a pixel is; give it one "
          "(gdal_edit.py -a_srs EPSG:NUMBER FILE)");
    }
    if (frame->IsGeographic() != 0) {
      fail("is in degrees, metres are needed; project it (gdalwarp -t_srs EPSG:NUMBER -tr 1 1 FILE OUT)");
    }
    if (frame->IsProjected() == 0 && frame->IsLocal() == 0) {
      fail("is in a frame that is no map of the ground; project it (gdalwarp -t_srs EPSG:NUMBER FILE OUT)");
    }
    if (std::abs(frame->GetLinearUnits() - 1) > kSame) {
      fail("is not in metres (its unit has " + std::to_string(frame->GetLinearUnits()) +
           " m); project it into a frame in metres (gdalwarp -t_srs)");
    }
  }

  Grid read_grid(int columns, int rows) const {
    std::array<double, 6> transform{};
    if (dataset_->GetGeoTransform(transform.data()) != CE_None) {
      fail("does not say where its pixels lie; give it corners (gdal_edit.py -a_ullr X Y X Y FILE)");
    }
    const auto [west, width, skew_x, north, skew_y, height] = transform;
    if (skew_x != 0 || skew_y != 0 || width <= 0 || height >= 0) {
      fail("is rotated or has south at the top; bring it to north up (gdalwarp FILE OUT)");
    }
    if (std::abs(width + height) > kSame * width) {
      fail("has pixels of " + std::to_string(width) + " x " + std::to_string(-height) +
           " m, square ones are needed; resample it (gdalwarp -tr 1 1 FILE OUT)");
    }
    return {columns, rows, width, {west, north + rows * height}};
  }

  void read_band(GDALRasterBand& band, ElevationModel& model) const {
    if (GDALDataTypeIsComplex(band.GetRasterDataType()) != 0) fail("holds complex numbers, no elevations");
    int has_hole_value = 0;
    const double hole_value = band.GetNoDataValue(&has_hole_value);
    const double scale = band.GetScale();
    const double offset = band.GetOffset();
    const int columns = model.grid.columns;
    std::vector<double> line(static_cast<std::size_t>(columns));
    model.elevation.resize(model.grid.cell_count());
    for (int image_row = 0; image_row < model.grid.rows; ++image_row) {
      CPLErrorReset();
      if (band.RasterIO(GF_Read, 0, image_row, columns, 1, line.data(), columns, 1, GDT_Float64, 0, 0) !=
          CE_None) {
        fail("is damaged in line " + std::to_string(image_row) + said_by_gdal());
      }
      for (int column = 0; column < columns; ++column) {
        const double value = line[static_cast<std::size_t>(column)];
        // A file of 32-bit numbers tells its value for holes in 64 bits.
        const bool hole =
            !std::isfinite(value) ||
            (has_hole_value != 0 &&
             (value == hole_value || static_cast<float>(value) == static_cast<float>(hole_value)));
        model.elevation[model.grid.index({column, model.grid.rows - 1 - image_row})] =
            hole ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(value * scale + offset);
      }
    }
  }

  std::string name_;
  Dataset dataset_;
};

}  // namespace

ElevationModel read_geotiff(const std::filesystem::path& file) {
  const Quiet quiet;
  return RasterReader(file).read();
}

}  // namespace roci::terrain
