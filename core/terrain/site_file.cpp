#include "core/terrain/site_file.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/mission/entry.hpp"
#include "core/terrain/geotiff.hpp"
#include "core/terrain/holes.hpp"
#include "core/terrain/map_error.hpp"
#include "core/terrain/pgm.hpp"
#include "core/terrain/polygon_file.hpp"

namespace roci::terrain {
namespace {

using mission::Entry;

// A map beyond these is a slip of the pen: who fits planes to its cells would never come to an end.
constexpr double kFinest = 0.01, kCoarsest = 10'000;  // m

// Says what is wrong with a side of pixels; nothing if it can be worked with.
std::string fault_of_resolution(double metres) {
  if (metres >= kFinest && metres <= kCoarsest) return {};
  std::ostringstream fault;
  fault << "is " << metres << " m per pixel, and must be between " << kFinest << " and " << kCoarsest
        << "; give it in metres, or resample the images";
  return fault.str();
}

double read_resolution(const Entry& map) {
  const Entry value = map.at("resolution");
  const double resolution = value.number();
  if (resolution <= 0) value.fail("'resolution' must be positive; give it in metres per pixel");
  if (const std::string fault = fault_of_resolution(resolution); !fault.empty())
    value.fail("'resolution' " + fault);
  return resolution;
}

Point read_origin(const Entry& map) {
  const Entry value = map.at("origin");
  const std::vector<Entry> pose = value.items();
  if (pose.size() != 3) value.fail("'origin' must be [x, y, yaw] of the lower left corner");
  if (pose[2].number() != 0)
    pose[2].fail("a rotated map (yaw not 0) is not supported; rotate the images instead");
  return {pose[0].number(), pose[1].number()};
}

bool read_negate(const Entry& map) {
  const Entry value = map.at("negate");
  const std::string text = value.text();
  if (text != "0" && text != "1" && text != "false" && text != "true") value.fail("'negate' must be 0 or 1");
  return text == "1" || text == "true";
}

bool read_graded(const Entry& map) {
  const auto mode = map.find("mode");
  if (!mode) return false;
  if (mode->text() != "trinary" && mode->text() != "scale") mode->fail("'mode' must be trinary or scale");
  return mode->text() == "scale";
}

// Holds the share of darkness (of brightness, if negated) above which a pixel is occupied, and below which it
// is free.
struct Thresholds {
  double occupied;
  double free;
  bool negate;
  bool graded;
};

Thresholds read_thresholds(const Entry& map) {
  const Thresholds t{map.at("occupied_thresh").number(), map.at("free_thresh").number(), read_negate(map),
                     read_graded(map)};
  if (t.free < 0 || t.occupied > 1 || t.free > t.occupied) {
    map.at("free_thresh").fail("thresholds must satisfy 0 <= free_thresh <= occupied_thresh <= 1");
  }
  return t;
}

double read_rock_height(const Entry& map) {
  const auto rocks = map.find("rocks");
  if (!rocks) return 1.0;
  rocks->allow_only({"max_height"});
  const Entry height = rocks->at("max_height");
  if (height.number() <= 0) height.fail("'max_height' must be positive, metres");
  return height.number();
}

std::filesystem::path image_path(const Entry& owner) {
  const Entry name = owner.at("image");
  const std::filesystem::path path = owner.resolve(name.text());
  if (!std::filesystem::is_regular_file(path)) {
    name.fail("image '" + name.text() +
              "' is not there; it is looked for beside this file: " + path.string());
  }
  return path;
}

GreyImage read_image(const Entry& owner) { return read_pgm(image_path(owner)); }

// Returns the pixel of the image (rows from the north) that shows a cell (rows from the south).
std::size_t pixel_of(const Grid& grid, Cell c) { return grid.index({c.column, grid.rows - 1 - c.row}); }

void fill_rocks(SiteLayers& layers, const Grid& grid, const GreyImage& image, const Thresholds& t,
                double max_height) {
  for (std::size_t i = 0; i < grid.cell_count(); ++i) {
    const double grey = static_cast<double>(image.pixels[pixel_of(grid, grid.cell_at(i))]) / image.max_value;
    const double share = t.negate ? grey : 1 - grey;
    const bool occupied = share > t.occupied;
    const bool unknown = !occupied && !t.graded && share >= t.free;
    layers.occupancy.push_back(occupied  ? Occupancy::occupied
                               : unknown ? Occupancy::unknown
                                         : Occupancy::free);
    const double height = t.graded ? share * max_height : occupied ? max_height : 0.0;
    layers.rock_height.push_back(static_cast<float>(height));
  }
}

void require_size(const Entry& section, const Grid& grid, int columns, int rows) {
  if (columns == grid.columns && rows == grid.rows) return;
  section.at("image").fail("the elevation image has " + std::to_string(columns) + " x " +
                           std::to_string(rows) + " pixels, the map " + std::to_string(grid.columns) + " x " +
                           std::to_string(grid.rows) + "; both must cover the same cells");
}

std::optional<int> read_nodata(const Entry& section) {
  const auto nodata = section.find("nodata");
  if (!nodata) return std::nullopt;
  const std::int64_t value = nodata->integer();
  if (value < 0 || value > 65535) nodata->fail("'nodata' must be the value of a pixel, 0 … 65535");
  return static_cast<int>(value);
}

void fill_elevation(SiteLayers& layers, const Grid& grid, const Entry& section) {
  section.allow_only({"image", "min", "max", "nodata"});
  const double low = section.at("min").number();
  const double high = section.at("max").number();
  if (high < low) section.at("max").fail("'max' must not be below 'min', metres");
  const std::optional<int> nodata = read_nodata(section);
  const GreyImage image = read_image(section);
  require_size(section, grid, image.width, image.height);
  for (std::size_t i = 0; i < grid.cell_count(); ++i) {
    const int pixel = image.pixels[pixel_of(grid, grid.cell_at(i))];
    const double share = static_cast<double>(pixel) / image.max_value;
    layers.elevation.push_back(pixel == nodata ? std::numeric_limits<float>::quiet_NaN()
                                               : static_cast<float>(low + (high - low) * share));
  }
}

bool is_geotiff(const Entry& elevation) {
  return elevation.is_mapping() && elevation.find("image") && is_geotiff_name(elevation.at("image").text());
}

ElevationModel read_model(const Entry& section) {
  section.allow_only({"image"});
  return read_geotiff(image_path(section));
}

std::vector<Polygon> read_keep_out(const Entry& map) {
  std::vector<Polygon> polygons;
  if (const auto zones = map.find("keep_out")) {
    for (const Entry& zone : zones->items()) polygons.push_back(read_polygon(zone));
  }
  return polygons;
}

Site finish(const std::filesystem::path& file, const Grid& grid, SiteLayers layers) {
  if (const std::string fault = fault_of_resolution(grid.resolution); !fault.empty())
    throw MapError(file.string() + ": the resolution " + fault);
  try {
    fill_holes(grid, layers);
  } catch (const MapError& error) {
    throw MapError(file.string() + ": " + error.what());
  }
  return Site(grid, std::move(layers));
}

// Makes a site of what a GeoTIFF says alone: known ground without rocks.
Site site_of(const std::filesystem::path& file, ElevationModel model, std::vector<Polygon> keep_out) {
  SiteLayers layers;
  layers.rock_height.assign(model.grid.cell_count(), 0.0F);
  layers.occupancy.assign(model.grid.cell_count(), Occupancy::free);
  layers.elevation = std::move(model.elevation);
  layers.keep_out = std::move(keep_out);
  return finish(file, model.grid, std::move(layers));
}

// Reads the section of a map with an image of rocks, which says where the cells lie.
void fill_from_model(SiteLayers& layers, const Grid& grid, const Entry& section) {
  ElevationModel model = read_model(section);
  require_size(section, grid, model.grid.columns, model.grid.rows);
  if (std::abs(model.grid.resolution - grid.resolution) > 1e-6 * grid.resolution) {
    section.at("image").fail("the GeoTIFF has pixels of " + std::to_string(model.grid.resolution) +
                             " m, the map of " + std::to_string(grid.resolution) +
                             " m; both must cover the same cells");
  }
  layers.elevation = std::move(model.elevation);
}

}  // namespace

Site load_site(const std::filesystem::path& description) {
  if (is_geotiff_name(description)) return site_of(description, read_geotiff(description), {});
  const Entry map = Entry::load(description);
  map.allow_only({"image", "mode", "resolution", "origin", "negate", "occupied_thresh", "free_thresh",
                  "rocks", "elevation", "keep_out"});
  const auto elevation = map.find("elevation");
  if (elevation && is_geotiff(*elevation) && !map.find("image")) {
    map.allow_only({"elevation", "origin", "keep_out"});
    ElevationModel model = read_model(*elevation);
    if (map.find("origin")) model.grid.origin = read_origin(map);
    return site_of(description, std::move(model), read_keep_out(map));
  }
  Grid grid;
  grid.resolution = read_resolution(map);
  grid.origin = read_origin(map);
  const Thresholds thresholds = read_thresholds(map);
  const double max_height = read_rock_height(map);
  const GreyImage image = read_image(map);
  grid.columns = image.width;
  grid.rows = image.height;

  SiteLayers layers;
  layers.keep_out = read_keep_out(map);
  fill_rocks(layers, grid, image, thresholds, max_height);
  if (!elevation) {
    layers.elevation.assign(grid.cell_count(), 0.0F);
  } else if (is_geotiff(*elevation)) {
    fill_from_model(layers, grid, *elevation);
  } else {
    fill_elevation(layers, grid, *elevation);
  }
  return finish(description, grid, std::move(layers));
}

}  // namespace roci::terrain
