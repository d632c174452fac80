#include "sim_svc/scenario/soil_file.hpp"

#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/mission/bounded_number.hpp"
#include "core/terrain/polygon_file.hpp"
#include "sim_svc/scenario/file_values.hpp"
#include "sim_svc/setup/roster_file.hpp"
#include "sim_svc/setup/settings.hpp"

namespace roci::sim::scenario {
namespace {

using mission::Entry;
using world::ScatteredSoil;
using world::Soil;
using world::SoilArea;
using world::SoilLayer;

constexpr int kMostScattered = 1000;  // of one entry

double within(const Entry& section, std::string_view key, double fallback, double least, double most) {
  return mission::bounded_number(section.find(key), key, fallback, least, most);
}

Soil read_one(const Entry& entry) {
  entry.allow_only({"n", "k_c", "k_phi", "cohesion_pa", "friction_deg", "shear_m"});
  Soil out;
  out.exponent = within(entry, "n", out.exponent, 0.1, 2);
  out.cohesive_modulus = within(entry, "k_c", out.cohesive_modulus, 0, 1e9);
  out.frictional_modulus = within(entry, "k_phi", out.frictional_modulus, 1, 1e9);
  out.cohesion_pa = within(entry, "cohesion_pa", out.cohesion_pa, 0, 1e6);
  out.friction_deg = within(entry, "friction_deg", out.friction_deg, 1, 60);
  out.shear_m = within(entry, "shear_m", out.shear_m, 1e-4, 1);
  return out;
}

SoilArea read_disc(const Entry& entry) {
  const world::Rock disc = read_rock(entry);
  return {"", {disc.x, disc.y}, disc.radius, {}};
}

std::pair<double, double> read_range(const Entry& entry) {
  const std::vector<Entry> ends = entry.items();
  if (ends.size() != 2 || ends[0].number() > ends[1].number())
    entry.fail("is a range [from, to] of two numbers, the lower one first; correct it");
  return {ends[0].number(), ends[1].number()};
}

ScatteredSoil read_scattered(const Entry& entry) {
  entry.allow_only({"soil", "count", "radius", "x", "y", "clear_of"});
  ScatteredSoil out;
  out.soil = entry.at("soil").text();
  out.count = static_cast<int>(within(entry, "count", 1, 0, kMostScattered));
  if (const auto radius = entry.find("radius")) {
    std::tie(out.least_radius, out.most_radius) = read_range(*radius);
    if (out.least_radius <= 0) radius->fail("a radius must be above 0; correct the number");
  }
  std::tie(out.south_west.x, out.north_east.x) = read_range(entry.at("x"));
  std::tie(out.south_west.y, out.north_east.y) = read_range(entry.at("y"));
  if (const auto discs = entry.find("clear_of"))
    discs->each([&](const Entry& disc) { out.clear_of.push_back(read_disc(disc)); });
  return out;
}

}  // namespace

SoilArea read_soil_area(const Entry& entry) {
  SoilArea out;
  out.soil = entry.at("soil").text();
  if (const auto outline = entry.find("outline")) {
    entry.allow_only({"soil", "outline"});
    out.outline = terrain::read_polygon(*outline);
    return out;
  }
  entry.allow_only({"soil", "x", "y", "radius"});
  out.centre = {entry.at("x").number(), entry.at("y").number()};
  out.radius = at_least(entry.at("radius"), 0.01);
  return out;
}

void check_soil(const std::string& name, const Entry& where, const SoilLayer& layer) {
  if (layer.soils.contains(name)) return;
  std::vector<std::string> known;
  for (const auto& [one, soil] : layer.soils) known.push_back(one);
  where.complain("no soil '" + name + "'; known: " + setup::known_names(name, known) +
                 "; name another, or describe it under soils");
}

void read_soil(const Entry& surface, SoilLayer& layer) {
  if (const auto soils = surface.find("soils"))
    soils->each_field([&](const std::string& name, const Entry& one) { layer.soils[name] = read_one(one); });
  if (const auto areas = surface.find("soil_areas")) {
    layer.areas.clear();
    areas->each([&](const Entry& one) {
      SoilArea area = read_soil_area(one);
      check_soil(area.soil, one.at("soil"), layer);
      layer.areas.push_back(std::move(area));
    });
  }
  if (const auto scattered = surface.find("scattered_soil")) {
    layer.scattered.clear();
    scattered->each([&](const Entry& one) {
      ScatteredSoil some = read_scattered(one);
      check_soil(some.soil, one.at("soil"), layer);
      layer.scattered.push_back(std::move(some));
    });
  }
}

}  // namespace roci::sim::scenario
