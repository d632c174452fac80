#include "exec_svc/exec_service.hpp"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "exec_svc/command_epoch_service.hpp"
#include "exec_svc/decision_link_service.hpp"
#include "exec_svc/engine_link_service.hpp"
#include "exec_svc/intake_service.hpp"
#include "exec_svc/journal/crash_points.hpp"
#include "exec_svc/journal/journal.hpp"
#include "exec_svc/journal/journaled_reactor.hpp"
#include "exec_svc/journal/round_trips.hpp"
#include "exec_svc/journal_watch_service.hpp"
#include "exec_svc/mission_report_service.hpp"
#include "exec_svc/order_link_service.hpp"
#include "exec_svc/output_publisher_service.hpp"
#include "exec_svc/owners_presence_service.hpp"
#include "exec_svc/planner_link_service.hpp"
#include "exec_svc/run_files_service.hpp"
#include "exec_svc/standby/goals_apart.hpp"
#include "exec_svc/standby/leader_service.hpp"
#include "exec_svc/step_timer_service.hpp"
#include "exec_svc/strangers.hpp"
#include "exec_svc/wire_service.hpp"
#include "services/process/disk_pause.hpp"
#include "services/wire/plan_wire.hpp"

namespace roci::exec {

using goals::GoalRequest;
using journal::CrashPoints;
using journal::Divergence;
using journal::Journal;
using journal::JournaledReactor;
using journal::Recovery;
using mission::MissionModel;
using mission::owners_of;
using mission::read_mission;
using reactor::DecisionRecord;
using reactor::Event;
using reactor::GivenAnswer;
using reactor::PlannedAction;
using reactor::PlanReply;
using reactor::Reactor;
using reactor::ReactorInputs;
using reactor::ReactorOutputs;
using reactor::Severity;
using standby::GoalsApart;
using standby::LeaderService;

namespace {

namespace topics = services::topics;
using services::Node;

constexpr double kListenS = 2;  // wall time

CrashPoints crash_points(const Node& node) {
  const char* setting = std::getenv("ROCI_CRASH");
  return CrashPoints(setting == nullptr ? "" : setting, node.options().incarnation,
                     [] { std::raise(SIGKILL); });
}

// Lets the leader of a pair keep silent to its supervisor while it waits, since the other member has a disk
// of its own.
services::process::DiskPause disk_pause(Node& node, const LeaderService* leading) {
  return leading == nullptr ? services::process::DiskPause(node) : services::process::DiskPause();
}

MissionModel mission_behind_links(const Node& node, const services::RunSettings& settings) {
  MissionModel mission = read_mission(settings.mission_file(), role_of(settings, node.options()));
  mission.executive.round_trips = node.round_trips();
  return mission;
}

// Collects what comes in one turn of the loop, steps the reactor once, journals what it decided, then sends
// it. It has more members than a class of one purpose needs, because it is where the parts of the process
// meet: each neighbour (planner, engine, owners, ground, partner, disk) has a part that owns what concerns
// it, and of its own it keeps only the inputs of the turn.
class ExecService final : public services::Service {
 public:
  ExecService(Node& node, const services::RunSettings& settings, Journal& journal, std::uint64_t epoch,
              LeaderService* leading, bool doubtful, std::optional<GoalsApart> apart = std::nullopt)
      : node_(node),
        settings_(settings),
        mission_(mission_behind_links(node, settings)),
        summary_file_(run_file(settings, node.options().name, services::kSummaryFile)),
        journal_(journal),
        leader_(leading),
        apart_(std::move(apart)),
        reactor_(mission_, journal_, doubtful || is_in_doubt(journal)),
        crash_(crash_points(node)),
        planner_(node, settings, mission_, journal_, [this](PlanReply reply) { take(std::move(reply)); }),
        presence_(node, journal_, owners_of(mission_), mission_.executive.owner_return,
                  {[this](const services::health::PeerChange& change) { heed(change); },
                   [this](const std::string& service, const std::string& cause) { lose(service, cause); },
                   [this](const std::string& service) { inputs_.arrivals.push_back(service); },
                   [this] { timer_.step_soon(); }}),
        publisher_(node, mission_, epoch, crash_),
        strangers_([this](const Event& event) { publisher_.report(event); }),
        epoch_(node, journal, publisher_, strangers_, leading, epoch,
               [this](std::uint64_t begun) { inputs_.epoch = begun; }),
        journal_watch_(journal, disk_pause(node, leading),
                       [this](const Event& event) { publisher_.report(event); }),
        decisions_(
            node, [this](GivenAnswer answer, std::string line) { take(std::move(answer), std::move(line)); }),
        orders_(
            node, [this](orders::Order order, std::string line) { take(std::move(order), std::move(line)); },
            [this](const Event& event) { intake_.tell(event); }),
        intake_(mission_, reactor_.reactor(), [this](const Event& event) { publisher_.report(event); }) {
    journal_.set_text("mission", std::filesystem::absolute(settings.mission).string());
    journal_.set_text("mission_file", std::filesystem::absolute(settings.mission_file()).string());
    journal_.set_text("executive", node.options().name);
    if (!mission_.executive.round_trips.empty())
      journal_.set_text("round_trips", journal::round_trips_text(mission_.executive.round_trips));
    if (reactor_.reactor().plans_continuously()) {
      engine_.emplace(
          node, [this](temporal::PlanDelta delta) { take(std::move(delta)); },
          [this](const Event& event) { intake_.tell(event); });
    }
    inputs_.epoch = epoch;
    recover();
    services::subscribe(node, topics::goal, [this](const v1::Goal& goal) { take(goal); });
    services::subscribe(node, topics::observation,
                        [this](const v1::Observation& observation) { take(observation); });
    services::subscribe(node, topics::command_ack, [this](const v1::CommandAck& ack) { take(ack); });
    services::subscribe(node, topics::function_offer, [this](const v1::FunctionOffer& offer) {
      const reactor::ModelVersion model{offer.owner(), offer.model_version()};
      if (!intake_.admits(model)) return;
      inputs_.models.push_back(model);
      timer_.step_soon();
    });
    node.on_peer_change([this](const services::health::PeerChange& change) { presence_.take(change); });
    if (leader_ != nullptr) join_pair();
    if (leader_ == nullptr && node.options().incarnation == 1) {
      listen_first();
    } else {
      timer_.step_soon();
    }
  }

  // A leader that stood down writes no summary: it would replace its successor's.
  ~ExecService() override {
    journal_watch_.stop();
    if (leader_ == nullptr || std::uncaught_exceptions() == 0) write_summary();
  }

 private:
  // Publishes every goal and the running plan again after a restart, for late joiners; the reactor itself
  // asks again for what was under way.
  void recover() {
    const Recovery& recovery = reactor_.recovery();
    journal_watch_.tell_damage();
    if (!recovery.restarted) return;
    const Reactor& reactor = reactor_.reactor();
    publisher_.send_goals(reactor);
    if (!recovery.resumed) {
      orders_.tell_concluded(reactor, recovery.until);
      return report_divergence(*recovery.divergence);
    }
    publisher_.send_plan(reactor);
    decisions_.tell(reactor);
    orders_.tell(reactor, recovery.until);
    if (engine_) engine_->tell(reactor.receipt());
    for (const Event& event : recovery.last_events) publisher_.report(event);
    presence_.recall_peers();
  }

  // Delays the first step, so that a second executive of this name ends before it begins anything
  // (services/health/namesake_watch.hpp). Under the simulated clock there is one of each name.
  void listen_first() {
    const auto& options = node_.options();
    if (options.clock != services::clock::ClockMode::live) return timer_.step_soon();
    timer_.step_first_after(temporal::seconds(kListenS * options.live_scale));
  }

  void report_divergence(const Divergence& divergence) {
    publisher_.report(
        {Severity::warning, "journal.diverged",
         "the journal does not lead to the state before the restart, all is planned anew: expected " +
             divergence.expected + ", got " + divergence.got});
  }

  void join_pair() {
    publisher_.let_commands_wait([this] { return leader_->may_command(); });
    leader_->on_hand_over([this](goals::GoalRecord goal) { take(std::move(goal)); });
    take_goals_apart();
    lead_owners();
    const bool live = node_.options().clock == services::clock::ClockMode::live;
    node_.on_turn([this, live] {
      if (live) publisher_.announce_epoch();
      if (live) tell_pair();
      publisher_.send_waiting();
    });
  }

  // Takes in the goals of journals that were replaced. It waits for the disk as a commit does.
  void take_goals_apart() {
    if (!apart_) return;
    inputs_.handed_over = apart_->goals();
    for (auto pause = disk_pause(node_, leader_); apart_->waits_for_disk();
         inputs_.handed_over = apart_->goals())
      pause.wait();
    for (const std::string& damage : apart_->take_damage())
      publisher_.report({Severity::error, "journal.damaged", damage});
  }

  // Tells the ground of the pair, in mission time: under the simulated clock with a step.
  void tell_pair() {
    for (const Event& event : leader_->take_events()) publisher_.report(event);
    if (!leader_->take_held()) return;
    publisher_.acknowledge_as(goals::AckStage::held_by_both);
    orders_.acknowledge_as(goals::AckStage::held_by_both);
    publisher_.send_goals(reactor_.reactor());
    orders_.tell_orders(reactor_.reactor());
  }

  // Requires the leases of the owners that the running plan commands, or of all while there is none.
  void lead_owners() {
    std::set<std::string> owners;
    for (const temporal::PlanActivity& activity : reactor_.reactor().plan().activities) {
      if (!activity.owner.empty()) owners.insert(activity.owner);
      for (const temporal::PlanCommand& command : activity.then) owners.insert(command.owner);
    }
    if (owners.empty()) owners = owners_of(mission_);
    leader_->require(owners);
  }

  // Takes in a goal as the other executive has it, which led apart.
  void take(goals::GoalRecord goal) {
    if (!intake_.admits(goal.request, inputs_.goals, node_.now())) return;
    inputs_.handed_over.push_back(std::move(goal));
    crash_.pass("after-hand-over");
    timer_.step_soon();
  }

  // Takes in a goal; one that now goes to another executive is recalled here.
  void take(const v1::Goal& goal) {
    GoalRequest request = from_wire(goal);
    if (addressee(mission_.role, request.robot) == mission::Addressee::another) {
      if (reactor_.reactor().goals().find(request.key) == nullptr) return;
      request.recalled = true;
    }
    if (!intake_.admits(request, inputs_.goals, node_.now())) return;
    inputs_.goals.push_back(std::move(request));
    crash_.pass("after-goal");
    timer_.step_soon();
  }

  void heed(const services::health::PeerChange& change) {
    publisher_.forget_told(change.service);
    if (change.alive) return;
    publisher_.lose_owner(change.service);
  }

  void lose(const std::string& service, const std::string& cause) {
    const bool observes = sources_.observes(service) || owners_of(mission_).contains(service);
    inputs_.losses.push_back({service, cause, observes});
    sources_.forget(service);
  }

  void take(const v1::Observation& observation) {
    if (observation.header().sender() == node_.options().name) return;  // a value that the ground has set
    if (!intake_.admits_timeline(observation.timeline())) return;
    if (!sources_.admit(observation.timeline(), observation.header().sender()))
      return strangers_.tell("timeline.contested", observation.header().sender() + " tells of " +
                                                       observation.timeline() + ", which " +
                                                       sources_.source(observation.timeline()) +
                                                       " observes; it is not believed");
    try {
      inputs_.observations.push_back(from_wire(observation));
    } catch (const services::wire::WireError& error) {
      intake_.tell(
          {Severity::warning, "observation.malformed", observation.timeline() + ": " + error.what()});
      return;
    }
    seen_.push_back(trace_line(observation));
    timer_.step_soon();
  }

  void take(temporal::PlanDelta delta) {
    inputs_.deltas.push_back(std::move(delta));
    timer_.step_soon();
  }

  void take(const v1::CommandAck& ack) {
    if (ack.commander() != node_.options().name || ack.epoch() == 0) return;
    if (ack.header().sender() != ack.owner())
      return strangers_.tell("ack.foreign",
                             ack.header().sender() + " acknowledges commands in the place of " + ack.owner());
    if (ack.refused_epoch() && !epoch_.take_refusal(ack)) return;
    if (OutputPublisher::answers_epoch(ack)) return;
    inputs_.acks.push_back(from_wire(ack));
    seen_.push_back(trace_line(ack));
    crash_.pass("after-ack");
    timer_.step_soon();
  }

  void take(GivenAnswer answer, std::string line) {
    if (!intake_.admits(answer)) return;
    inputs_.answers.push_back(std::move(answer));
    seen_.push_back(std::move(line));
    timer_.step_soon();
  }

  void take(orders::Order order, std::string line) {
    if (!intake_.admits(order)) return;
    inputs_.ground_orders.push_back(std::move(order));
    seen_.push_back(std::move(line));
    crash_.pass("after-order");
    timer_.step_soon();
  }

  void step() {
    crash_.pass("before-write-ahead");
    const ReactorOutputs out =
        reactor_.step(node_.now(), std::exchange(inputs_, {}), std::exchange(seen_, {}));
    crash_.pass("after-write-ahead");
    if (out.wake) timer_.step_at(*out.wake);
    if (apart_) std::exchange(apart_, std::nullopt)->remove();  // all of it stands in the journal now
    const Reactor& reactor = reactor_.reactor();
    if (leader_ != nullptr && out.adopted) lead_owners();
    auto send_all = [this, out, version = reactor.plan_version(),
                     actions = out.adopted ? reactor.planned_actions() : std::vector<PlannedAction>{},
                     status = mission_status(reactor, mission_), hash = reactor_.trace_sha256()] {
      if (leader_ != nullptr) crash_.pass("after-copy");
      send(out, version, actions);
      crash_.pass("after-send");
      if (publisher_.publish(status, hash) && !status.outcome().empty()) write_summary();
    };
    if (leader_ == nullptr) return send_all();
    leader_->send_once_copied(std::move(send_all), !out.commands.empty());
  }

  void send(const ReactorOutputs& out, std::uint32_t version, const std::vector<PlannedAction>& actions) {
    if (leader_ != nullptr) {
      publisher_.acknowledge_as(leader_->ack_stage());
      orders_.acknowledge_as(leader_->ack_stage());
    }
    publisher_.send(out, version, actions);
    decisions_.send(out);
    orders_.send(out);
    const auto is_open = [](const DecisionRecord& decision) {
      return decision.status.state == executive::DecisionState::open;
    };
    if (std::ranges::any_of(out.decisions, is_open)) crash_.pass("after-question");
    if (leader_ != nullptr) tell_pair();
    planner_.send(out);
    if (out.receipt) engine_->tell(*out.receipt);
  }

  void take(PlanReply reply) {
    inputs_.reply = std::move(reply);
    crash_.pass("after-answer");
    timer_.step_soon();
  }

  void write_summary() const {
    exec::write_summary(summary_file_, settings_, mission_, reactor_.reactor(),
                        {planner_.slowest_call_s(), planner_.peak_mib(), temporal::to_seconds(node_.now()),
                         reactor_.trace_sha256(), journal_.file(), epoch_.number()});
  }

  Node& node_;
  services::RunSettings settings_;
  MissionModel mission_;
  // This is set by the constructor, while the mission file is there; the destructor reads no files.
  std::filesystem::path summary_file_;
  Journal& journal_;
  LeaderService* leader_;            // none: no other executive follows
  std::optional<GoalsApart> apart_;  // until the first step has taken them in
  JournaledReactor reactor_;
  CrashPoints crash_;
  TimelineSources sources_;
  ReactorInputs inputs_;
  std::vector<std::string> seen_;  // the inputs' lines of the trace
  StepTimer timer_{node_, [this] { step(); }};

  std::optional<EngineLink> engine_;  // one that plans all the time
  PlannerLink planner_;
  OwnersPresence presence_;
  OutputPublisher publisher_;
  Strangers strangers_;
  CommandEpoch epoch_;
  JournalWatch journal_watch_;
  DecisionLink decisions_;
  OrderLink orders_;
  Intake intake_;
};

}  // namespace

std::unique_ptr<services::Service> make_executive(Node& node, const services::RunSettings& settings,
                                                  Journal& journal, std::uint64_t epoch) {
  return std::make_unique<ExecService>(node, settings, journal, epoch, nullptr, false);
}

std::unique_ptr<services::Service> make_executive(Node& node, const services::RunSettings& settings,
                                                  Journal& journal, LeaderService& leading, bool doubtful,
                                                  const GoalsApart& apart) {
  return std::make_unique<ExecService>(node, settings, journal, leading.epoch(), &leading, doubtful, apart);
}

}  // namespace roci::exec
