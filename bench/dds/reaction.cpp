// These ports measure the executive between an observation and the command that waited for it: exec_svc runs
// as it is, live, with its journal; the client plays the robot and the planner. Of a dedicated executive
// (R145), in a process of its own, the same: the robot's word goes up through it, and the command down.
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "bench/dds/port.hpp"
#include "dedicated_svc/dedicated_service.hpp"
#include "exec_svc/exec_service.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "services/transport/plug_ins.hpp"
#include "services/wire/plan_wire.hpp"
#include "tests/contract/support/child_process.hpp"
#include "tests/unit/exec_svc/planetary_fixture.hpp"

namespace roci::bench {
namespace {

namespace fs = std::filesystem;
namespace topics = services::topics;

// A plan has more activities than any bench plays; the cost of an event does not depend on it
// (bench_executive).
constexpr std::size_t kActivities = 16'000;

std::unique_ptr<services::Node> open_node(const std::string& name, const std::string& vendor, int domain) {
  services::node::NodeOptions options;
  options.name = name;
  options.vendor = vendor;
  return std::make_unique<services::Node>(
      options, services::transport::open_transport(vendor, {.domain = domain, .participant = name}));
}

constexpr char kDedicated[] = "imager";                    // takes the executive's commands for the camera
constexpr char kMissionVariable[] = "ROCI_BENCH_MISSION";  // tells the child where its mission stands

// The planetary mission, whose camera is commanded through a dedicated executive.
fs::path mission_with_imager(const fs::path& folder) {
  const fs::path mission = folder / "mission";
  fs::copy(ROCI_SOURCE_DIR "/missions/planetary", mission, fs::copy_options::recursive);
  std::stringstream text;
  text << std::ifstream(mission / "mission.yaml").rdbuf();
  std::string yaml = text.str();
  const auto replace = [&yaml](const std::string& old, const std::string& by) {
    const auto at = yaml.find(old);
    if (at == std::string::npos) throw std::runtime_error("missions/planetary has no '" + old + "'");
    yaml.replace(at, old.size(), by);
  };
  replace("services:\n", std::string("services:\n  - {name: ") + kDedicated +
                             ", program: dedicated_svc, robot: rover, settings: imager.yaml}\n");
  replace("take-image: {owner: sim_svc,", std::string("take-image: {owner: ") + kDedicated + ",");
  std::ofstream(mission / "mission.yaml") << yaml;
  std::ofstream(mission / "imager.yaml")
      << "format: 1\nname: planetary\ndedicated:\n  timeline: rover.imager\n  subsystem: camera\n"
         "  rest: [ready]\n  methods:\n    image:\n      arguments: [image]\n      calls:\n"
         "        - {name: image, command: {owner: sim_svc, robot: rover, subsystem: camera, name: image, "
         "arguments: {image: \"{image}\"}}}\n";
  return mission;
}

// Returns images one after the other; each waits for the camera to be observed idle after the one before.
temporal::FlexiblePlan chain_of_images() {
  temporal::FlexiblePlan plan;
  for (std::size_t i = 0; i < kActivities; ++i) {
    temporal::PlanActivity activity;
    activity.id = "a" + std::to_string(i);
    activity.name = "take-image";
    activity.arguments = {{"1", "image-1"}, {"2", "place-1"}};
    activity.start_point = plan.point_count++;
    activity.end_point = plan.point_count++;
    activity.pre = temporal::compare("(camera-idle)", temporal::ConditionOp::eq, true);
    // Without it the executive sees a conflict ahead while this variant waits for its next turn, replans, and the
    // first command of the new plan comes with its origin, 5 s later.
    activity.impacts = {{"(camera-idle)", temporal::ImpactKind::assign, temporal::ImpactWhen::at_end, true}};
    if (i > 0) {
      plan.constraints.push_back({plan.activities.back().end_point, activity.start_point,
                                  temporal::ConstraintKind::ordering, temporal::Duration{0},
                                  temporal::no_bound});
    }
    plan.activities.push_back(std::move(activity));
  }
  return plan;
}

class ExecutivePort : public Port {
 public:
  ExecutivePort(const std::string& vendor, const PortOptions& options, bool dedicated)
      : folder_(fs::temp_directory_path() / ("rocinante-bench-" + std::to_string(getpid()))),
        node_(open_node("exec_svc", vendor, options.domain)) {
    fs::create_directories(folder_);
    services::RunSettings settings;
    settings.mission =
        dedicated ? mission_with_imager(folder_) : fs::path(ROCI_SOURCE_DIR "/missions/planetary");
    settings.run_folder = folder_;
    if (dedicated) {
      dedicated_.emplace(
          std::vector<std::string>{fs::read_symlink("/proc/self/exe").string(), "--serve",
                                   std::string(kDedicatedKind) + "-" + vendor, "--domain",
                                   std::to_string(options.domain)},
          std::vector<std::string>{std::string(kMissionVariable) + "=" + settings.mission.string()});
      if (!dedicated_->wait_for("ready")) throw std::runtime_error("the dedicated executive does not start");
    }
    service_ = exec::make_service(*node_, settings);
    loop_ = std::jthread([this] { node_->run(); });
  }
  ~ExecutivePort() override {
    node_->stop();
    loop_.join();
    service_.reset();
    fs::remove_all(folder_);
  }
  bool send(const Ball&) override { return false; }
  bool matched() const override { return true; }

 private:
  const fs::path folder_;
  std::optional<services::contract::ChildProcess> dedicated_;
  std::unique_ptr<services::Node> node_;
  std::unique_ptr<services::Service> service_;
  std::jthread loop_;
};

// Keeps its ledger and its record in the executive's folder, as in a run.
class DedicatedPort : public Port {
 public:
  DedicatedPort(const std::string& vendor, const PortOptions& options)
      : node_(open_node(kDedicated, vendor, options.domain)) {
    const char* mission = std::getenv(kMissionVariable);
    if (mission == nullptr) throw std::runtime_error("it is started by the executive's port");
    services::RunSettings settings;
    settings.mission = mission;
    settings.settings = settings.mission / "imager.yaml";
    settings.run_folder = settings.mission.parent_path();
    service_ = dedicated::make_service(*node_, settings);
    loop_ = std::jthread([this] { node_->run(); });
  }
  ~DedicatedPort() override {
    node_->stop();
    loop_.join();
    service_.reset();
  }
  bool send(const Ball&) override { return false; }
  bool matched() const override { return true; }

 private:
  std::unique_ptr<services::Node> node_;
  std::unique_ptr<services::Service> service_;
  std::jthread loop_;
};

// With send(), the camera is observed idle and the image that is being taken is reported complete, in one go;
// the command for the next one is the answer.
class RobotPort : public Port {
 public:
  RobotPort(const std::string& vendor, PortOptions options, const std::string& commander)
      : commander_(commander),
        on_ball_(std::move(options.on_ball)),
        robot_(open_node("sim_svc", vendor, options.domain)),
        planner_(open_node("planner_svc", vendor, options.domain)),
        goals_(services::advertise(*robot_, topics::goal)),
        observations_(services::advertise(*robot_, topics::observation)),
        acks_(services::advertise(*robot_, topics::command_ack)) {
    services::serve(*planner_, topics::plan_request, [](const v1::PlanRequest&, auto responder) {
      v1::PlanReply reply;
      reply.verdict_code(v1::VERDICT_SOLVED);
      reply.solution(services::wire::to_wire(chain_of_images()));
      responder.reply(reply);
    });
    services::subscribe(*robot_, topics::command, [this](const v1::Command& command) { take(command); });
    for (const exec::executive::Observation& seen : exec::testing::standing_robot())
      observe(seen.timeline, seen.value);
    v1::Goal goal;
    goal.issuer("bench");
    goal.id("1");
    goal.goal_kind("photo");
    goal.arguments().resize(2);
    goal.arguments()[0].name("x");
    goal.arguments()[0].value("110");
    goal.arguments()[1].name("y");
    goal.arguments()[1].value("60");
    goals_.write(goal);
    planner_loop_ = std::jthread([this] { planner_->run(); });
    robot_loop_ = std::jthread([this] { robot_->run(); });
  }
  ~RobotPort() override {
    planner_->stop();
    robot_->stop();
  }

  // Returns false as long as no image is being taken.
  bool send(const Ball& ball) override {
    const auto turn = turn_.exchange(kNoTurn);
    if (turn == kNoTurn) return false;
    ball_ = ball;
    robot_->post_work_result(turn, [this] {
      answer(v1::STAGE_COMPLETED);
      observe("rover.camera", temporal::state("idle"));
    });
    return true;
  }
  bool matched() const override { return turn_ != kNoTurn; }

 private:
  static constexpr services::Node::WorkId kNoTurn = ~services::Node::WorkId{0};

  void observe(const std::string& timeline, const temporal::Value& value) {
    v1::Observation out;
    out.timeline(timeline);
    out.observed(services::wire::to_wire(value));
    observations_.write(out);
  }

  void answer(v1::CommandStage stage) {
    v1::CommandAck out;
    out.commander(running_.commander());
    out.epoch(running_.epoch());
    out.activity(running_.activity());
    out.attempt(running_.attempt());
    out.stage(stage);
    out.owner("sim_svc");
    acks_.write(out);
  }

  void take(const v1::Command& command) {
    if (command.owner() != "sim_svc" || command.commander() != commander_ ||
        command.command_name() != "image" || command.action() != v1::COMMAND_EXECUTE)
      return;
    running_ = command;
    observe("rover.camera", temporal::state("imaging"));
    answer(v1::STAGE_ACCEPTED);
    const bool answers_a_ball = ball_.sequence != 0;
    const Ball ball = ball_;
    turn_ = robot_->begin_work();
    if (answers_a_ball) on_ball_(ball);
  }

  const std::string commander_;  // whose commands alone count
  const std::function<void(const Ball&)> on_ball_;
  std::unique_ptr<services::Node> robot_, planner_;
  services::Publisher<v1::Goal> goals_;
  services::Publisher<v1::Observation> observations_;
  services::Publisher<v1::CommandAck> acks_;
  v1::Command running_;
  Ball ball_;                                           // handed over with the turn
  std::atomic<services::Node::WorkId> turn_ = kNoTurn;  // to report the image that is being taken
  std::jthread planner_loop_, robot_loop_;
};

}  // namespace

std::unique_ptr<Port> open_reaction(const std::string& vendor, PortOptions options) {
  if (options.side == Side::server) return std::make_unique<ExecutivePort>(vendor, options, false);
  return std::make_unique<RobotPort>(vendor, std::move(options), "exec_svc");
}

std::unique_ptr<Port> open_dedicated_reaction(const std::string& vendor, PortOptions options) {
  if (options.side == Side::server) return std::make_unique<ExecutivePort>(vendor, options, true);
  return std::make_unique<RobotPort>(vendor, std::move(options), kDedicated);
}

std::unique_ptr<Port> open_dedicated(const std::string& vendor, const PortOptions& options) {
  return std::make_unique<DedicatedPort>(vendor, options);
}

}  // namespace roci::bench
