#include "exec_svc/exec_service.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "exec_svc/journal/journal.hpp"
#include "exec_svc/journal/trace.hpp"
#include "exec_svc/wire_service.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "services/wire/plan_wire.hpp"

namespace roci::exec {
namespace {

namespace topics = services::topics;
using services::Node;

Durability durability_for(const Node& node) {
  return node.options().clock == services::ClockMode::live ? Durability::power : Durability::process;
}

v1::MissionPhase phase_to_wire(Phase phase) { return static_cast<v1::MissionPhase>(phase); }

// Activity, state, window of its start in microseconds of mission time (-1: no bound), cause.
std::string journal_line(const StepStatus& step) {
  const std::int64_t latest = step.latest_start == temporal::no_bound ? -1 : step.latest_start.count();
  return step.activity + " " + std::to_string(static_cast<int>(step.state)) + " [" +
         std::to_string(step.earliest_start.count()) + "," + std::to_string(latest) + "] " + step.cause;
}

// Collects what comes in one turn of the loop, steps the reactor once, journals what it decided, then sends
// it.
class ExecService final : public services::Service {
 public:
  ExecService(Node& node, const services::RunSettings& settings)
      : node_(node),
        settings_(settings),
        mission_(read_mission(settings.mission)),
        journal_(settings.run_folder / "journal.sqlite", durability_for(node)),
        epoch_(journal_.next_epoch()),
        reactor_(mission_),
        planner_(node, topics::plan_request),
        commands_(services::advertise(node, topics::command)),
        goal_statuses_(services::advertise(node, topics::goal_status)),
        plans_(services::advertise(node, topics::plan)),
        steps_(services::advertise(node, topics::step_status)),
        missions_(services::advertise(node, topics::mission_status)),
        events_(services::advertise(node, topics::event)) {
    recover();
    services::subscribe(node, topics::goal, [this](const v1::Goal& goal) {
      inputs_.goals.push_back(wire::from_wire(goal));
      step_soon();
    });
    services::subscribe(node, topics::observation,
                        [this](const v1::Observation& observation) { take(observation); });
    services::subscribe(node, topics::command_ack, [this](const v1::CommandAck& ack) { take(ack); });
    services::subscribe(node, topics::function_offer, [this](const v1::FunctionOffer& offer) {
      inputs_.models.push_back({offer.owner(), offer.model_version()});
      step_soon();
    });
    node.on_peer_change([this](const services::PeerChange& change) {
      if (change.alive) {
        inputs_.arrivals.push_back(change.service);
      } else {
        inputs_.losses.push_back({change.service, change.cause});
      }
      step_soon();
    });
    step_soon();
  }

  ~ExecService() override { write_summary(); }

 private:
  // After a restart: goals and the trace so far come from the journal, the world from observations. Who joins
  // now hears of every goal, as before.
  void recover() {
    journal_.for_each([this](temporal::Time, std::string_view kind, std::string_view text) {
      if (kind == "trace") trace_.add(text);
    });
    const std::vector<GoalRecord> goals = journal_.goals();
    reactor_.restore(goals, static_cast<std::uint32_t>(journal_.number("plan_version", 0)));
    for (const GoalRecord& goal : goals) goal_statuses_.write(wire::to_wire(goal));
  }

  void take(const v1::Observation& observation) {
    try {
      inputs_.observations.push_back(wire::from_wire(observation));
    } catch (const services::wire::WireError& error) {
      report({NoteLevel::warning, "observation.malformed", observation.timeline() + ": " + error.what()});
      return;
    }
    record(wire::trace_line(observation));
    step_soon();
  }

  void take(const v1::CommandAck& ack) {
    inputs_.acks.push_back(wire::from_wire(ack));
    record(wire::trace_line(ack));
    step_soon();
  }

  void step_soon() {
    if (step_due_) return;
    step_due_ = true;
    node_.at(node_.now(), [this] { step(); });
  }

  void step() {
    step_due_ = false;
    const ReactorInputs inputs = std::exchange(inputs_, {});
    const ReactorOutputs out = reactor_.step(node_.now(), inputs);
    write_ahead(out);
    send(out);
    publish_mission();
    if (out.wake) wake_at(*out.wake);
  }

  void wake_at(temporal::Time time) {
    if (wake_timer_) node_.cancel(*wake_timer_);
    wake_timer_ = node_.at(std::max(time, node_.now()), [this] {
      wake_timer_.reset();
      step_soon();
    });
  }

  void record(const std::string& line) {
    const std::string stamped = std::to_string(node_.now().count()) + " " + line;
    journal_.append(node_.now(), "trace", stamped);
    trace_.add(stamped);
  }

  // Nothing is acknowledged or commanded before it stands in the journal.
  void write_ahead(const ReactorOutputs& out) {
    for (const GoalRecord& goal : out.goal_changes) journal_.put_goal(goal);
    for (const Note& note : out.notes) journal_.append(node_.now(), "event", note.code + " " + note.text);
    for (const StepStatus& step : out.steps) journal_.append(node_.now(), "step", journal_line(step));
    if (out.adopted) {
      journal_.set_number("plan_version", reactor_.plan_version());
      record(wire::trace_line(services::wire::to_wire(*out.adopted)));
    }
    for (const Command& command : out.commands)
      record(wire::trace_line(wire::to_wire(command, reactor_.plan_version(), epoch_)));
    journal_.commit();
  }

  void send(const ReactorOutputs& out) {
    for (const GoalRecord& goal : out.goal_changes) goal_statuses_.write(wire::to_wire(goal));
    if (out.adopted) plans_.write(services::wire::to_wire(*out.adopted));
    for (const Command& command : out.commands)
      commands_.write(wire::to_wire(command, reactor_.plan_version(), epoch_));
    for (const StepStatus& step : out.steps) steps_.write(wire::to_wire(step, reactor_.plan_version()));
    for (const Note& note : out.notes) report(note);
    if (out.call) call_planner(*out.call);
  }

  void report(const Note& note) { events_.write(wire::to_wire(note)); }

  void call_planner(const PlanCall& call) {
    journal_.append(node_.now(), "call", call.problem.text);
    planner_.call(
        wire::to_wire(call, mission_), "planner_svc", mission_.planner.reply_timeout,
        [this, id = call.id](const services::CallResult<v1::PlanReply>& result) { take(id, result); });
  }

  void take(std::uint64_t call, const services::CallResult<v1::PlanReply>& result) {
    PlanAnswer answer;
    answer.call = call;
    answer.verdict = PlanVerdict::no_reply;
    answer.reason = result.message;
    if (result.status == services::CallStatus::ok) {
      slowest_call_s_ = std::max(slowest_call_s_, result.reply.statistics().wall_s());
      planner_peak_kb_ = std::max(planner_peak_kb_, result.reply.statistics().peak_rss_kb());
      try {
        answer = wire::from_wire(call, result.reply);
      } catch (const services::wire::WireError& error) {
        answer.verdict = PlanVerdict::crashed;
        answer.reason = error.what();
      }
    }
    inputs_.answer = std::move(answer);
    step_soon();
  }

  void publish_mission() {
    v1::MissionStatus status;
    const ReactorCounts counts = reactor_.counts();
    status.mission(mission_.name);
    status.phase(phase_to_wire(reactor_.phase()));
    status.plan_version(reactor_.plan_version());
    status.replans(counts.replans);
    status.goals_achieved(counts.achieved);
    status.goals_dropped(counts.dropped);
    status.goals_failed(counts.failed);
    status.goals_open(counts.open);
    status.outcome(reactor_.outcome());
    for (const WindowModel& window : mission_.windows) {
      for (const auto& [opens, closes] : window.open) {
        v1::PredictedWindow predicted;
        predicted.timeline(window.timeline);
        predicted.opens_us(opens.count());
        predicted.closes_us(closes.count());
        status.windows().push_back(predicted);
      }
    }
    if (status == last_status_) return;
    last_status_ = status;
    status.trace_sha256(trace_.sha256());
    missions_.write(status);
    if (!status.outcome().empty()) write_summary();
  }

  // The part of the run's summary that this service knows; the launcher adds the rest.
  void write_summary() const {
    const ReactorCounts counts = reactor_.counts();
    const std::string outcome = reactor_.outcome();
    const nlohmann::json summary{{"mission", mission_.name},
                                 {"scenario", settings_.scenario},
                                 {"seed", settings_.seed},
                                 {"result", outcome.empty() ? "failed" : outcome},
                                 {"goals",
                                  {{"achieved", counts.achieved},
                                   {"dropped", counts.dropped},
                                   {"failed", counts.failed},
                                   {"open", counts.open}}},
                                 {"planner",
                                  {{"calls", counts.planner_calls},
                                   {"max_s", slowest_call_s_},
                                   {"max_rss_mb", planner_peak_kb_ / 1024.0}}},
                                 {"replans", counts.replans},
                                 {"sim_s", temporal::to_seconds(node_.now())},
                                 {"trace_sha256", trace_.sha256()}};
    std::ofstream(settings_.run_folder / "summary.json") << summary.dump(2) << "\n";
  }

  Node& node_;
  services::RunSettings settings_;
  MissionModel mission_;
  Journal journal_;
  std::uint64_t epoch_;
  Trace trace_;
  Reactor reactor_;
  ReactorInputs inputs_;
  bool step_due_ = false;
  std::optional<Node::TimerId> wake_timer_;
  v1::MissionStatus last_status_;
  double slowest_call_s_ = 0;
  std::uint32_t planner_peak_kb_ = 0;

  services::Client<v1::PlanRequest, v1::PlanReply> planner_;
  services::Publisher<v1::Command> commands_;
  services::Publisher<v1::GoalStatus> goal_statuses_;
  services::Publisher<v1::Plan> plans_;
  services::Publisher<v1::StepStatus> steps_;
  services::Publisher<v1::MissionStatus> missions_;
  services::Publisher<v1::Event> events_;
};

}  // namespace

std::unique_ptr<services::Service> make_service(Node& node, const services::RunSettings& settings) {
  return std::make_unique<ExecService>(node, settings);
}

}  // namespace roci::exec
