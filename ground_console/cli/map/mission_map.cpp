#include "ground_console/cli/map/mission_map.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "core/mission/mission_file.hpp"
#include "core/terrain/polygon_file.hpp"
#include "core/terrain/site_file.hpp"

namespace roci::console::cli::map {
namespace {

std::optional<double> number_of(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

void read_zones(const mission::Entry& rover, MissionMap& map) {
  const auto zones = rover.find("keep_out");
  if (!zones) return;
  for (const mission::Entry& zone : zones->items()) {
    if (zone.find("polygon")) {
      map.keep_out.push_back(terrain::read_polygon(zone));
    } else {
      map.keep_out_discs.push_back(
          {{zone.at("x").number(), zone.at("y").number()}, zone.at("radius_m").number()});
    }
  }
}

// An object whose place follows a timeline has none that a map could show.
void read_places(const mission::Entry& root, MissionMap& map) {
  const auto objects = root.find("objects");
  if (!objects) return;
  for (const mission::Entry& object : objects->items()) {
    const auto properties = object.find("properties");
    if (!properties || !properties->is_mapping()) continue;
    const auto x = properties->find("x"), y = properties->find("y");
    if (!x || !y || x->is_mapping() || y->is_mapping()) continue;
    const auto east = number_of(x->text()), north = number_of(y->text());
    if (east && north) add_place(map.places, {object.at("name").text(), {*east, *north}});
  }
}

// Of an activity of a plan, "p1.1-drive [5,5] to=place-soil x=80 y=75": the place that it names by x and y.
std::optional<NamedPlace> place_of(const std::string& activity) {
  std::istringstream words(activity);
  std::optional<double> x, y;
  std::string name;
  for (std::string word; words >> word;) {
    const auto equals = word.find('=');
    if (equals == std::string::npos) continue;
    const std::string key = word.substr(0, equals), value = word.substr(equals + 1);
    if (key == "x") {
      x = number_of(value);
    } else if (key == "y") {
      y = number_of(value);
    } else if (name.empty()) {
      name = value;
    }
  }
  if (!x || !y) return std::nullopt;
  return NamedPlace{name, {*x, *y}};
}

// Reads "NAME VERSION origin TIME; ACTIVITY; ACTIVITY; …".
std::vector<NamedPlace> places_of_plan(const std::string& text) {
  std::vector<NamedPlace> out;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ';');) {
    if (const auto place = place_of(part)) out.push_back(*place);
  }
  return out;
}

// Puts coordinates that were observed at the same time together, each robot's into its way.
class Steps {
 public:
  explicit Steps(std::map<std::string, Way>& ways) : ways_(ways) {}

  void observe(const std::string& time, const std::string& timeline, std::optional<double> number) {
    const bool east = timeline.ends_with(".x");
    if (!number || timeline.size() < 3 || (!east && !timeline.ends_with(".y"))) return;
    const std::string robot = timeline.substr(0, timeline.size() - 2);
    Newest& newest = newest_[robot];
    if (newest.time != time) keep(robot, newest);
    newest.time = time;
    (east ? newest.x : newest.y) = number;
  }

  void finish() {
    for (auto& [robot, newest] : newest_) keep(robot, newest);
  }

 private:
  struct Newest {
    std::string time;
    std::optional<double> x, y;
  };

  void keep(const std::string& robot, const Newest& newest) {
    if (!newest.x || !newest.y) return;
    Way& way = ways_[robot];
    const terrain::Point at{*newest.x, *newest.y};
    if (way.empty() || way.back() != at) way.push_back(at);
  }

  std::map<std::string, Way>& ways_;
  std::map<std::string, Newest> newest_;
};

}  // namespace

void add_place(std::vector<NamedPlace>& places, const NamedPlace& place) {
  for (NamedPlace& known : places) {
    if (terrain::distance(known.at, place.at) > 0.5) continue;
    if (known.name.find(place.name) == std::string::npos) known.name += ", " + place.name;
    return;
  }
  places.push_back(place);
}

MissionMap read_mission_map(const std::filesystem::path& folder_or_file) {
  const mission::Entry root = mission::load_mission_file(folder_or_file);
  const auto site = root.find("site");
  if (!site) {
    throw std::invalid_argument(root.file().string() +
                                " has no 'site': there is no ground of which a map could be drawn");
  }
  MissionMap map{terrain::load_site(site->resolve(site->text())), root.text_or("name", "mission")};
  map.keep_out = map.site.keep_out();
  if (const auto rover = root.find("rover")) read_zones(*rover, map);
  read_places(root, map);
  return map;
}

void add_trace(std::istream& trace, MissionMap& map) {
  Steps steps(map.driven);
  std::vector<NamedPlace> goals;  // of the newest plan
  std::map<std::string, std::size_t> driven_at_plan;
  for (std::string line; std::getline(trace, line);) {
    std::istringstream words(line);
    std::string time, kind, name, value;
    words >> time >> kind;
    if (kind == "plan") {
      std::string rest;
      std::getline(words, rest);
      goals = places_of_plan(rest);
      for (const NamedPlace& place : goals) add_place(map.places, place);
      steps.finish();
      driven_at_plan.clear();
      for (const auto& [robot, way] : map.driven) driven_at_plan[robot] = way.size();
    }
    if (kind == "observation" && words >> name >> value) steps.observe(time, name, number_of(value));
  }
  steps.finish();
  // The plan leads from where its robot stood; of several robots nobody knows whose it is.
  Way legs;
  if (map.driven.size() == 1 && !goals.empty()) {
    const Way& way = map.driven.begin()->second;
    const std::size_t passed = driven_at_plan[map.driven.begin()->first];
    legs.push_back(way[std::min(passed == 0 ? 0 : passed - 1, way.size() - 1)]);
  }
  for (const NamedPlace& place : goals) legs.push_back(place.at);
  if (legs.size() > 1) map.planned_legs.push_back(legs);
}

}  // namespace roci::console::cli::map
