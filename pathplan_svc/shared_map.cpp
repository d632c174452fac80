#include "pathplan_svc/shared_map.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace roci::pathplan {
namespace {

// Later words win; at one time it must only be the same one for all.
auto rank(const FoundObstacle& one) {
  return std::tuple(one.found, one.cleared, one.kind, one.disc.centre.x, one.disc.centre.y, one.disc.radius);
}

}  // namespace

SharedMap::SharedMap(std::string robot, const terrain::Grid& grid, std::map<std::string, std::string> team)
    : robot_(std::move(robot)), grid_(grid), team_(std::move(team)) {}

Intake SharedMap::find(const FoundObstacle& found) {
  if (!robot_.empty() && found.finder != robot_)
    return {"it is '" + found.finder + "' that found it; a robot sees for itself alone"};
  if (std::string fault = fault_of(found); !fault.empty()) return {std::move(fault)};
  if (!known_.contains({found.finder, found.id}) && known_.size() >= kMost)
    return {"it finds no room beside " + std::to_string(kMost) + " others"};
  return {"", merge(found)};
}

Intake SharedMap::take(const MapPatch& patch) {
  const auto author = team_.find(patch.author);
  if (author == team_.end() || author->second.empty() || author->second != patch.robot)
    return {
        "its author is no service of the team's robots; add it to the mission's services, with its robot"};
  const auto newest = newest_.find(patch.author);
  if (newest != newest_.end() && patch.number < newest->second.number)
    return {"a newer one of the same author is known"};
  std::set<Key> keys;
  for (const auto& [key, one] : known_) keys.insert(key);
  for (const FoundObstacle& one : patch.obstacles) {
    if (std::string fault = fault_of(one); !fault.empty())
      return {"'" + one.id.substr(0, kNameBytes) + "': " + fault};
    keys.emplace(one.finder, one.id);
  }
  if (patch.obstacles.size() > kMost || keys.size() > kMost)
    return {"with it more than " + std::to_string(kMost) + " obstacles would be known"};
  newest_[patch.author] = {patch.number, patch.map_version, patch.told};
  Intake out;
  for (const FoundObstacle& one : patch.obstacles)
    if (robot_.empty() || one.finder != robot_) out.changed = merge(one) || out.changed;
  return out;
}

const TakenPatch* SharedMap::newest(const std::string& author) const {
  const auto found = newest_.find(author);
  return found == newest_.end() ? nullptr : &found->second;
}

std::string SharedMap::fault_of(const FoundObstacle& one) const {
  if (one.finder.empty() || one.id.empty() || one.finder.size() > kNameBytes || one.id.size() > kNameBytes)
    return "finder and id must have 1 to " + std::to_string(kNameBytes) + " bytes";
  const auto& [centre, radius] = one.disc;
  if (!std::isfinite(centre.x) || !std::isfinite(centre.y) || !std::isfinite(radius) || radius <= 0)
    return "it has no finite place and radius; send x_m, y_m and radius_m in metres";
  const terrain::Point nearest{std::clamp(centre.x, grid_.origin.x, grid_.origin.x + grid_.width()),
                               std::clamp(centre.y, grid_.origin.y, grid_.origin.y + grid_.height())};
  if (terrain::distance(centre, nearest) > radius) return "it lies off the map; send metres of the map frame";
  if (radius > std::max(grid_.width(), grid_.height())) return "it is larger than the map";
  return "";
}

bool SharedMap::merge(const FoundObstacle& one) {
  const auto [place, fresh] = known_.try_emplace({one.finder, one.id}, one);
  if (fresh) return !one.cleared;
  if (rank(one) <= rank(place->second)) return false;
  const FoundObstacle before = std::exchange(place->second, one);
  return before.cleared != one.cleared || (!one.cleared && before.disc != one.disc);
}

std::vector<FoundObstacle> SharedMap::all() const {
  std::vector<FoundObstacle> out;
  for (const auto& [key, one] : known_) out.push_back(one);
  return out;
}

std::vector<Disc> SharedMap::discs() const {
  std::vector<Disc> out;
  for (const auto& [key, one] : known_)
    if (!one.cleared) out.push_back(one.disc);
  return out;
}

}  // namespace roci::pathplan
