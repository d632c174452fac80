#include "sim_svc/sim_service.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "core/mission/service_list.hpp"
#include "services/owner/command_server.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "sim_svc/run_end_service.hpp"
#include "sim_svc/scenario/run_file.hpp"
#include "sim_svc/wire_service.hpp"
#include "sim_svc/world/match.hpp"
#include "sim_svc/world_file_service.hpp"

namespace roci::sim {

using scenario::GoalStimulus;
using scenario::HazardStimulus;
using scenario::NetworkStimulus;
using scenario::OrderStimulus;
using scenario::RecallStimulus;
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

constexpr char kGround[] = "ground";  // who tells of hazards that the scenario states
constexpr Duration kCallDeadline = std::chrono::seconds(30);
constexpr std::string_view kEnd = "\n]\n";  // of begun.json

// Returns the scenario's first order of the ground; null: there is none.
const Stimulus* first_order(const Scenario& scenario) {
  const auto orders = [](const Stimulus& stimulus) {
    return std::holds_alternative<OrderStimulus>(stimulus.what);
  };
  const auto found = std::ranges::find_if(scenario.stimuli, orders);
  return found == scenario.stimuli.end() ? nullptr : &*found;
}

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
        scenario_(std::move(run.scenario)),
        run_folder_(settings.run_folder),
        order_(scenario_.expect),
        world_(std::move(run.world), settings.seed),
        paths_(services::make_client(node, topics::path_request)),
        motions_(services::make_client(node, topics::arm_motion)),
        commands_(node, *this),
        observations_(services::advertise(node, topics::observation)),
        products_(services::advertise(node, topics::data_product)),
        hazards_(services::advertise(node, topics::hazard)),
        findings_(services::advertise(node, topics::terrain_finding)),
        goals_(services::advertise(node, topics::goal)),
        network_orders_(services::advertise(node, topics::network_order)),
        events_(services::advertise(node, topics::event)),
        run_end_(
            node,
            [this] { return stimuli_done_ == scenario_.stimuli.size() && !world_.has_data_under_way(); },
            [this] { end("scenario.over", "the mission is over and nothing is to come"); }) {
    commands_.leave_stops_to_driver();  // the world knows its components
    // A live robot outlives the process that speaks for it. A simulated clock ends with its process.
    if (node.options().clock == services::clock::ClockMode::live && !run_folder_.empty()) {
      commands_.keep_in(run_folder_ / (node.options().name + ".ledger"));
      go_on_with(run_folder_ / (node.options().name + ".world"));
    }
    if (!run_folder_.empty()) effects_.open(run_folder_ / "effects.jsonl", std::ios::app);
    if (!run_folder_.empty()) fates_.open(run_folder_ / "products.jsonl", std::ios::app);
    if (!run_folder_.empty()) {
      begun_.open(run_folder_ / "begun.json");
      begun_ << "[" << kEnd << std::flush;
    }
    services::subscribe(node, topics::mission_status,
                        [this](const v1::MissionStatus& status) { run_end_.note(status); });
    services::subscribe(node, topics::event, [this](const v1::Event& event) {
      if (event.header().sender() != node_.options().name) order_.note(event.code(), event.text());
    });
    services::subscribe(node, topics::downlink_schedule, [this](const v1::DownlinkSchedule& schedule) {
      tell(world_.heed(node_.now(), wire::schedule_of(schedule)));
    });
    node.at(Time{}, [this] { tell(world_.advance(node_.now())); });
    // In a secure run orders are the console's, so only who needs this asks for it.
    if (first_order(scenario_) != nullptr) orders_.emplace(services::advertise(node, topics::order));
    for (const Stimulus& stimulus : scenario_.stimuli) {
      node.at(stimulus.at, [this, &stimulus] { stimulate(stimulus); });
    }
    node.at(scenario_.duration, [this] { end("scenario.time-up", "the scenario's time is up"); });
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
                       [this](const Observed& observed) { observations_.write(wire::to_wire(observed)); },
                       [this](const Image& image) { publish(image); },
                       [this](const Product& product) { publish(product); },
                       [this](const RockSeen& rock) { warn_of(rock); },
                       [this](const SoilMarked& soil) { warn_of(soil); },
                       [this](const PathWanted& path) { ask(path); },
                       [this](const MotionWanted& motion) { ask(motion); }},
                 output);
    }
    record_effects();
    record_begun();
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
    fates_ << nlohmann::json{{"time_us", node_.now().count()},
                             {"robot", product.robot},
                             {"id", product.id},
                             {"kind", product.kind},
                             {"source", product.source},
                             {"bytes", product.bytes},
                             {"tier", world::name_of(product.tier)},
                             {"fate", world::name_of(product.fate)}}
                  .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
           << std::endl;
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
    announce(v1::SEVERITY_WARNING, "hazard.seen",
             "a rock that the map does not show lies on the way (" + rock.id + ")");
  }

  void warn_of(const SoilMarked& soil) {
    if (soil.own_map)
      findings_.write(wire::finding_of(soil));
    else
      hazards_.write(wire::to_wire(soil, node_.options().name));
    announce(
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

  void stimulate(const Stimulus& stimulus) {
    ++stimuli_done_;
    std::visit(Match{[this](const GoalStimulus& goal) {
                       uploaded_[{goal.issuer, goal.id}] = &goal;
                       goals_.write(wire::to_wire(goal, false));
                     },
                     [this](const RecallStimulus& recall) {
                       goals_.write(wire::to_wire(*uploaded_.at({recall.issuer, recall.id}), true));
                     },
                     [this](const HazardStimulus& hazard) {
                       const world::Rock& rock = hazard.rock;
                       hazards_.write(wire::to_wire(
                           RockSeen{hazard.id, "", rock.x, rock.y, rock.radius, node_.now()}, kGround));
                     },
                     [this](const NetworkStimulus& order) { network_orders_.write(wire::to_wire(order)); },
                     [this](const OrderStimulus& order) { orders_->write(wire::to_wire(order)); },
                     [this, &stimulus](const world::Disturbance& disturbance) {
                       // An earlier process has suffered this already; a fall of rocks is no part of its memory.
                       if (world::adds_up(disturbance) && goes_on_from_ && stimulus.at <= *goes_on_from_)
                         return;
                       tell(world_.disturb(node_.now(), disturbance));
                     }},
               stimulus.what);
    run_end_.check();
  }

  void end(const std::string& code, const std::string& text) {
    announce(v1::SEVERITY_INFO, code, text);
    record_begun();
    if (order_.expected() > 0) report_order();
    node_.stop();
  }

  void announce(v1::Severity severity, const std::string& code, const std::string& text) {
    events_.write(wire::event(severity, code, text));
    order_.note(code, text);
  }

  // Each line is written at once, so that the death of this process loses none.
  void record_effects() {
    for (const world::Effect& one : world_.take_effects()) {
      effects_ << nlohmann::json{{"time_us", one.at.count()},    {"robot", one.robot},
                                 {"component", one.component},   {"kind", one.effect.kind},
                                 {"object", one.effect.object},  {"commander", one.cause.commander},
                                 {"epoch", one.cause.epoch},     {"activity", one.cause.activity},
                                 {"attempt", one.cause.attempt}, {"incarnation", node_.options().incarnation}}
                      .dump()
               << std::endl;
    }
  }

  // What was really done, for whoever asks after the run whether anything was done twice: one array, written as it
  // grows, and whole however the process ends.
  void record_begun() {
    for (const world::Begun& one : world_.take_begun()) {
      const nlohmann::json entry{{"time_us", one.at.count()},         {"robot", one.robot},
                                 {"component", one.component},        {"commander", one.task.key.commander},
                                 {"activity", one.task.key.activity}, {"attempt", one.task.key.attempt},
                                 {"command", one.task.command},       {"arguments", one.task.arguments}};
      begun_.seekp(-static_cast<std::streamoff>(kEnd.size()), std::ios::end);
      begun_ << std::exchange(begun_separator_, ",\n")
             << entry.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << kEnd << std::flush;
    }
  }

  // Writes the result for whoever started the run; the summary takes it up as `expected`.
  void report_order() const {
    const std::string fault = order_.final_fault();
    events_.write(fault.empty()
                      ? wire::event(v1::SEVERITY_INFO, "scenario.as_expected", "every event came as expected")
                      : wire::event(v1::SEVERITY_WARNING, "scenario.unexpected", fault));
    const nlohmann::json report{{"events", order_.expected()}, {"met", fault.empty()}, {"fault", fault}};
    std::ofstream(run_folder_ / services::kExpectedFile)
        << report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
  }

  services::Node& node_;
  const Scenario scenario_;
  const std::filesystem::path run_folder_;
  std::optional<WorldFile> kept_;  // of a live robot
  std::optional<Time> goes_on_from_;
  std::ofstream effects_;
  std::ofstream fates_;  // of data products
  std::ofstream begun_;
  const char* begun_separator_ = "\n";
  scenario::EventOrder order_;
  world::World world_;
  services::Client<v1::PathRequest, v1::PathReply> paths_;
  services::Client<v1::ArmMotionRequest, v1::ArmMotionReply> motions_;
  owner::CommandServer commands_;
  services::Publisher<v1::Observation> observations_;
  services::Publisher<v1::DataProduct> products_;
  services::Publisher<v1::Hazard> hazards_;
  services::Publisher<v1::TerrainFinding> findings_;  ///< for a robot's own map
  services::Publisher<v1::Goal> goals_;
  services::Publisher<v1::NetworkOrder> network_orders_;
  std::optional<services::Publisher<v1::Order>> orders_;  ///< of scenarios in which the ground gives some
  services::Publisher<v1::Event> events_;
  std::map<std::pair<std::string, std::string>, const GoalStimulus*> uploaded_;  // by issuer and id
  std::size_t stimuli_done_ = 0;
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
