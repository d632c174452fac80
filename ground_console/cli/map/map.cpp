#include "ground_console/cli/map/map.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "core/mission/entry.hpp"
#include "core/terrain/map_error.hpp"
#include "ground_console/cli/map/draw_map.hpp"
#include "ground_console/cli/map/png_file.hpp"
#include "ground_console/cli/report.hpp"
#include "ground_console/cli/verbs.hpp"
#include "services/process/mission_folder.hpp"

namespace roci::console::cli::map {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kPathPlanner = "pathplan_svc";

// Returns what the program beside this one prints, or nothing if it fails: it reads journals, the ground tool does not.
std::optional<std::string> trace_of(const fs::path& run) {
  const fs::path program = fs::read_symlink("/proc/self/exe").parent_path() / "roci-trace";
  std::array<int, 2> pipe_ends{};
  if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) return std::nullopt;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::string name = program.string(), verb = "print", folder = run.string();
  std::array<char*, 4> words{name.data(), verb.data(), folder.data(), nullptr};
  pid_t pid = 0;
  const int failed = posix_spawn(&pid, name.c_str(), &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(pipe_ends[1]);
  std::string out;
  std::array<char, 65536> buffer{};
  for (ssize_t count = 0; failed == 0 && (count = read(pipe_ends[0], buffer.data(), buffer.size())) > 0;)
    out.append(buffer.data(), static_cast<std::size_t>(count));
  close(pipe_ends[0]);
  int status = 1;
  if (failed != 0 || waitpid(pid, &status, 0) != pid || status != 0) return std::nullopt;
  return out;
}

json read_json(const fs::path& file) {
  std::ifstream in(file);
  return in ? json::parse(in, nullptr, false) : json();
}

// What a run folder says of its mission: the launcher's first argument is the mission folder.
fs::path mission_of(const fs::path& run) {
  const json launch = read_json(run / "launch.json");
  if (launch.is_object() && launch.contains("arguments") && launch["arguments"].is_array() &&
      !launch["arguments"].empty() && launch["arguments"][0].is_string())
    return launch["arguments"][0].get<std::string>();
  throw std::invalid_argument(run.string() +
                              " is no run folder that names its mission; see roci runs, or add --mission");
}

std::string words_of_summary(const fs::path& run) {
  const json summary = read_json(run / "summary.json");
  if (!summary.is_object()) return run.filename().string();
  const auto text = [&](const char* key) {
    return summary.contains(key) && summary[key].is_string() ? summary[key].get<std::string>() : "";
  };
  std::string out = "scenario " + text("scenario");
  if (summary.contains("seed") && summary["seed"].is_number_integer())
    out += ", seed " + summary["seed"].dump();
  if (summary.contains("sim_s") && summary["sim_s"].is_number())
    out += ", flown " + lib::clock_text(static_cast<std::int64_t>(summary["sim_s"].get<double>() * 1e6));
  return out + ", " + text("result");
}

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
  map.subtitle = "now " + lib::clock_text(view.now_us());
}

std::optional<double> number_at(const json& object, const char* key) {
  const bool there = object.is_object() && object.contains(key) && object[key].is_number();
  return there ? std::optional(object[key].get<double>()) : std::nullopt;
}

// Adds the obstacles that path planners knew when the run ended: NAME.hazards in its folder (docs/formats.md).
void add_hazards(const fs::path& run, MissionMap& map) {
  if (!fs::is_directory(run)) return;
  for (const auto& file : fs::directory_iterator(run)) {
    if (file.path().extension() != ".hazards") continue;
    const json hazards = read_json(file.path());
    if (!hazards.is_array()) continue;
    for (const json& hazard : hazards) {
      const auto x = number_at(hazard, "x_m"), y = number_at(hazard, "y_m"),
                 radius = number_at(hazard, "radius_m");
      if (!x || !y || !radius || *radius < 0) continue;
      const Circle circle{{*x, *y}, *radius};
      if (std::ranges::find(map.hazards, circle) == map.hazards.end()) map.hazards.push_back(circle);
    }
  }
}

MissionMap map_of_live_run(const services::process::ConnectionFlags& flags, const std::string& mission) {
  const auto run = lib::local_run(flags);
  const services::process::Connection connection = lib::choose_run(flags);
  if (mission.empty() && (!run || run->mission.empty()))
    throw std::invalid_argument("the mission's files are not on this machine; add --mission FOLDER");
  MissionMap map =
      read_mission_map(mission.empty() ? run->mission : services::process::mission_folder(mission));
  lib::Client client(connection);
  if (!client.wait_for_mission(kAnswerLimit))
    throw std::runtime_error("no mission answered; is it running there (roci status)?");
  client.wait([&] { return client.view().plan() != nullptr; }, std::chrono::milliseconds(1000));
  client.wait([] { return false; }, std::chrono::milliseconds(300));
  // The journal of a run on this machine has the way from its start; what came down begins when this tool joined.
  const auto trace = run ? trace_of(run->run_folder) : std::nullopt;
  if (trace) {
    std::istringstream lines(*trace);
    add_trace(lines, map);
    map.planned_legs.clear();
  }
  for (const auto& [robot, way] : client.view().ways()) {
    Way& driven = map.driven[robot];
    for (const lib::Place& place : way) {
      if (driven.empty() || (driven.back() != terrain::Point{place.x_m, place.y_m} && !trace))
        driven.push_back({place.x_m, place.y_m});
    }
  }
  add_view(client.view(), map);
  add_planned(client, map);
  return map;
}

MissionMap map_of(const MapArguments& arguments, const services::process::ConnectionFlags& flags) {
  if (!arguments.run.empty()) {
    const fs::path run = fs::absolute(arguments.run);
    MissionMap map = read_mission_map(
        arguments.mission.empty() ? mission_of(run) : services::process::mission_folder(arguments.mission));
    const auto trace = trace_of(run);
    if (!trace)
      throw std::invalid_argument(run.string() +
                                  ": roci-trace cannot read this run; roci-trace print FOLDER says why");
    std::istringstream lines(*trace);
    add_trace(lines, map);
    add_hazards(run, map);
    map.subtitle = words_of_summary(run);
    return map;
  }
  const bool says_where_to_join =
      flags.domain || flags.dds || flags.address || flags.peers || flags.network || flags.secure;
  if (!arguments.mission.empty() && !says_where_to_join) {
    MissionMap map = read_mission_map(services::process::mission_folder(arguments.mission));
    map.subtitle = "the mission, no run";
    return map;
  }
  return map_of_live_run(flags, arguments.mission);
}

void print(const std::string& file, const MissionMap& map, const Picture& picture, bool as_json) {
  if (!as_json) {
    std::cout << file << ": " << picture.width() << " x " << picture.height() << " pixels, "
              << map.places.size() << " places, " << map.hazards.size() << " hazards\n";
    return;
  }
  json driven = json::object();
  for (const auto& [robot, way] : map.driven) driven[robot] = way.size();
  std::cout << json_text({{"file", file},
                          {"width", picture.width()},
                          {"height", picture.height()},
                          {"places", map.places.size()},
                          {"hazards", map.hazards.size()},
                          {"planned", map.planned.size() + map.planned_legs.size()},
                          {"driven", driven}})
            << "\n";
}

}  // namespace

int show_map(const MapArguments& arguments, const services::process::ConnectionFlags& connection,
             bool as_json) {
  std::optional<MissionMap> map;
  try {
    map = map_of(arguments, connection);
  } catch (const mission::FileError& error) {
    std::cerr << "roci: " << error.what() << "\n";
    return kBadUsage;
  } catch (const terrain::MapError& error) {
    std::cerr << "roci: " << error.what() << "\n";
    return kBadUsage;
  }
  const Picture picture = draw_map(*map);
  try {
    write_png(picture, arguments.png);
  } catch (const std::runtime_error& error) {
    std::cerr << "roci: " << error.what() << "\n";
    return kRefused;
  }
  print(arguments.png, *map, picture, as_json);
  return kDone;
}

}  // namespace roci::console::cli::map
