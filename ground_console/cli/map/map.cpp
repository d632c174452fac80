#include "ground_console/cli/map/map.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "core/mission/mission_file.hpp"
#include "core/mission/service_list.hpp"
#include "core/terrain/map_error.hpp"
#include "ground_console/cli/map/draw_map.hpp"
#include "ground_console/cli/map/png_file.hpp"
#include "ground_console/cli/map/run_folder.hpp"
#include "ground_console/cli/map/run_picture.hpp"
#include "ground_console/cli/report.hpp"
#include "ground_console/cli/timelines.hpp"
#include "ground_console/cli/verbs.hpp"
#include "services/process/mission_folder.hpp"

namespace roci::console::cli::map {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kPathPlanner = "pathplan_svc";

std::optional<double> number_of(const std::vector<v1::Property>& arguments, const std::string& name) {
  for (const v1::Property& argument : arguments) {
    if (argument.name() != name) continue;
    const std::string& text = argument.value();
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && end == text.data() + text.size() && std::isfinite(value)) return value;
  }
  return std::nullopt;
}

std::optional<terrain::Point> point_of(const std::vector<v1::Property>& arguments) {
  const auto x = number_of(arguments, "x"), y = number_of(arguments, "y");
  if (!x || !y) return std::nullopt;
  return terrain::Point{*x, *y};
}

// The places that the plan still leads to, in the order in which it names them.
Way places_ahead(const lib::MissionView& view) {
  Way out;
  if (view.plan() == nullptr) return out;
  for (const v1::PlanActivity& activity : view.plan()->activities()) {
    const v1::StepStatus* step = view.step(activity.id());
    const bool over = step != nullptr && step->state() > v1::ACTIVITY_RUNNING;
    if (over) continue;
    for (const v1::PlanCommand& command : activity.commands()) {
      if (const auto at = point_of(command.arguments())) out.push_back(*at);
    }
  }
  return out;
}

// Asks the path planner for the ways that the plan leads along; a leg for which it has none is straight.
void add_planned(lib::Client& client, MissionMap& map) {
  const Way ahead = places_ahead(client.view());
  const auto& ways = client.view().ways();
  if (ahead.empty() || ways.size() != 1) return;
  terrain::Point from{ways.begin()->second.back().x_m, ways.begin()->second.back().y_m};
  for (const terrain::Point to : ahead) {
    std::string why;
    const auto reply =
        client.find_path({from.x, from.y}, {to.x, to.y}, kPathPlanner, std::chrono::seconds(3), why);
    if (reply && reply->outcome() == v1::MOTION_FOUND) {
      Way way;
      for (const v1::Pose2& pose : reply->waypoints()) way.push_back({pose.x_m(), pose.y_m()});
      map.planned.push_back(std::move(way));
    } else {
      map.planned_legs.push_back({from, to});
    }
    from = to;
  }
}

void add_view(const lib::MissionView& view, MissionMap& map) {
  for (const auto& [id, hazard] : view.hazards()) {
    if (!hazard.cleared()) map.hazards.push_back({{hazard.x_m(), hazard.y_m()}, hazard.radius_m()});
  }
  for (const auto& [key, status] : view.goals()) {
    const v1::Goal* goal = view.goal(key);
    if (goal == nullptr) continue;
    if (const auto at = point_of(goal->arguments())) add_place(map.places, {key.second, *at});
  }
}

// What the maps of robots have now, as their path planners tell it.
void add_known(const lib::MissionView& view, MissionMap& map) {
  for (const auto& [planner, known] : view.maps()) {
    const auto own = map.known.find(known.header().robot());
    if (own == map.known.end()) continue;
    for (const v1::MapObstacle& one : known.obstacles()) {
      const Circle disc{{one.x_m(), one.y_m()}, one.radius_m()};
      const bool usable = std::isfinite(disc.centre.x) && std::isfinite(disc.centre.y) &&
                          std::isfinite(disc.radius) && disc.radius >= 0;
      if (!one.cleared() && usable)
        own->second.push_back({disc, lib::name_of(one.obstacle_kind()), one.found_by(), one.id()});
    }
  }
}

// What its plan is still to bring about.
void add_planned_course(const lib::MissionView& view, Course& course) {
  std::map<std::string, Changes> ahead;
  std::int64_t until = view.now_us();
  for (const auto& [timeline, changes] : timelines_of(view, {})) {
    for (const temporal::ProjectedChange& change : changes) {
      if (change.kind != temporal::ProjectionKind::projected || change.time.count() <= view.now_us() ||
          !std::holds_alternative<temporal::State>(change.value))
        continue;
      ahead[timeline].emplace_back(change.time.count(), temporal::to_text(change.value));
      until = std::max<std::int64_t>(until, change.time.count());
    }
  }
  for (const auto& [timeline, changes] : ahead) add_planned(timeline, changes, until, course);
}

// What the mission's files say; a mission without ground is drawn where timelines are asked for, too.
RunPicture picture_of_mission(const fs::path& mission, const MapArguments& arguments) {
  const mission::Entry root = mission::load_mission_file(mission);
  RunPicture out{root.text_or("name", "mission")};
  if (root.find("site") || !arguments.png.empty()) out.map = read_mission_map(mission);
  if (!fs::is_directory(mission)) return out;
  const mission::ServiceList services = mission::load_service_list_if_any(mission);
  out.robots = services.robots;
  if (out.map)
    for (const auto& [planner, robot] : map_owners(services)) out.map->known[robot];
  return out;
}

void add_trace(const std::string& trace, RunPicture& picture) {
  std::istringstream lines(trace), again(trace);
  if (picture.map) add_trace(lines, *picture.map);
  picture.course = course_of(again);
}

RunPicture picture_of_live_run(const services::process::ConnectionFlags& flags,
                               const MapArguments& arguments) {
  const auto run = lib::local_run(flags);
  const services::process::Connection connection = lib::choose_run(flags);
  if (arguments.mission.empty() && (!run || run->mission.empty()))
    throw std::invalid_argument("the mission's files are not on this machine; add --mission FOLDER");
  RunPicture out = picture_of_mission(
      arguments.mission.empty() ? run->mission : services::process::mission_folder(arguments.mission),
      arguments);
  lib::Client client(connection);
  if (!client.wait_for_mission(kAnswerLimit))
    throw std::runtime_error("no mission answered; is it running there (roci status)?");
  client.wait([&] { return client.view().plan() != nullptr; }, std::chrono::milliseconds(1000));
  client.settle();
  out.subtitle = "now " + lib::clock_text(client.view().now_us());
  // The journal of a run on this machine has the way from its start; what came down begins when this tool joined.
  const auto trace = run ? trace_of(run->run_folder) : std::nullopt;
  if (trace) add_trace(*trace, out);
  add_planned_course(client.view(), out.course);
  if (!out.map) return out;
  if (trace) out.map->planned_legs.clear();
  for (const auto& [robot, way] : client.view().ways()) {
    Way& driven = out.map->driven[robot];
    for (const lib::Place& place : way) {
      if (driven.empty() || (driven.back() != terrain::Point{place.x_m, place.y_m} && !trace))
        driven.push_back({place.x_m, place.y_m});
    }
  }
  add_view(client.view(), *out.map);
  add_known(client.view(), *out.map);
  add_planned(client, *out.map);
  return out;
}

RunPicture picture_of(const MapArguments& arguments, const services::process::ConnectionFlags& flags) {
  if (!arguments.run.empty()) {
    const fs::path run = fs::absolute(arguments.run);
    const fs::path mission =
        arguments.mission.empty() ? mission_of(run) : services::process::mission_folder(arguments.mission);
    RunPicture out = picture_of_mission(mission, arguments);
    const auto trace = trace_of(run);
    if (!trace)
      throw std::invalid_argument(
          run.string() + ": roci-trace cannot read this run; name a run folder that roci runs lists");
    add_trace(*trace, out);
    if (out.map && fs::is_directory(mission))
      add_hazards(run, map_owners(mission::load_service_list_if_any(mission)), *out.map);
    out.subtitle = words_of_summary(run);
    return out;
  }
  const bool says_where_to_join =
      flags.domain || flags.dds || flags.address || flags.peers || flags.network || flags.secure;
  if (!arguments.mission.empty() && !says_where_to_join) {
    RunPicture out = picture_of_mission(services::process::mission_folder(arguments.mission), arguments);
    out.subtitle = "the mission, no run";
    return out;
  }
  return picture_of_live_run(flags, arguments);
}

json counts_of(const std::string& file, const MissionMap& map) {
  json driven = json::object();
  for (const auto& [robot, way] : map.driven) driven[robot] = way.size();
  return {{"file", file},
          {"places", map.places.size()},
          {"hazards", map.hazards.size()},
          {"planned", map.planned.size() + map.planned_legs.size()},
          {"driven", driven}};
}

void write_map(const std::string& file, const MissionMap& map, bool as_json) {
  const Picture picture = draw_map(map);
  write_png(picture, file);
  if (as_json) {
    json told = counts_of(file, map);
    told["width"] = picture.width();
    told["height"] = picture.height();
    std::cout << json_text(told) << "\n";
  } else {
    const auto counted = [](std::size_t count, const std::string& what) {
      return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
    };
    std::cout << file << ": " << picture.width() << " x " << picture.height() << " pixels, "
              << counted(map.places.size(), "place") << ", " << counted(map.hazards.size(), "hazard") << "\n";
  }
}

void write_svg(const std::string& file, const RunPicture& picture, bool as_json) {
  std::ofstream out(file, std::ios::binary);
  if (!(out << to_svg(picture) << std::flush))
    throw std::runtime_error(file + ": cannot be written; check the folder and its permissions");
  if (as_json) {
    json told = picture.map ? counts_of(file, *picture.map) : json{{"file", file}};
    told["timelines"] = picture.course.rows.size();
    told["plans"] = picture.course.plans.size();
    told["known"] = json::object();
    if (picture.map)
      for (const auto& [robot, obstacles] : picture.map->known) told["known"][robot] = obstacles.size();
    std::cout << json_text(told) << "\n";
  } else {
    std::cout << file << ": " << picture.course.rows.size() << " timelines, " << picture.course.plans.size()
              << (picture.course.plans.size() == 1 ? " plan" : " plans") << (picture.map ? "" : ", no ground")
              << "\n";
  }
}

}  // namespace

int show_map(const MapArguments& arguments, const services::process::ConnectionFlags& connection,
             bool as_json) {
  if (arguments.png.empty() && arguments.svg.empty()) {
    std::cerr << "roci: name the file to write: roci map --png FILE or --svg FILE\n";
    return kBadUsage;
  }
  std::optional<RunPicture> picture;
  try {
    picture = picture_of(arguments, connection);
  } catch (const mission::FileError& error) {
    std::cerr << "roci: " << error.what() << "\n";
    return kBadUsage;
  } catch (const terrain::MapError& error) {
    std::cerr << "roci: " << error.what() << "\n";
    return kBadUsage;
  }
  if (picture->map) {
    picture->map->subtitle = picture->subtitle;
    std::vector<std::string>& robots = picture->robots;
    for (const auto& [robot, way] : picture->map->driven)
      if (std::ranges::find(robots, robot) == robots.end()) robots.push_back(robot);
  }
  join_families(picture->course);
  sort_by_robot(picture->robots, picture->course);
  try {
    if (!arguments.png.empty()) write_map(arguments.png, *picture->map, as_json);
    if (!arguments.svg.empty()) write_svg(arguments.svg, *picture, as_json);
  } catch (const std::runtime_error& error) {
    std::cerr << "roci: " << error.what() << "\n";
    return kRefused;
  }
  return kDone;
}

}  // namespace roci::console::cli::map
