#include "core/terrain/site_file.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/terrain/map_error.hpp"
#include "core/terrain/pgm.hpp"

namespace roci::terrain {
namespace {

/// A mapping of the description together with the file it stands in, so that every fault has a place.
class Section {
 public:
  Section(YAML::Node node, std::filesystem::path file, std::vector<std::string> keys)
      : node_(std::move(node)), file_(std::move(file)), keys_(std::move(keys)) {
    if (!node_.IsMap()) fail(node_, "expected keys " + known());
    for (const auto& entry : node_) {
      const auto key = entry.first.as<std::string>("");
      if (std::find(keys_.begin(), keys_.end(), key) == keys_.end()) {
        fail(entry.first, "unknown key '" + key + "'; known here: " + known());
      }
    }
  }

  [[noreturn]] void fail(const YAML::Node& node, const std::string& what) const {
    const YAML::Mark mark = node.Mark();
    throw MapError(file_.string() + ":" + std::to_string(mark.line + 1) + ":" +
                   std::to_string(mark.column + 1) + ": " + what);
  }

  bool has(const char* key) const { return node_[key].IsDefined(); }

  YAML::Node at(const char* key) const {
    YAML::Node value = node_[key];
    if (!value.IsDefined()) fail(node_, std::string("key '") + key + "' is missing");
    return value;
  }

  double number(const YAML::Node& value, const char* key) const {
    double result = 0;
    if (!value.IsScalar() || !YAML::convert<double>::decode(value, result) || !std::isfinite(result)) {
      fail(value, std::string("'") + key + "' must be a finite number");
    }
    return result;
  }
  double number(const char* key) const { return number(at(key), key); }

  std::filesystem::path image(const char* key) const {
    const YAML::Node value = at(key);
    if (!value.IsScalar() || value.Scalar().empty())
      fail(value, std::string("'") + key + "' must name a PGM file");
    const std::filesystem::path path = file_.parent_path() / value.Scalar();
    if (!std::filesystem::is_regular_file(path)) {
      fail(value, "image '" + value.Scalar() +
                      "' is not there; it is looked for beside this file: " + path.string());
    }
    return path;
  }

  Section section(const char* key, std::vector<std::string> keys) const {
    return {at(key), file_, std::move(keys)};
  }

 private:
  std::string known() const {
    std::string list;
    for (const auto& key : keys_) list += (list.empty() ? "" : ", ") + key;
    return list;
  }

  YAML::Node node_;
  std::filesystem::path file_;
  std::vector<std::string> keys_;
};

double read_resolution(const Section& map) {
  const YAML::Node value = map.at("resolution");
  if (value.IsSequence())
    map.fail(value, "cells must be square: 'resolution' is one number, metres per pixel");
  const double resolution = map.number(value, "resolution");
  if (resolution <= 0) map.fail(value, "'resolution' must be positive, metres per pixel");
  return resolution;
}

Point read_origin(const Section& map) {
  const YAML::Node value = map.at("origin");
  if (!value.IsSequence() || value.size() != 3)
    map.fail(value, "'origin' must be [x, y, yaw] of the lower left corner");
  if (map.number(value[2], "origin yaw") != 0) {
    map.fail(value[2], "a rotated map (yaw not 0) is not supported; rotate the images instead");
  }
  return {map.number(value[0], "origin x"), map.number(value[1], "origin y")};
}

bool read_flag(const Section& map, const char* key) {
  const YAML::Node value = map.at(key);
  const std::string text = value.IsScalar() ? value.Scalar() : "";
  if (text != "0" && text != "1" && text != "false" && text != "true") {
    map.fail(value, std::string("'") + key + "' must be 0 or 1");
  }
  return text == "1" || text == "true";
}

/// Darkness (or brightness, if negated) at which a pixel is occupied or free.
struct Thresholds {
  double occupied;
  double free;
  bool negate;
  bool graded;
};

Thresholds read_thresholds(const Section& map) {
  Thresholds t{map.number("occupied_thresh"), map.number("free_thresh"), read_flag(map, "negate"), false};
  if (t.free < 0 || t.occupied > 1 || t.free > t.occupied) {
    map.fail(map.at("free_thresh"), "thresholds must satisfy 0 <= free_thresh <= occupied_thresh <= 1");
  }
  if (map.has("mode")) {
    const YAML::Node mode = map.at("mode");
    const std::string text = mode.IsScalar() ? mode.Scalar() : "";
    if (text != "trinary" && text != "scale") map.fail(mode, "'mode' must be trinary or scale");
    t.graded = text == "scale";
  }
  return t;
}

/// Pixel of the image (rows from the north) that shows a cell (rows from the south).
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

void fill_elevation(SiteLayers& layers, const Grid& grid, const Section& section) {
  const double low = section.number("min");
  const double high = section.number("max");
  if (high < low) section.fail(section.at("max"), "'max' must not be below 'min', metres");
  const GreyImage image = read_pgm(section.image("image"));
  if (image.width != grid.columns || image.height != grid.rows) {
    section.fail(section.at("image"), "the elevation image has " + std::to_string(image.width) + " x " +
                                          std::to_string(image.height) + " pixels, the map " +
                                          std::to_string(grid.columns) + " x " + std::to_string(grid.rows) +
                                          "; both must cover the same cells");
  }
  for (std::size_t i = 0; i < grid.cell_count(); ++i) {
    const double share = static_cast<double>(image.pixels[pixel_of(grid, grid.cell_at(i))]) / image.max_value;
    layers.elevation.push_back(static_cast<float>(low + (high - low) * share));
  }
}

YAML::Node parse(const std::filesystem::path& description) {
  try {
    return YAML::LoadFile(description.string());
  } catch (const YAML::BadFile&) {
    throw MapError(description.string() +
                   ": cannot open the map description; check the path and the permissions");
  } catch (const YAML::ParserException& e) {
    throw MapError(description.string() + ":" + std::to_string(e.mark.line + 1) + ":" +
                   std::to_string(e.mark.column + 1) + ": not YAML: " + e.msg);
  }
}

}  // namespace

Site load_site(const std::filesystem::path& description) {
  const Section map(parse(description), description,
                    {"image", "mode", "resolution", "origin", "negate", "occupied_thresh", "free_thresh",
                     "rocks", "elevation"});
  Grid grid;
  grid.resolution = read_resolution(map);
  grid.origin = read_origin(map);
  const Thresholds thresholds = read_thresholds(map);
  double max_height = 1.0;
  if (map.has("rocks")) {
    const Section rocks = map.section("rocks", {"max_height"});
    max_height = rocks.number("max_height");
    if (max_height <= 0) rocks.fail(rocks.at("max_height"), "'max_height' must be positive, metres");
  }
  const GreyImage image = read_pgm(map.image("image"));
  grid.columns = image.width;
  grid.rows = image.height;

  SiteLayers layers;
  fill_rocks(layers, grid, image, thresholds, max_height);
  if (map.has("elevation")) {
    fill_elevation(layers, grid, map.section("elevation", {"image", "min", "max"}));
  } else {
    layers.elevation.assign(grid.cell_count(), 0.0F);
  }
  return Site(grid, std::move(layers));
}

}  // namespace roci::terrain
