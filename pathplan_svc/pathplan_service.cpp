#include "pathplan_svc/pathplan_service.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "core/durable/durable_file.hpp"
#include "core/mission/mission_file.hpp"
#include "core/mission/service_list.hpp"
#include "core/terrain/site_file.hpp"
#include "pathplan_svc/limits.hpp"
#include "pathplan_svc/map_exchange_service.hpp"
#include "pathplan_svc/map_file.hpp"
#include "pathplan_svc/rover_file.hpp"
#include "pathplan_svc/wire_service.hpp"
#include "services/bounds/tally.hpp"
#include "services/node/make_event.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "services/worker.hpp"

namespace roci::pathplan {
namespace {

namespace topics = services::topics;

// The planner belongs to the worker: questions and changes of the map reach it in the order of the loop,
// so each answer stands on the map as it was when the question came.
class PathplanService : public services::Service {
 public:
  PathplanService(services::Node& node, const terrain::Site& site, const Rover& rover, const MapSettings& map,
                  const Team& team, const std::filesystem::path& run_folder)
      : node_(node),
        hazard_file_(run_folder.empty() ? run_folder : run_folder / (node.options().name + ".hazards")),
        keep_out_(rover.keep_out),
        planner_(site, rover.limits, rover.drive, settings_of(map, node.options().incarnation),
                 rover.keep_out_polygons),
        offers_(services::advertise(node, topics::function_offer)),
        events_(services::advertise(node, topics::event)),
        exchange_(node, map, planner_.map().grid(), team, host()),
        worker_(node) {
    planner_.set_discs(keep_out_);
    report_holes();
    offers_.write(function_offer(node.options().name, planner_.map().version()));
    services::subscribe(node, topics::hazard, [this](const v1::Hazard& hazard) { on_hazard(hazard); });
    services::serve(node, topics::function_call, [this](const v1::FunctionRequest& request, auto responder) {
      if (request.module_name() == kModule) on_function_call(request, responder);
    });
    services::serve(node, topics::path_request, [this](const v1::PathRequest& request, auto responder) {
      worker_.compute(
          [this, request, forget = is_time_to_forget()](const std::stop_token&) {
            if (forget) planner_.forget_unasked();
            return find_path(planner_, request);
          },
          [responder](v1::PathReply reply) { responder.reply(std::move(reply)); });
    });
  }

 private:
  // Returns true once in each kUnaskedFor, with a question: without questions nothing is added.
  bool is_time_to_forget() {
    if (node_.now() < forgot_at_ + kUnaskedFor) return false;
    forgot_at_ = node_.now();
    return true;
  }

  // Who is told a map and its version may have heard of an earlier life.
  static PlannerSettings settings_of(const MapSettings& map, std::uint32_t incarnation) {
    PlannerSettings out;
    if (map.sharing != MapSharing::never)
      out.first_version = (std::max(incarnation, 1U) - 1) * kVersionsOfALife + 1;
    return out;
  }

  MapExchange::Host host() {
    return {[this] { return map_changes_ >= kMapChanges; }, [this] { update_map(); },
            [this](std::function<void(std::uint64_t)> then) {
              worker_.compute([this](const std::stop_token&) { return planner_.map().version(); },
                              std::move(then));
            }};
  }

  void on_function_call(const v1::FunctionRequest& request,
                        services::Responder<v1::FunctionReply> responder) {
    worker_.compute(
        [this, request, forget = is_time_to_forget()](const std::stop_token& stop) {
          if (forget) planner_.forget_unasked();
          return evaluate(planner_, request, stop);
        },
        [this, responder](FunctionAnswer answer) {
          report_unusable(answer.unusable_places);
          answer.reply.owner(node_.options().name);
          answer.reply.computed_us(node_.now().count());
          responder.reply(std::move(answer.reply));
        });
  }

  void report_holes() {
    const std::size_t unknown = planner_.map().unknown_cells();
    if (unknown == 0) return;
    const std::string cells = std::to_string(unknown);
    report(v1::SEVERITY_WARNING, "map.unknown",
           "the map does not know " + cells + " of its " +
               std::to_string(planner_.map().grid().cell_count()) +
               " cells; no path leads over them, and what lies behind them is not known to be unreachable",
           {{"cells", cells}});
  }

  // Each place is told once per map, although every replanning asks again.
  void report_unusable(const std::map<std::string, std::string>& places) {
    for (const auto& [place, why] : places) {
      if (reported_.size() >= kReportedPlaces || !reported_.insert(place + ": " + why).second) continue;
      report(v1::SEVERITY_WARNING, "place.unusable", place + ": " + why, {{"place", place}});
    }
  }

  void on_hazard(const v1::Hazard& hazard) {
    const Disc disc{{hazard.x_m(), hazard.y_m()}, hazard.radius_m()};
    const bool usable = std::isfinite(disc.centre.x) && std::isfinite(disc.centre.y) &&
                        std::isfinite(disc.radius) && disc.radius >= 0;
    if (!usable && !hazard.cleared())
      return refuse(hazard, "has no finite place and radius; send x_m, y_m and radius_m in metres");
    const std::pair key{hazard.found_by(), hazard.id()};
    const bool known = hazards_.contains(key);
    if (!known && hazards_.size() >= kHazards)
      return refuse(hazard, "finds no room beside " + std::to_string(kHazards) + " others; clear some");
    if (!known && key.first.size() + key.second.size() > kNameBytes)
      return refuse(hazard, "has a name of more than " + std::to_string(kNameBytes) + " bytes");
    if (map_changes_ >= kMapChanges)
      return refuse(hazard,
                    "comes while " + std::to_string(kMapChanges) + " changes of the map wait; send it again");
    if (hazard.cleared()) {
      if (!known) return;
      hazards_.erase(key);
    } else {
      hazards_[key] = disc;
    }
    update_map();
  }

  // Told the first time, the tenth, the hundredth and so on, whatever the reasons.
  void refuse(const v1::Hazard& hazard, const std::string& why) {
    const std::uint64_t count = refusals_.note("hazard");
    if (count == 0) return;
    const std::string id = hazard.id().substr(0, kNameBytes);
    report(v1::SEVERITY_WARNING, "hazard.refused",
           "hazard " + id + " " + why + (count > 1 ? " (" + std::to_string(count) + " refused so far)" : ""),
           {{"hazard", id}});
  }

  void update_map() {
    std::vector<Disc> discs = keep_out_;
    for (const auto& [key, disc] : hazards_) discs.push_back(disc);
    for (const Disc& disc : exchange_.discs()) discs.push_back(disc);
    const std::size_t count = discs.size() - keep_out_.size();
    ++map_changes_;
    worker_.compute(
        [this, discs = std::move(discs)](const std::stop_token&) {
          const bool changed = planner_.set_discs(discs);
          return std::pair{changed, planner_.map().version()};
        },
        [this, count](std::pair<bool, std::uint64_t> update) {
          const auto [changed, version] = update;
          if (--map_changes_ == 0 && !hazard_file_.empty()) write_hazards();  // once for a burst of them
          if (!changed) return;
          reported_.clear();
          offers_.write(function_offer(node_.options().name, version));
          report(v1::SEVERITY_INFO, "map.changed",
                 "the map has version " + std::to_string(version) + " with " + std::to_string(count) +
                     " hazards",
                 {{"map_version", std::to_string(version)}});
        });
  }

  // For who looks at the run when it is over; a file that cannot be written stops no drive.
  void write_hazards() const {
    nlohmann::json hazards = nlohmann::json::array();
    for (const auto& [key, disc] : hazards_)
      hazards.push_back({{"found_by", key.first},
                         {"id", key.second},
                         {"x_m", disc.centre.x},
                         {"y_m", disc.centre.y},
                         {"radius_m", disc.radius}});
    for (const FoundObstacle& one : exchange_.obstacles()) {
      if (one.cleared) continue;
      hazards.push_back({{"found_by", one.finder},
                         {"id", one.id},
                         {"kind", one.kind == ObstacleKind::soil ? "soil" : "rock"},
                         {"found_s", temporal::to_seconds(one.found)},
                         {"x_m", one.disc.centre.x},
                         {"y_m", one.disc.centre.y},
                         {"radius_m", one.disc.radius}});
    }
    try {
      durable::replace_file(hazard_file_,
                            hazards.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n",
                            durable::Durability::process);
    } catch (const std::system_error&) {
      return;  // The next hazard writes all of them again.
    }
  }

  void report(v1::Severity severity, const std::string& code, const std::string& text,
              const std::vector<std::pair<std::string, std::string>>& properties) {
    events_.write(services::node::make_event(severity, code, text, properties));
  }

  services::Node& node_;
  const std::filesystem::path hazard_file_;  // docs/formats.md; empty: none is kept
  std::vector<Disc> keep_out_;
  std::map<std::pair<std::string, std::string>, Disc> hazards_;  // by finder and id
  std::set<std::string> reported_;
  services::bounds::Tally refusals_;
  temporal::Time forgot_at_{};   // mission time
  std::size_t map_changes_ = 0;  // that the worker has not made yet
  PathPlanner planner_;          // from the constructor's end on: the worker's alone
  services::Publisher<v1::FunctionOffer> offers_;
  services::Publisher<v1::Event> events_;
  MapExchange exchange_;
  services::Worker worker_;
};

}  // namespace

std::unique_ptr<services::Service> make_service(services::Node& node, const services::RunSettings& settings) {
  const mission::Entry mission = mission::load_mission_file(settings.mission_file());
  const mission::Entry site = mission.at("site");
  const auto rover = mission.find("rover");
  const auto map = mission.find("map");
  const MapSettings map_settings = map ? read_map_settings(*map) : MapSettings{};
  if (map && node.options().robot.empty())
    map->fail(
        "only the path planner of a robot tells of its map; name its robot in services, or drop the key");
  const mission::ServiceList list = mission::load_service_list_if_any(settings.mission);
  const mission::ServiceEntry* own = list.find(node.options().name);
  Team team;
  for (const mission::ServiceEntry& one : list.services) {
    team.robots.emplace(one.name, one.robot);
    if (own && one.program == own->program && !one.robot.empty()) team.planners.push_back(one.name);
  }
  const Rover limits = rover ? read_rover(*rover) : Rover{};
  const terrain::Site ground = terrain::load_site(site.resolve(site.text()));
  require_few_cells(limits, ground.grid(), mission);
  return std::make_unique<PathplanService>(node, ground, limits, map_settings, team, settings.run_folder);
}

}  // namespace roci::pathplan
