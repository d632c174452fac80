#include "tests/scenario/yard.hpp"

#include <unistd.h>

#include "core/terrain/way.hpp"
#include "pathplan_svc/pathplan_service.hpp"
#include "sim_svc/sim_service.hpp"

namespace roci::scenario {
namespace {

namespace topics = services::topics;

constexpr char kMission[] = ROCI_SOURCE_DIR "/missions/faster";

std::string text_of_number(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

}  // namespace

YardCommand drive(const std::string& robot, double x, double y) {
  return {"sim_svc",
          robot,
          "nav",
          "drive",
          {{"to", "there"}, {"x", text_of_number(x)}, {"y", text_of_number(y)}}};
}

YardCommand drive_over(const std::string& robot, const std::vector<terrain::Point>& way) {
  return {"sim_svc", robot, "nav", "drive", {{"to", "there"}, {"way", terrain::to_text(way)}}};
}

YardCommand path(const std::string& robot, terrain::Point from, terrain::Point to) {
  const auto text = [](terrain::Point p) { return text_of_number(p.x) + " " + text_of_number(p.y); };
  return {robot + ".path", robot, "", "path", {{"from", text(from)}, {"to", text(to)}}};
}

YardCommand turn(const std::string& robot, double x, double y) {
  return {"sim_svc", robot, "nav", "turn", {{"x", text_of_number(x)}, {"y", text_of_number(y)}}};
}

YardCommand localise() { return {"sim_svc", "primary", "eye", "localise", {{"robot", "scout"}}}; }

YardCommand tell(const std::string& robot) { return {robot + ".path", robot, "map", "tell", {}}; }

YardCommand merge(const std::string& robot, const std::string& author, double version, double within_s) {
  return {robot + ".path",
          robot,
          "map",
          "merge",
          {{"author", author}, {"version", text_of_number(version)}, {"within_s", text_of_number(within_s)}}};
}

Yard::Yard(const std::string& scenario, std::vector<std::string> vendors, Script script, std::uint64_t seed)
    : folder_(std::filesystem::temp_directory_path() / ("roci_yard_" + std::to_string(::getpid()))),
      vendors_(std::move(vendors)),
      script_(std::move(script)),
      run_({"sim_svc", "primary.path", "scout.path", "driver"}, domain_.id()) {
  std::filesystem::create_directories(folder_);
  run_.robots = {{"primary.path", "primary"}, {"scout.path", "scout"}};
  services::RunSettings settings;
  settings.mission = kMission;
  settings.scenario = scenario;
  settings.seed = seed;
  settings.run_folder = folder_;
  services_.push_back(sim::make_service(run_.add("sim_svc", 1, vendors_.at(0)), settings));
  std::size_t vendor = 1;
  for (const std::string robot : {"primary", "scout"}) {
    services::RunSettings own = settings;
    own.settings = std::filesystem::path(kMission) / (robot + ".yaml");
    services_.push_back(pathplan::make_service(run_.add(robot + ".path", 1, vendors_.at(vendor++)), own));
  }
  driver_ = &run_.add("driver", 1, vendors_.at(vendor));
  commands_ = services::advertise(*driver_, topics::command);
  paths_.emplace(services::make_client(*driver_, topics::path_request));
  status_ = services::advertise(*driver_, topics::mission_status);
  services::subscribe(*driver_, topics::command_ack, [this](const v1::CommandAck& ack) { hear(ack); });
  services::subscribe(*driver_, topics::event, [this](const v1::Event& event) {
    events_.push_back(event.header().sender() + " " + event.code() + " " + event.text());
    trace_.push_back(std::to_string(driver_->now().count()) + " " + events_.back());
  });
  driver_->at(temporal::seconds(1), [this] { next(); });
}

Yard::~Yard() {
  services_.clear();
  std::filesystem::remove_all(folder_);
}

void Yard::run() { run_.run(); }

void Yard::next() {
  const auto command = script_(words_);
  if (!command) {
    v1::MissionStatus over;
    over.executive("driver");
    over.phase(v1::PHASE_IDLE);
    over.outcome("success");
    status_.write(over);
    return;
  }
  if (command->command == "path") return ask(*command);
  running_ = "a" + std::to_string(words_.size() + 1);
  v1::Command out;
  out.commander("driver");
  out.epoch(1);
  out.sender_epoch(1);
  out.activity(running_);
  out.attempt(1);
  out.owner(command->owner);
  out.robot(command->robot);
  out.subsystem(command->subsystem);
  out.command_name(command->command);
  for (const auto& [name, value] : command->arguments) {
    v1::Property argument;
    argument.name(name);
    argument.value(value);
    out.arguments().push_back(argument);
  }
  out.latest_end_us(-1);
  commands_.write(out);
}

void Yard::ask(const YardCommand& command) {
  const auto pose_of = [](const std::string& text) {
    v1::Pose2 pose;
    std::istringstream in(text);
    double x = 0, y = 0;
    in >> x >> y;
    pose.x_m(x);
    pose.y_m(y);
    return pose;
  };
  v1::PathRequest request;
  request.origin(pose_of(command.arguments.at("from")));
  request.goal_pose(pose_of(command.arguments.at("to")));
  paths_->call(
      request, command.owner, temporal::seconds(30),
      [this](const services::CallResult<v1::PathReply>& result) {
        YardWord word{v1::STAGE_COMPLETED, "", result.reply.reason(), {}, {}};
        for (const v1::Pose2& one : result.reply.waypoints()) word.way.push_back({one.x_m(), one.y_m()});
        if (result.status != services::rpc::CallStatus::ok || result.reply.outcome() != v1::MOTION_FOUND) {
          word.stage = v1::STAGE_FAILED;
          word.code = "no-path";
        }
        trace_.push_back(std::to_string(driver_->now().count()) + " path of " +
                         std::to_string(word.way.size()) + " points " + word.code);
        end(std::move(word));
      });
}

void Yard::hear(const v1::CommandAck& ack) {
  trace_.push_back(std::to_string(driver_->now().count()) + " " + ack.owner() + " " + ack.activity() + " " +
                   std::to_string(ack.stage()) + " " + ack.code() + " " + ack.reason());
  if (ack.activity() != running_ || ack.stage() == v1::STAGE_ACCEPTED) return;
  YardWord word{ack.stage(), ack.code(), ack.reason(), {}, {}};
  for (const v1::NamedValue& one : ack.outcome().measured()) word.results[one.name()] = one.held().number();
  running_.clear();
  end(std::move(word));
}

void Yard::end(YardWord word) {
  words_.push_back(std::move(word));
  driver_->after(temporal::seconds(1), [this] { next(); });
}

}  // namespace roci::scenario
