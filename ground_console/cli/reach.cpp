#include "ground_console/cli/reach.hpp"

#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "ground_console/cli/report.hpp"
#include "ground_console/cli/verbs.hpp"

namespace roci::console::cli {
namespace {

using nlohmann::json;

const char* outcome_name(v1::MotionOutcome outcome) {
  switch (outcome) {
    case v1::MOTION_FOUND:
      return "found";
    case v1::MOTION_UNREACHABLE:
      return "unreachable";
    case v1::MOTION_UNKNOWN:
      return "unknown";
    case v1::MOTION_INVALID:
      break;
  }
  return "invalid";
}

// Where the robot is now; throws std::invalid_argument with the remedy where that is not known.
lib::Place start_of(lib::Client& client, const ReachArguments& arguments) {
  if (arguments.from_x_m && arguments.from_y_m) return {*arguments.from_x_m, *arguments.from_y_m};
  const auto& ways = client.view().ways();
  const auto known = [&] { return arguments.robot.empty() ? !ways.empty() : ways.contains(arguments.robot); };
  if (!client.wait(known, std::chrono::milliseconds(2000)))
    throw std::invalid_argument("it is not known where " +
                                (arguments.robot.empty() ? "the robot" : "robot '" + arguments.robot + "'") +
                                " is; say where the way begins, e.g. --from 40 40");
  client.catch_up();
  if (arguments.robot.empty() && ways.size() > 1)
    throw std::invalid_argument("there are several robots; name one with --robot");
  return (arguments.robot.empty() ? ways.begin()->second : ways.at(arguments.robot)).back();
}

json way_json(const v1::PathReply& reply, lib::Place from, const ReachArguments& to) {
  json out{{"outcome", outcome_name(reply.outcome())},
           {"reason", reply.reason()},
           {"map_version", reply.map_version()},
           {"from", {from.x_m, from.y_m}},
           {"to", {to.x_m, to.y_m}}};
  if (reply.outcome() != v1::MOTION_FOUND) return out;
  out["length_m"] = reply.length_m();
  out["expected_s"] = reply.expected_s();
  out["expected_j"] = reply.expected_j();
  return out;
}

std::string place_text(double x, double y) { return "x=" + lib::value_text(x) + " y=" + lib::value_text(y); }

}  // namespace

std::string path_planner_of(const lib::MissionView& view, const ReachArguments& arguments) {
  if (!arguments.service.empty()) return arguments.service;
  std::vector<std::string> of_robot, all;
  for (const auto& [planner, map] : view.maps()) {
    all.push_back(planner);
    if (!arguments.robot.empty() && map.header().robot() == arguments.robot) of_robot.push_back(planner);
  }
  const std::vector<std::string>& meant = of_robot.empty() ? all : of_robot;
  if (meant.empty()) return "pathplan_svc";
  if (meant.size() == 1) return meant.front();
  std::string names;
  for (const std::string& name : meant) names += (names.empty() ? "" : ", ") + name;
  throw std::invalid_argument("there are several path planners; name one with --service: " + names);
}

int show_reach(lib::Client& client, const ReachArguments& arguments, bool as_json) {
  if (!client.wait_for_mission(kAnswerLimit)) {
    std::cerr << "roci: no mission answered; is it running there (roci status)?\n";
    return kNoMission;
  }
  const lib::Place from = start_of(client, arguments);
  if (arguments.service.empty())
    client.wait([&] { return !client.view().maps().empty(); }, std::chrono::milliseconds(2000));
  client.catch_up();
  const std::string service = path_planner_of(client.view(), arguments);
  std::string why;
  const auto reply = client.find_path(from, {arguments.x_m, arguments.y_m}, service, kAnswerLimit, why);
  if (!reply) {
    std::cerr << "roci: " << service << " did not answer: " << why
              << "; is there a service of that name (roci status)?\n";
    return kNoMission;
  }
  const bool found = reply->outcome() == v1::MOTION_FOUND;
  const std::string ends = place_text(from.x_m, from.y_m) + " to " + place_text(arguments.x_m, arguments.y_m);
  if (as_json) {
    std::cout << json_text(way_json(*reply, from, arguments)) << "\n";
  } else if (found) {
    std::cout << "from " << ends << ": " << lib::value_text(reply->length_m()) << " m, "
              << lib::value_text(reply->expected_s()) << " s, " << lib::value_text(reply->expected_j())
              << " J (map " << reply->map_version() << ")\n";
  } else {
    const bool known = reply->outcome() != v1::MOTION_UNKNOWN;
    std::cout << (known ? "no way from " : "no way is known, and none is ruled out, from ") << ends << ": "
              << printable(reply->reason()) << " (map " << reply->map_version() << ")\n";
  }
  return found ? kDone : kRefused;
}

}  // namespace roci::console::cli
