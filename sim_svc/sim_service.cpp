#include "sim_svc/sim_service.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/mission/service_list.hpp"
#include "services/owner/command_server.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "sim_svc/run_end_service.hpp"
#include "sim_svc/run_events_service.hpp"
#include "sim_svc/run_records.hpp"
#include "sim_svc/scenario/run_file.hpp"
#include "sim_svc/scenario_player_service.hpp"
#include "sim_svc/wire_service.hpp"
#include "sim_svc/world/match.hpp"
#include "sim_svc/world_file_service.hpp"

namespace roci::sim {

using scenario::RunSetup;
using scenario::Scenario;
using scenario::Stimulus;
using temporal::Duration;
using temporal::Time;
using world::Answer;
using world::Failure;
using world::Image;
using world::Match;
using world::MotionWanted;
using world::Observed;
using world::PathWanted;
using world::Product;
using world::RockSeen;
using world::SoilMarked;
using world::TaskReport;
using world::TaskStage;

namespace {

namespace topics = services::topics;
namespace owner = services::owner;

constexpr Duration kCallDeadline = std::chrono::seconds(30);

// In a secure run nobody would hear an order of a service that has no right to give any.
void check_rights(const Scenario& scenario, const std::string& service,
                  const services::RunSettings& settings) {
  const Stimulus* const order = first_order(scenario);
  if (!settings.secure || order == nullptr) return;
  const mission::ServiceList services = mission::load_service_list_if_any(settings.mission);
  const mission::ServiceEntry* const own = services.find(service);
  if (own != nullptr && std::ranges::find(own->rights, "console") != own->rights.end()) return;
  order->entry->fail(
      "in a secure run the console alone gives orders; give this one there (roci order), or let " + service +
      " have 'rights: [world, console]' in services: and its certificate made anew");
}

class SimService final : public services::Service, private owner::Driver {
 public:
  SimService(services::Node& node, RunSetup run, const services::RunSettings& settings)
      : node_(node),
        run_folder_(settings.run_folder),
        records_(run_folder_, node.options().incarnation),
        world_(std::move(run.world), settings.seed),
        paths_(services::make_client(node, topics::path_request)),
        motions_(services::make_client(node, topics::arm_motion)),
        commands_(node, *this),
        observations_(services::advertise(node, topics::observation)),
        products_(services::advertise(node, topics::data_product)),
        hazards_(services::advertise(node, topics::hazard)),
        findings_(services::advertise(node, topics::terrain_finding)),
        player_(node, std::move(run.scenario), hazards_,
                {.disturb = [this](Time due, const world::Disturbance& what) { disturb(due, what); },
                 .played = [this] { run_end_.check(); }}),
        events_(node, player_.scenario().expect),
        run_end_(
            node, [this] { return player_.is_over() && !world_.has_data_under_way(); },
            [this] { end("scenario.over", "the mission is over and nothing is to come"); }) {
    commands_.leave_stops_to_driver();  // the world knows its components
    // A live robot outlives the process that speaks for it. A simulated clock ends with its process.
    if (node.options().clock == services::clock::ClockMode::live && !run_folder_.empty()) {
      commands_.keep_in(run_folder_ / (node.options().name + ".ledger"));
      go_on_with(run_folder_ / (node.options().name + ".world"));
    }
    services::subscribe(node, topics::mission_status,
                        [this](const v1::MissionStatus& status) { run_end_.note(status); });
    services::subscribe(node, topics::event, [this](const v1::Event& event) {
      if (event.header().sender() != node_.options().name) events_.hear(event);
    });
    services::subscribe(node, topics::downlink_schedule, [this](const v1::DownlinkSchedule& schedule) {
      tell(world_.heed(node_.now(), wire::schedule_of(schedule)));
    });
    node.at(Time{}, [this] { tell(world_.advance(node_.now())); });
    player_.begin();
    node.at(player_.scenario().duration, [this] { end("scenario.time-up", "the scenario's time is up"); });
  }

 private:
  void catch_up() override { tell(world_.advance(node_.now())); }

  void carry_out(const owner::Request& request) override {
    tell(world_.begin(node_.now(), wire::order_of(request)));
  }

  void break_off(const owner::CommandKey& key, const owner::CommandStatus& why) override {
    const TaskStage stage = why.stage == owner::Stage::failed ? TaskStage::failed : TaskStage::cancelled;
    tell(world_.halt(node_.now(), wire::task_key(key), stage, {why.code, why.reason}));
  }

  // What it held, and where it stood, a robot still does when the process that speaks for it comes back.
  void go_on_with(const std::filesystem::path& file) {
    kept_.emplace(file);
    const auto memory = kept_->read();
    if (!memory) return;
    world_.restore(*memory);
    goes_on_from_ = memory->at;
  }

  // Sends what the world says and wakes up again when it may say more.
  void tell(const world::Outputs& outputs) {
    for (const world::Output& output : outputs) {
      std::visit(Match{[this](const TaskReport& task) { report(task); },
                       [this](const Observed& observed) { publish(observed); },
                       [this](const Image& image) { publish(image); },
                       [this](const Product& product) { publish(product); },
                       [this](const RockSeen& rock) { warn_of(rock); },
                       [this](const SoilMarked& soil) { warn_of(soil); },
                       [this](const PathWanted& path) { ask(path); },
                       [this](const MotionWanted& motion) { ask(motion); }},
                 output);
    }
    record();
    if (kept_) kept_->keep(world_.memory(), services::clock::wall_now());
    run_end_.check();
    if (wake_) node_.cancel(*wake_);
    wake_.reset();
    const auto next = world_.next_change();
    if (!next) return;
    wake_ = node_.at(*next, [this] {
      wake_.reset();
      tell(world_.advance(node_.now()));
    });
  }

  void publish(const Observed& observed) {
    v1::Observation sample = wire::to_wire(observed);
    if (observed.ended) {
      observations_.dispose(sample);
    } else {
      observations_.write(std::move(sample));
    }
  }

  void publish(const Image& image) {
    const v1::DataProduct product = wire::to_wire(image);
    products_.write(product);
    // Nothing more will be said of what is sent, and of what is not kept.
    if (image.sent || image.kind != "image") products_.dispose(product);
  }

  void publish(const Product& product) {
    const v1::DataProduct sample = wire::to_wire(product);
    products_.write(sample);
    if (world::is_final(product.fate)) products_.dispose(sample);
    records_.add(product, node_.now());
  }

  void report(const TaskReport& task) {
    if (task.stage == TaskStage::repairing) {
      commands_.repair(wire::command_key(task.key), task.reason);
    } else {
      commands_.say(wire::command_key(task.key), wire::status_of(task));
    }
  }

  void warn_of(const RockSeen& rock) {
    if (rock.own_map)
      findings_.write(wire::finding_of(rock));
    else
      hazards_.write(wire::to_wire(rock, node_.options().name));
    events_.tell(v1::SEVERITY_WARNING, "hazard.seen",
                 "a rock that the map does not show lies on the way (" + rock.id + ")");
  }

  void warn_of(const SoilMarked& soil) {
    if (soil.own_map)
      findings_.write(wire::finding_of(soil));
    else
      hazards_.write(wire::to_wire(soil, node_.options().name));
    events_.tell(
        v1::SEVERITY_WARNING, "soil.no_go",
        soil.robot + " says No-Go for " + soil.judged_for + " (" + soil.id + ", " + soil.instrument + ")");
  }

  void ask(const PathWanted& path) {
    paths_.call(wire::to_wire(path), path.service, kCallDeadline,
                [this, key = path.key](const services::CallResult<v1::PathReply>& result) {
                  const auto refused = refusal(result, "path");
                  tell(world_.answer(node_.now(), key,
                                     refused ? Answer(*refused) : Answer(wire::way_of(result.reply))));
                });
  }

  void ask(const MotionWanted& motion) {
    motions_.call(
        wire::to_wire(motion), motion.service, kCallDeadline,
        [this, key = motion.key](const services::CallResult<v1::ArmMotionReply>& result) {
          const auto refused = refusal(result, "motion");
          tell(world_.answer(node_.now(), key,
                             refused ? Answer(*refused) : Answer(wire::trajectory_of(result.reply))));
        });
  }

  // Returns why a call gave nothing to follow: "no-path" when there is none, "path-call" when nobody said so.
  template <class Reply>
  static std::optional<Failure> refusal(const services::CallResult<Reply>& result, const std::string& what) {
    if (result.status != services::rpc::CallStatus::ok) {
      return Failure{what + "-call",
                     std::string(services::rpc::to_string(result.status)) + ": " + result.reason};
    }
    if (result.reply.outcome() != v1::MOTION_FOUND) return Failure{"no-" + what, result.reply.reason()};
    return std::nullopt;
  }

  void disturb(Time due, const world::Disturbance& disturbance) {
    // An earlier process has suffered this already; a fall of rocks is no part of its memory.
    if (world::adds_up(disturbance) && goes_on_from_ && due <= *goes_on_from_) return;
    tell(world_.disturb(node_.now(), disturbance));
  }

  void end(const std::string& code, const std::string& text) {
    events_.tell(v1::SEVERITY_INFO, code, text);
    record();
    events_.report(run_folder_);
    node_.stop();
  }

  void record() {
    for (const world::Effect& one : world_.take_effects()) records_.add(one);
    for (const world::Begun& one : world_.take_begun()) records_.add(one);
  }

  services::Node& node_;
  const std::filesystem::path run_folder_;
  std::optional<WorldFile> kept_;  // of a live robot
  std::optional<Time> goes_on_from_;
  RunRecords records_;
  world::World world_;
  services::Client<v1::PathRequest, v1::PathReply> paths_;
  services::Client<v1::ArmMotionRequest, v1::ArmMotionReply> motions_;
  owner::CommandServer commands_;
  services::Publisher<v1::Observation> observations_;
  services::Publisher<v1::DataProduct> products_;
  services::Publisher<v1::Hazard> hazards_;
  services::Publisher<v1::TerrainFinding> findings_;  ///< for a robot's own map
  ScenarioPlayer player_;
  RunEvents events_;
  std::optional<services::Node::TimerId> wake_;
  RunEnd run_end_;
};

}  // namespace

std::unique_ptr<services::Service> make_service(services::Node& node, const services::RunSettings& settings) {
  scenario::RunSetup run = scenario::load_run(settings.mission_file(), settings.scenario);
  check_rights(run.scenario, node.options().name, settings);
  return std::make_unique<SimService>(node, std::move(run), settings);
}

}  // namespace roci::sim
