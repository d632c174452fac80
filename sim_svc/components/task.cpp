#include "sim_svc/components/task.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "sim_svc/components/argument_slots.hpp"

namespace roci::sim::components {

using temporal::State;
using temporal::Time;
using world::Ending;
using world::Failure;
using world::Surroundings;

namespace {

constexpr double kShortest = 0.5;  // share of the duration that noise leaves at least

State filled(const StateTemplate& form, const std::map<std::string, std::string>& arguments) {
  State out{fill_slots(form.name, arguments), {}};
  for (const std::string& argument : form.arguments) out.arguments.push_back(fill_slots(argument, arguments));
  return out;
}

Ending unmet(const std::map<std::string, std::string>& needs, const world::ComponentSet& components) {
  for (const auto& [name, wanted] : needs) {
    const world::Component* other = components.named(name);
    if (!other) return Failure{"not-ready", "there is no component '" + name + "'"};
    if (const State state = other->state(); state.name != wanted) {
      return Failure{"not-ready", name + " is " + temporal::to_text(state) + ", not " + wanted};
    }
  }
  return std::nullopt;
}

}  // namespace

TaskComponent::TaskComponent(TaskSettings settings, world::RandomStream noise)
    : settings_(std::move(settings)), state_(filled(settings_.start, {})), noise_(std::move(noise)) {
  for (const TaskNumber& number : settings_.numbers) values_.push_back(number.start);
}

std::vector<world::CommandForm> TaskComponent::commands() const {
  std::vector<world::CommandForm> out;
  for (const TaskCommand& command : settings_.commands) out.push_back({command.name, command.arguments});
  return out;
}

std::vector<world::StateForm> TaskComponent::state_forms() const {
  std::set<world::StateForm> out;
  const auto add = [&](const StateTemplate& state) { out.insert({state.name, state.arguments.size()}); };
  add(settings_.start);
  for (const TaskCommand& command : settings_.commands) {
    add(command.during.value_or(StateTemplate{command.name, {}}));
    if (command.then) add(*command.then);
    if (command.stopped) add(*command.stopped);
  }
  return {out.begin(), out.end()};
}

std::vector<world::ThingForm> TaskComponent::thing_forms() const {
  std::map<std::string, std::set<world::StateForm>> families;
  for (const TaskCommand& command : settings_.commands)
    for (const auto& [thing, state] : command.leaves)
      families[thing.substr(0, thing.find('.'))].insert({state.name, state.arguments.size()});
  std::vector<world::ThingForm> out;
  for (const auto& [family, states] : families) out.push_back({family, {states.begin(), states.end()}});
  return out;
}

Ending TaskComponent::begin(const world::Task& task, Time now, Surroundings& around) {
  const auto found = std::find_if(settings_.commands.begin(), settings_.commands.end(),
                                  [&](const TaskCommand& one) { return one.name == task.command; });
  const TaskCommand& command = *found;
  if (Ending refused = unmet(command.needs, around.components)) return refused;
  const double noise = command.duration_noise > 0 ? command.duration_noise * noise_.normal() : 0;
  const double duration = command.duration_s * std::max(kShortest, 1 + noise);
  const auto form = [&](const std::optional<StateTemplate>& state) {
    return state ? filled(*state, task.arguments) : state_;
  };
  run_ = Run{static_cast<std::size_t>(found - settings_.commands.begin()),
             temporal::seconds(duration),
             {},
             now,
             {},
             form(command.then),
             form(command.stopped),
             values_,
             {}};
  for (const auto& [thing, state] : command.leaves)
    run_->leaves[fill_slots(thing, task.arguments)] = filled(state, task.arguments);
  run_->end = end_of(*run_);
  std::string object;
  for (const auto& [name, value] : task.arguments) object += (object.empty() ? "" : " ") + value;
  around.deeds.push_back({command.name, std::move(object)});
  state_ = command.during ? filled(*command.during, task.arguments) : State{command.name, {}};
  return std::nullopt;
}

std::optional<Time> TaskComponent::next_change() const {
  if (!run_) return std::nullopt;
  return run_->end;
}

Ending TaskComponent::finish(Surroundings&) {
  const Run done = *std::exchange(run_, std::nullopt);
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const auto& changes = settings_.commands[done.command].changes;
    const auto change = changes.find(settings_.numbers[i].name);
    if (change == changes.end()) continue;
    values_[i] = change->second.to.value_or(done.before[i] + change->second.by);
  }
  for (const auto& [thing, state] : done.leaves) things_.insert_or_assign(thing, state);
  state_ = done.then;
  return std::nullopt;
}

void TaskComponent::halt(Time now, Surroundings& around) {
  settle(now, around.body);
  state_ = run_->stopped;
  run_.reset();
}

void TaskComponent::slow_down(double pace, Time until, Time now, Surroundings&) {
  if (run_) {
    run_->done = done_by(*run_, now);
    run_->since = now;
  }
  pace_ = pace;
  slow_until_ = until;
  if (run_) run_->end = end_of(*run_);
}

temporal::Duration TaskComponent::done_by(const Run& run, Time now) const {
  const Time slow_end = std::clamp(slow_until_, run.since, std::max(run.since, now));
  const temporal::Duration slow = temporal::seconds(pace_ * temporal::to_seconds(slow_end - run.since));
  return std::min(run.work, run.done + slow + (std::max(now, slow_end) - slow_end));
}

Time TaskComponent::end_of(const Run& run) const {
  const temporal::Duration left = run.work - run.done;
  if (run.since >= slow_until_ || left.count() <= 0) return run.since + left;
  const temporal::Duration slow = temporal::seconds(pace_ * temporal::to_seconds(slow_until_ - run.since));
  if (slow < left) return slow_until_ + (left - slow);
  return run.since + temporal::seconds(temporal::to_seconds(left) / pace_);
}

void TaskComponent::settle(Time now, world::Body&) {
  if (!run_ || run_->work.count() <= 0) return;
  const double share =
      std::clamp(temporal::to_seconds(done_by(*run_, now)) / temporal::to_seconds(run_->work), 0.0, 1.0);
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const auto& changes = settings_.commands[run_->command].changes;
    const auto change = changes.find(settings_.numbers[i].name);
    if (change != changes.end() && !change->second.to)
      values_[i] = run_->before[i] + share * change->second.by;
  }
}

double TaskComponent::energy_j(Time from, Time to) const {
  return run_ ? settings_.commands[run_->command].power_w * temporal::to_seconds(to - from) : 0;
}

double TaskComponent::peak_power_w() const { return run_ ? settings_.commands[run_->command].power_w : 0; }

std::vector<world::NamedNumber> TaskComponent::numbers() const {
  std::vector<world::NamedNumber> out;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    out.push_back({settings_.numbers[i].name, values_[i], settings_.numbers[i].resolution});
  }
  return out;
}

std::vector<world::NamedState> TaskComponent::states() const {
  std::vector<world::NamedState> out;
  for (const auto& [thing, state] : things_) out.push_back({thing, state});
  return out;
}

std::map<std::string, temporal::Value> TaskComponent::results() const {
  std::map<std::string, temporal::Value> out;
  for (std::size_t i = 0; i < values_.size(); ++i) out[settings_.numbers[i].name] = values_[i];
  return out;
}

// A colon parts the names of numbers, which are the mission's, from the state's.
world::Memory TaskComponent::memory() const {
  world::Memory out{{"state", run_ ? run_->stopped : state_}};
  for (std::size_t i = 0; i < values_.size(); ++i) out["number:" + settings_.numbers[i].name] = values_[i];
  return out;
}

void TaskComponent::restore(const world::Memory& memory) {
  const auto kept = memory.find("state");
  if (const auto* state = kept == memory.end() ? nullptr : std::get_if<State>(&kept->second)) state_ = *state;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const auto number = memory.find("number:" + settings_.numbers[i].name);
    const auto* value = number == memory.end() ? nullptr : std::get_if<double>(&number->second);
    if (value) values_[i] = *value;
  }
}

}  // namespace roci::sim::components
