#include "sim_svc/scenario/surface_file.hpp"

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "core/words/nearest_word.hpp"
#include "sim_svc/scenario/soil_file.hpp"

namespace roci::sim::scenario {
namespace {

using mission::Entry;
using world::Look;

constexpr std::array<std::pair<std::string_view, Look>, 4> kLooks{
    {{"bright", Look::bright}, {"dark", Look::dark}, {"layered", Look::layered}, {"spotted", Look::spotted}}};

void take(const Entry& section, std::string_view key, double least, double most, double& out) {
  const auto entry = section.find(key);
  if (!entry) return;
  const double value = entry->number();
  if (value < least || value > most) {
    entry->fail("'" + std::string(key) + "' must lie between " + std::to_string(least) + " and " +
                std::to_string(most) + "; correct the number");
  }
  out = value;
}

void read_sun(const Entry& entry, world::Sun& sun) {
  entry.allow_only({"azimuth_deg", "elevation_deg", "day_s", "noon_s", "latitude_deg"});
  take(entry, "azimuth_deg", -360, 360, sun.azimuth_deg);
  take(entry, "elevation_deg", -90, 90, sun.elevation_deg);
  take(entry, "day_s", 0, 1e9, sun.day_s);
  take(entry, "noon_s", -1e9, 1e9, sun.noon_s);
  take(entry, "latitude_deg", -90, 90, sun.latitude_deg);
}

Look read_look(const Entry& entry) {
  const std::string word = entry.text();
  std::string known;
  for (const auto& [name, look] : kLooks) {
    if (name == word) return look;
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  entry.fail("an odd target is no '" + word + "'; known: " + known +
             words::did_you_mean(word, {"bright", "dark", "layered", "spotted"}));
}

world::Oddity read_oddity(const Entry& entry) {
  entry.allow_only({"x", "y", "radius", "look"});
  world::Oddity out{entry.at("x").number(), entry.at("y").number(), 0.8, Look::bright};
  take(entry, "radius", 0.05, 20, out.radius);
  if (const auto look = entry.find("look")) out.look = read_look(*look);
  return out;
}

}  // namespace

void read_surface(const Entry& entry, world::Surface& surface) {
  entry.allow_only({"sun", "odd_per_hectare", "odd", "soils", "soil_areas", "scattered_soil"});
  if (const auto sun = entry.find("sun")) read_sun(*sun, surface.sun);
  take(entry, "odd_per_hectare", 0, 100, surface.odd_per_hectare);
  read_soil(entry, surface.soil);
  const auto odd = entry.find("odd");
  if (!odd) return;
  surface.placed.clear();
  odd->each([&](const Entry& one) { surface.placed.push_back(read_oddity(one)); });
}

}  // namespace roci::sim::scenario
