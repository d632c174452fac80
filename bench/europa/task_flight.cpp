#include "bench/europa/task_flight.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/bytes/fnv_1a.hpp"
#include "core/temporal/plan_delta.hpp"
#include "exec_svc/executive/executive.hpp"
#include "exec_svc/reactor/commitment.hpp"
#include "planner_svc/utility_htn/adapter/plan_of.hpp"
#include "planner_svc/utility_htn/checking/utility_checker.hpp"

namespace roci::bench::europa {

using exec::executive::Command, exec::executive::CommandAck, exec::executive::CommandAction,
    exec::executive::CommandStage, exec::executive::Executive, exec::executive::OutcomeKind;
using planner::engine::StepInputs, planner::engine::StepOutput;
using planner::utility_htn::model::Task;
using temporal::ActivityState, temporal::FlexiblePlan, temporal::PlanActivity, temporal::Time;

namespace {

namespace model = planner::utility_htn::model;
namespace adapter = planner::utility_htn::adapter;

exec::executive::ExecutiveSettings executive_settings() {
  exec::executive::ExecutiveSettings out;
  out.only_committed = true;
  return out;
}

/// Draws from the budget while a task runs.
struct Draw {
  double power = 0;   // per second, positive takes
  double at_end = 0;  // at once
  std::size_t execution = 0;
  bool rests = false;  // it waits for the ground and draws nothing
};

/// Is a moment at which an activity begins or ends to wait for the ground.
struct Rest {
  std::string activity;
  bool begins = false;
};

// Hashes all that an executive would act on.
void add(const temporal::PlanDelta& delta, bytes::Fnv1a& hash) {
  const auto number = [&](auto value) { hash.add(std::to_string(value) + ";"); };
  number(delta.added.version);
  for (const PlanActivity& activity : delta.added.activities) {
    hash.add(activity.id);
    number(activity.start_point);
    number(activity.preferred_start.count());
    number(activity.duration_lower.count());
    number(static_cast<int>(activity.commit));
  }
  for (const auto& constraint : delta.added.constraints) {
    number(constraint.to_point);
    number(constraint.lower.count());
  }
}

class TaskFlight {
 public:
  explicit TaskFlight(const Flight& flight)
      : flight_(flight),
        budget_(flight.network.timelines.at(flight.network.budget)),
        left_(budget_.initial),
        values_(model::priors(flight.network)) {}

  Flown run() {
    heard_.goals.push_back(mission_goal());
    heard_.receipt = planner::engine::Receipt{0, 0, "", "", true};
    for (const auto& timeline : flight_.network.timelines)
      if (timeline.reported) observe(timeline, timeline.initial);
    while (out_.ended_by.empty()) {
      turn();
      look();
      if (out_.ended_by.empty()) advance(next_time());
    }
    out_.end = now_;
    out_.spent = budget_.initial - left_;
    for (Execution& one : out_.executions)
      if (one.result.empty()) {
        one.end = now_;
        one.result = "cut off";
      }
    settle_energy();
    return std::move(out_);
  }

 private:
  static planner::engine::Goal mission_goal() {
    planner::engine::Goal out;
    out.issuer = "ground";
    out.id = "mission";
    out.kind = "network";
    return out;
  }

  void observe(const temporal::timelines::Definition& timeline, double value) {
    const temporal::Value seen = adapter::value_of(timeline, value);
    heard_.observations.push_back({timeline.name, seen, now_});
    inputs_.observations.push_back({timeline.name, seen});
  }

  void look() {
    if (!flight_.look_at || now_ < *flight_.look_at || out_.seen) return;
    std::map<temporal::timelines::Index, double> values = world_;
    values[flight_.network.budget] = left_;
    out_.seen = seen({flight_.network, plan_, progress_, std::move(values), now_}, flight_.look_for);
  }

  // Engine and executive in turn, until both have said all that there is to say at this time.
  void turn() {
    for (bool more = true; more && out_.ended_by.empty();) {
      more = step_engine();
      more = step_executive() || more;
    }
  }

  bool heard_something() const {
    return !heard_.goals.empty() || !heard_.observations.empty() || !heard_.steps.empty() || heard_.receipt;
  }

  bool step_engine() {
    const bool due = engine_wake_ && *engine_wake_ <= now_;
    if (!due && !heard_something()) return false;
    if (due) observe(budget_, left_);
    StepInputs inputs = std::exchange(heard_, {});
    inputs.now = now_;
    inputs.last_version = last_version_;
    const double before = seconds();
    const StepOutput output = flight_.engine.step(inputs);
    if (flight_.processor_time)
      out_.steps.push_back({now_, seconds() - before, output.wake != told_wake_, output.account.parts.size(),
                            output.account.explored, output.delta.has_value()});
    told_wake_ = engine_wake_ = output.wake;
    if (engine_wake_ && *engine_wake_ <= now_) engine_wake_.reset();
    if (output.delta) take(*output.delta);
    return output.delta.has_value();
  }

  double seconds() const { return flight_.processor_time ? flight_.processor_time() : 0; }

  void take(const temporal::PlanDelta& delta) {
    add(delta, decided_);
    out_.decisions = decided_.value();
    last_version_ = delta.added.version;
    FlexiblePlan next = plan_;
    std::string fault = temporal::apply(delta, next);
    // Before the executive checks it again: what looks for violations trusts the plan's form.
    if (fault.empty())
      if (const auto faults = temporal::check(next); !faults.empty()) fault = faults.front();
    if (fault.empty()) fault = exec::reactor::commitment_violation(plan_, executive_.steps(), next, now_);
    if (fault.empty() && flight_.strategy == Strategy::replanning) fault = checkers_fault(next);
    planner::engine::Receipt receipt{plan_.version, 0, "", "", true};
    if (fault.empty()) {
      plan_ = std::move(next);
      receipt.version = plan_.version;
      ++out_.versions;
      FlexiblePlan loaded = plan_;
      if (flight_.strategy == Strategy::as_planned || flight_.strategy == Strategy::ground) rigid(loaded);
      executive_.load(std::move(loaded), now_);
      blocks_.clear();  // points are given again
      for (const temporal::Token& token : plan_.tokens)
        if (token.start_point != temporal::origin_point) blocks_.emplace(token.end_point, token);
    } else {
      receipt.refused = delta.added.version;
      receipt.reason = fault;
      out_.faults.push_back("version " + std::to_string(delta.added.version) + ": " + fault);
    }
    heard_.receipt = receipt;
    stepped_ = false;
  }

  // What planner_svc asks before it sends a version. A plan that is kept whatever happens may come to have conflicts.
  std::string checkers_fault(const FlexiblePlan& next) const {
    planner::engine::Request situation;
    situation.origin = now_;
    situation.state[budget_.name] = left_;
    for (const auto& [index, value] : world_) {
      const auto& timeline = flight_.network.timelines[index];
      situation.state[timeline.name] = adapter::value_of(timeline, value);
    }
    const auto faults = planner::utility_htn::checking::faults_of(
        flight_.network, {situation, {}, next, plan_.version == 0 ? nullptr : &plan_, &progress_});
    return faults.empty() ? std::string() : faults.front();
  }

  // Without flexible execution nothing is tried again by the executive itself; it still waits for what is late, since
  // the world of these experiments has no lateness but what resolving a failure takes.
  static void rigid(FlexiblePlan& plan) {
    for (PlanActivity& activity : plan.activities) activity.retries = 0;
  }

  bool step_executive() {
    const bool due = executive_wake_ && *executive_wake_ <= now_;
    std::vector<CommandAck> acks;
    for (auto end = ends_.begin(); end != ends_.end() && end->first <= now_; end = ends_.erase(end)) {
      acks.push_back(end->second);
      const Task* const task = task_of(end->second.activity);
      if (task != nullptr && end->second.stage == CommandStage::completed)
        report_effects(*task, temporal::ImpactWhen::at_end);
    }
    if (stepped_ && !due && acks.empty() && inputs_.observations.empty() && inputs_.acks.empty())
      return false;
    stepped_ = true;
    inputs_.acks.insert(inputs_.acks.end(), acks.begin(), acks.end());
    const double before = seconds();
    const exec::executive::Outputs outputs = executive_.step(now_, std::exchange(inputs_, {}));
    if (flight_.processor_time) out_.events.push_back(seconds() - before);
    executive_wake_ = outputs.next_wake;
    if (executive_wake_) executive_wake_ = std::max(*executive_wake_, now_ + std::chrono::microseconds(1));
    for (const auto& status : outputs.changes) take(status);
    for (const Command& command : outputs.commands) begin(command);
    finished_ = outputs.outcome.kind == OutcomeKind::finished;
    return true;
  }

  const Task* task_of(const std::string& activity) const {
    const auto found =
        std::ranges::find(flight_.network.tasks, activity.substr(0, activity.rfind('#')), &Task::id);
    return found == flight_.network.tasks.end() ? nullptr : &*found;
  }

  void take(const exec::executive::StepStatus& status) {
    planner::engine::StepStatus step;
    step.plan_version = plan_.version;
    step.activity = status.activity;
    step.progress = {status.state, status.started, status.ended};
    step.cause = status.reason;
    step.attempt = status.attempt;
    heard_.steps.push_back(step);
    progress_.insert_or_assign(step.activity, step.progress);
    const Task* const task = task_of(status.activity);
    if (task == nullptr) return;
    if (status.state == ActivityState::running && task->commands.empty()) {
      draw(status.activity, *task, 1);
      report_effects(*task, temporal::ImpactWhen::at_start);
    }
    if (!temporal::is_over(status.state)) return;
    settle_draw(status.activity, status.state == ActivityState::succeeded, "done");
    if (status.state == ActivityState::succeeded) {
      ++out_.tasks;
      if (flight_.succeeded) flight_.succeeded(task->id);
      if (const auto id = adapter::task_of(status.activity)) succeeded_.insert(*id);
      count_blocks(status.activity);
      if (task->commands.empty()) report_effects(*task, temporal::ImpactWhen::at_end);
    }
    observe(budget_, left_);
  }

  // Utility counts when a chain is executed to its end (R90).
  void count_blocks(const std::string& activity) {
    const auto of = std::ranges::find(plan_.activities, activity, &PlanActivity::id);
    const auto id = adapter::task_of(activity);
    if (of == plan_.activities.end() || !id) return;
    const auto token = blocks_.find(of->end_point);
    if (token == blocks_.end()) return;
    const std::uint32_t block = planner::utility_htn::cycle::block_of(*id);
    for (std::size_t link = 0; link < planner::utility_htn::cycle::link_of(*id); ++link)
      if (!succeeded_.contains(planner::utility_htn::cycle::task_id(block, link))) return;
    for (const PlanActivity& link : plan_.activities) {
      const auto other = adapter::task_of(link.id);
      if (other && planner::utility_htn::cycle::block_of(*other) == block) out_.utility += link.utility;
    }
    out_.course.push_back({budget_.initial - left_, out_.utility, token->second.timeline});
    completed_.insert(block);
    blocks_.erase(token);
  }

  void draw(const std::string& activity, const Task& task, double factor) {
    Draw out;
    double at_start = 0;
    for (const model::Impact& impact : task.impacts) {
      if (impact.timeline != flight_.network.budget) continue;
      const double amount = -factor * model::evaluate(impact.amount, values_);
      if (impact.kind == temporal::ImpactKind::rate) out.power += amount;
      if (impact.kind != temporal::ImpactKind::delta) continue;
      if (impact.moment == temporal::ImpactWhen::at_end) out.at_end += amount;
      if (impact.moment == temporal::ImpactWhen::at_start) at_start += amount;
    }
    out.execution = out_.executions.size();
    out_.executions.push_back({task.id, {}, 0, now_, now_, spend(at_start), {}});
    if (const auto id = adapter::task_of(activity)) {
      const std::uint32_t block = planner::utility_htn::cycle::block_of(*id);
      out_.executions.back().block = block;
      const auto of = std::ranges::find_if(plan_.tokens, [&](const temporal::Token& token) {
        const auto* const held = std::get_if<temporal::State>(&token.held);
        return token.start_point != temporal::origin_point && held != nullptr &&
               held->arguments == std::vector{std::to_string(block)};
      });
      if (of != plan_.tokens.end()) out_.executions.back().chain = std::get<temporal::State>(of->held).name;
    }
    draws_[activity] = out;
  }

  // What a task does to the lander is seen on the timelines that are reported; the budget is told by itself.
  void report_effects(const Task& task, temporal::ImpactWhen moment) {
    for (const model::Impact& impact : task.impacts) {
      const auto& timeline = flight_.network.timelines[impact.timeline];
      const bool lasts = impact.kind != temporal::ImpactKind::rate && impact.moment == moment;
      if (!timeline.reported || impact.timeline == flight_.network.budget || !lasts) continue;
      double& value = world_.try_emplace(impact.timeline, timeline.initial).first->second;
      const double amount = model::evaluate(impact.amount, values_);
      value = impact.kind == temporal::ImpactKind::assign ? amount : value + amount;
      observe(timeline, value);
    }
  }

  void settle_draw(const std::string& activity, bool succeeded, const std::string& result) {
    const auto found = draws_.find(activity);
    if (found == draws_.end()) return;
    Execution& execution = out_.executions[found->second.execution];
    if (succeeded) execution.spent += spend(found->second.at_end);
    execution.end = now_;
    if (execution.result.empty()) execution.result = succeeded ? result : "failed";
    draws_.erase(found);
  }

  void settle_energy() {
    std::set<std::string> fixed;
    for (const Task& task : flight_.network.tasks)
      if (task.fixed) fixed.insert(task.id);
    out_.energy.recovering = recovering_;
    for (const Execution& one : out_.executions) {
      if (fixed.contains(one.task)) {
        out_.energy.fixed += one.spent;
      } else if (!completed_.contains(one.block)) {
        out_.energy.broken_off += one.spent;
      } else if (one.result == "failed") {
        out_.energy.recovering += one.spent;
      } else {
        const double wasted = one.result == "by ground" ? one.spent / 2 : 0;  // of two equal attempts one
        out_.energy.completed += one.spent - wasted;
        out_.energy.recovering += wasted;
      }
    }
  }

  void begin(const Command& command) {
    if (command.action != CommandAction::execute) {
      inputs_.acks.push_back({command.activity, command.attempt, CommandStage::cancelled, "", ""});
      return;
    }
    const Task* const task = task_of(command.activity);
    if (task == nullptr) return;
    inputs_.acks.push_back({command.activity, command.attempt, CommandStage::accepted, "", ""});
    const Fate fate = fate_of(*task, command);
    settle_draw(command.activity, false, {});  // of the attempt before
    draw(command.activity, *task, fate.energy);
    report_effects(*task, temporal::ImpactWhen::at_start);
    const double length = fate.duration * model::evaluate(task->duration, values_);
    Time end = now_ + temporal::seconds(length);
    CommandStage stage = CommandStage::completed;
    if (fate.failure != Resolution::none) {
      ++out_.failures;
      stage = resolve(command.activity, *task, fate.failure, end);
    }
    ends_.emplace(end, CommandAck{command.activity, command.attempt, stage, "", ""});
  }

  // What was resolved once works: the next attempt of the same activity, or the next execution of the task, does not
  // fail. What the ground resolves is done again by the same execution.
  Fate fate_of(const Task& task, const Command& command) {
    if (command.attempt == 1)
      activity_fates_[command.activity] = flight_.fates(task.id, executions_[task.id]++);
    Fate fate = activity_fates_[command.activity];
    if (resolved_.erase(task.id) > 0) fate.failure = Resolution::none;
    return fate;
  }

  CommandStage resolve(const std::string& activity, const Task& task, Resolution failure, Time& end) {
    const Strategy strategy = flight_.strategy;
    if (strategy == Strategy::as_planned) {
      fails_at_ = end;
    } else if (failure == Resolution::flexible && strategy >= Strategy::flexible_execution) {
      ++out_.retried;
      resolved_.insert(task.id);
      return CommandStage::failed;
    } else if (failure != Resolution::ground && strategy == Strategy::replanning) {
      ++out_.replanned;
      resolved_.insert(task.id);
      recovering_ += spend(flight_.costs.replanning_j);
      // What its owner has given up the executive does not try again: the chain is broken off,
      // and the engine plans anew.
      return CommandStage::cancelled;
    } else {
      ++out_.by_ground;
      recovering_ += spend(flight_.costs.ground_j);
      out_.executions[draws_.at(activity).execution].result = "by ground";
      const Time failed = end;
      end += flight_.costs.ground_wait + (end - now_);
      rests_.emplace(failed, Rest{activity, true});
      rests_.emplace(failed + flight_.costs.ground_wait, Rest{activity, false});
      return CommandStage::completed;
    }
    return CommandStage::failed;
  }

  // Returns how much of it there was.
  double spend(double amount) {
    const double before = left_;
    left_ = std::max(budget_.lowest, left_ - amount);
    return before - left_;
  }

  double power() const {
    double out = 0;
    for (const auto& [activity, draw] : draws_) out += draw.rests ? 0 : draw.power;
    return out;
  }

  void spend_for(double seconds) {
    for (const auto& [activity, draw] : draws_)
      if (!draw.rests) out_.executions[draw.execution].spent += draw.power * seconds;
  }

  void change_rests() {
    for (auto rest = rests_.begin(); rest != rests_.end() && rest->first <= now_; rest = rests_.erase(rest))
      if (const auto draw = draws_.find(rest->second.activity); draw != draws_.end())
        draw->second.rests = rest->second.begins;
  }

  Time next_time() const {
    Time next = flight_.until;
    const auto sooner = [&](Time at) { next = std::min(next, std::max(at, now_)); };
    if (engine_wake_ && !idle()) sooner(*engine_wake_);
    if (executive_wake_) sooner(*executive_wake_);
    if (!ends_.empty()) sooner(ends_.begin()->first);
    if (!rests_.empty()) sooner(rests_.begin()->first);
    if (fails_at_) sooner(*fails_at_);
    return next;
  }

  // Nothing runs, nothing waits, and the engine has had a cycle to think of something else.
  bool idle() const { return finished_ && idle_cycles_ > 2; }

  void advance(Time to) {
    if (to == flight_.until && finished_) {
      out_.ended_by = "nothing left";
      return;
    }
    const double drawn = power();
    const double needed = drawn * temporal::to_seconds(to - now_);
    if (left_ - needed <= budget_.lowest) {
      const double lasts = drawn > 0 ? std::max(0.0, left_ - budget_.lowest) / drawn : 0;
      spend_for(lasts);
      now_ += temporal::seconds(lasts);
      left_ = std::min(left_, budget_.lowest);
      out_.ended_by = "budget";
      return;
    }
    spend_for(temporal::to_seconds(to - now_));
    left_ -= needed;
    now_ = to;
    change_rests();
    idle_cycles_ = finished_ ? idle_cycles_ + 1 : 0;
    if (fails_at_ && now_ >= *fails_at_) out_.ended_by = "failure";
    if (now_ >= flight_.until) out_.ended_by = "time";
  }

  const Flight& flight_;
  const temporal::timelines::Definition& budget_;
  double left_;
  model::Values values_;
  Time now_{0};
  Executive executive_{executive_settings()};
  FlexiblePlan plan_;
  temporal::Progress progress_;
  std::uint32_t last_version_ = 0;
  StepInputs heard_;
  exec::executive::Inputs inputs_;
  bool stepped_ = true;
  std::optional<Time> engine_wake_, told_wake_, executive_wake_, fails_at_;
  std::multimap<Time, CommandAck> ends_;
  std::multimap<Time, Rest> rests_;
  double recovering_ = 0;
  std::set<std::uint32_t> completed_;                   // blocks
  std::map<std::string, Draw> draws_;                   // by activity
  std::map<temporal::timelines::Index, double> world_;  // true values of reported timelines that were changed
  std::map<std::string, std::uint32_t> executions_;
  std::map<std::string, Fate> activity_fates_;
  std::set<std::string> resolved_;
  std::set<planner::utility_htn::cycle::TaskId> succeeded_;
  std::map<temporal::TimePoint, temporal::Token> blocks_;  // by the end of the last link
  bool finished_ = false;
  int idle_cycles_ = 0;
  bytes::Fnv1a decided_;  // of all versions
  Flown out_;
};

}  // namespace

Flown fly(const Flight& flight) { return TaskFlight(flight).run(); }

}  // namespace roci::bench::europa
