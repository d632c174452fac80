#include "core/terrain/site_file.hpp"

#include <string>
#include <utility>
#include <vector>

#include "core/mission/entry.hpp"
#include "core/terrain/pgm.hpp"

namespace roci::terrain {
namespace {

using mission::Entry;

double read_resolution(const Entry& map) {
  const Entry value = map.at("resolution");
  const double resolution = value.number();
  if (resolution <= 0) value.fail("'resolution' must be positive, metres per pixel");
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

GreyImage read_image(const Entry& owner) {
  const Entry name = owner.at("image");
  const std::filesystem::path path = owner.resolve(name.text());
  if (!std::filesystem::is_regular_file(path)) {
    name.fail("image '" + name.text() +
              "' is not there; it is looked for beside this file: " + path.string());
  }
  return read_pgm(path);
}

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

void fill_elevation(SiteLayers& layers, const Grid& grid, const Entry& section) {
  section.allow_only({"image", "min", "max"});
  const double low = section.at("min").number();
  const double high = section.at("max").number();
  if (high < low) section.at("max").fail("'max' must not be below 'min', metres");
  const GreyImage image = read_image(section);
  if (image.width != grid.columns || image.height != grid.rows) {
    section.at("image").fail("the elevation image has " + std::to_string(image.width) + " x " +
                             std::to_string(image.height) + " pixels, the map " +
                             std::to_string(grid.columns) + " x " + std::to_string(grid.rows) +
                             "; both must cover the same cells");
  }
  for (std::size_t i = 0; i < grid.cell_count(); ++i) {
    const double share = static_cast<double>(image.pixels[pixel_of(grid, grid.cell_at(i))]) / image.max_value;
    layers.elevation.push_back(static_cast<float>(low + (high - low) * share));
  }
}

}  // namespace

Site load_site(const std::filesystem::path& description) {
  const Entry map = Entry::load(description);
  map.allow_only({"image", "mode", "resolution", "origin", "negate", "occupied_thresh", "free_thresh",
                  "rocks", "elevation"});
  Grid grid;
  grid.resolution = read_resolution(map);
  grid.origin = read_origin(map);
  const Thresholds thresholds = read_thresholds(map);
  const double max_height = read_rock_height(map);
  const GreyImage image = read_image(map);
  grid.columns = image.width;
  grid.rows = image.height;

  SiteLayers layers;
  fill_rocks(layers, grid, image, thresholds, max_height);
  if (const auto elevation = map.find("elevation")) {
    fill_elevation(layers, grid, *elevation);
  } else {
    layers.elevation.assign(grid.cell_count(), 0.0F);
  }
  return Site(grid, std::move(layers));
}

}  // namespace roci::terrain
