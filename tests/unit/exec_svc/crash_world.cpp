#include "tests/unit/exec_svc/crash_world.hpp"

#include <unistd.h>

#include <utility>

#include "tests/unit/exec_svc/planetary_fixture.hpp"
#include "tests/unit/exec_svc/reactor_fixture.hpp"

namespace roci::exec::testing {

using executive::Command;
using executive::CommandAck;
using executive::CommandStage;
using executive::Observation;
using goals::GoalRecord;
using goals::GoalRequest;
using journal::Durability;
using journal::JournaledReactor;
using reactor::PlanReply;
using reactor::ReactorOutputs;
using temporal::Verdict;

namespace {

namespace fs = std::filesystem;

constexpr temporal::Duration kImage = temporal::seconds(40);
constexpr temporal::Duration kPlanning = temporal::seconds(0.5);

void remove_journal(const fs::path& file) {
  for (const char* suffix : {"", "-wal", "-shm"}) fs::remove(file.string() + suffix);
}

}  // namespace

CrashWorld::CrashWorld(const CrashPlan& crash)
    : file_(fs::temp_directory_path() / ("roci_crash_" + std::to_string(::getpid()) + ".sqlite")),
      crash_(crash),
      mission_(planetary()) {
  mission_.executive.keep_inputs = !crash.compact;
  mission_.executive.kept_records = crash.kept_records;
  mission_.executive.replanning = crash.replanning;
  remove_journal(file_);
  for (const Observation& observation : standing_robot()) observe(observation.timeline, observation.value);
}

CrashWorld::~CrashWorld() {
  executive_.reset();
  journal_.reset();
  remove_journal(file_);
}

void CrashWorld::send(double at_s, const GoalRequest& goal) {
  later(temporal::seconds(at_s), [this, goal] {
    goals_[goal.key] = goal;
    pending_.goals.push_back(goal);
  });
}

void CrashWorld::start() {
  executive_.reset();
  journal_.emplace(file_, Durability::process);
  executive_ = std::make_unique<JournaledReactor>(mission_, *journal_);
  ++incarnation_;
  if (executive_->recovery().restarted && !executive_->recovery().resumed) ++flight_.not_resumed;
  pending_ = {};
  for (const auto& [key, goal] : goals_) pending_.goals.push_back(goal);
  for (const auto& [timeline, observation] : observations_) pending_.observations.push_back(observation);
  for (const auto& [key, ack] : acks_) pending_.acks.push_back(ack);
  if (!executive_->recovery().resumed) pending_.arrivals = {"sim_svc", "planner_svc"};
  wake_ = now_;
}

void CrashWorld::turn() {
  const bool dies = crash_.turns.contains(flight_.turns++);
  if (dies && crash_.moment == Moment::before_write_ahead) throw Dead{};
  ReactorOutputs out = executive_->step(now_, std::exchange(pending_, {}), {});
  if (dies && crash_.moment == Moment::after_write_ahead) throw Dead{};
  if (dies && crash_.moment == Moment::during_send) {
    if (out.commands.size() > 1) out.commands.resize(1);
    out.call.reset();
  }
  wake_ = out.wake;
  deliver(out);
  if (dies) throw Dead{};
}

void CrashWorld::deliver(const ReactorOutputs& out) {
  for (const Command& command : out.commands) obey(command);
  if (!out.call) return;
  later(kPlanning, [this, id = out.call->id, caller = incarnation_] {
    if (caller != incarnation_) return;
    PlanReply reply;
    reply.call = id;
    reply.verdict = Verdict::solved;
    std::vector<std::string> ids;
    for (const GoalRecord* goal : executive_->reactor().goals().open()) ids.push_back(goal->request.key.id);
    reply.plan = images(ids);
    pending_.reply = std::move(reply);
  });
}

void CrashWorld::obey(const Command& command) {
  using services::owner::Reception;
  const services::owner::CommandKey key{command.activity, command.attempt};
  const auto action = static_cast<services::owner::Action>(command.action);
  const Reception reception = ledger_.receive({key, action}, now_);
  if (reception.ack) {
    const services::owner::CommandStatus& status = reception.ack->status;
    return tell(command, static_cast<CommandStage>(status.stage), status.code);
  }
  if (reception.order == Reception::Order::break_off) {
    imaging_.reset();
    observe("rover.camera", state("idle"));
    return tell(command, CommandStage::cancelled);
  }
  ++flight_.carried_out[{command.activity, command.attempt}];
  if (command.command_name == "image") return take_image(command);
  if (imaging_) tell(*std::exchange(imaging_, std::nullopt), CommandStage::cancelled);
  observe("rover.camera", state("idle"));
  tell(command, CommandStage::completed);
}

void CrashWorld::take_image(const Command& command) {
  if (imaging_) return tell(command, CommandStage::rejected, "busy");
  const std::string image = command.arguments.front().value;
  ++flight_.images[image];
  imaging_ = command;
  tell(command, CommandStage::accepted);
  observe("rover.camera", state("imaging"));
  later(kImage, [this, command, image] {
    if (!imaging_ || imaging_->activity != command.activity) return;
    imaging_.reset();
    observe("rover.camera", state("idle"));
    const bool works = broken_.erase(image) == 0;
    if (works) observe("rover.image." + image, state("sent"));
    tell(command, works ? CommandStage::completed : CommandStage::failed, works ? "" : "shutter");
  });
}

void CrashWorld::tell(const Command& command, CommandStage stage, const std::string& code) {
  const services::owner::CommandKey key{command.activity, command.attempt};
  const CommandAck ack{command.activity, command.attempt, stage, code, ""};
  if (stage != CommandStage::unknown && stage != CommandStage::cancel_failed)
    ledger_.say(key, {static_cast<services::owner::Stage>(stage), code, ""}, now_);
  acks_[key] = ack;
  pending_.acks.push_back(ack);
}

void CrashWorld::observe(const std::string& timeline, const temporal::Value& value) {
  observations_[timeline] = {timeline, value};
  pending_.observations.push_back({timeline, value});
}

void CrashWorld::later(temporal::Duration delay, std::function<void()> what) {
  events_.emplace(now_ + delay, std::move(what));
}

Flight CrashWorld::fly(double until_s) {
  const auto advance_to = [this](temporal::Time end) {
    while (!events_.empty() && events_.begin()->first <= end) {
      const auto event = events_.extract(events_.begin());
      now_ = event.key();
      event.mapped()();
    }
    now_ = end;
  };
  start();
  while (now_ < temporal::seconds(until_s)) {
    try {
      const bool due = (wake_ && *wake_ <= now_) || !is_empty(pending_);
      if (due) {
        turn();
        continue;
      }
      temporal::Time next = temporal::seconds(until_s);
      if (wake_) next = std::min(next, *wake_);
      if (!events_.empty()) next = std::min(next, events_.begin()->first);
      advance_to(next);
    } catch (const Dead&) {
      advance_to(now_ + crash_.away);
      start();
    }
  }
  for (const GoalRecord* goal : executive_->reactor().goals().all())
    flight_.goals[goal->request.key.id] = goal->state;
  flight_.plan_version = executive_->reactor().plan_version();
  flight_.trace_sha256 = executive_->trace_sha256();
  flight_.outcome = executive_->reactor().outcome();
  return flight_;
}

}  // namespace roci::exec::testing
