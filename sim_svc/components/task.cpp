#include "sim_svc/components/task.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>

#include "sim_svc/components/argument_slots.hpp"

namespace roci::sim::components {

using temporal::State;
using temporal::Time;
using world::Ending;
using world::Failure;
using world::Surroundings;

namespace {

State filled(const StateTemplate& form, const std::map<std::string, std::string>& arguments) {
  State out{fill_slots(form.name, arguments), {}};
  for (const std::string& argument : form.arguments) out.arguments.push_back(fill_slots(argument, arguments));
  return out;
}

// What a task that was to fill the battery says if, when it is looked at, it has not.
Ending missing_gain(const TaskCommand& command, double before_j,
                    const std::optional<world::Battery>& battery) {
  if (command.gains_j <= 0 || !battery || battery->full()) return std::nullopt;
  const double gain_j = battery->energy_j() - before_j;
  if (gain_j >= command.gains_j) return std::nullopt;
  const auto joules = [](double value) { return std::to_string(std::llround(value)) + " J"; };
  const std::string change =
      gain_j > 0 ? "has risen by " + joules(gain_j) : "has not risen, but fallen by " + joules(-gain_j);
  const std::string while_it_ran =
      command.gains_within_s
          ? "in the first " + std::to_string(std::llround(*command.gains_within_s)) + " s of "
          : "during ";
  return Failure{"no-gain", "the battery " + change + " " + while_it_ran + command.name + ", at least " +
                                joules(command.gains_j) + " were to come in; look at what charges it"};
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
  for (const auto& [thing, state] : settings_.things) things_[thing] = filled(state, {});
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
    if (command.failed) add(*command.failed);
  }
  return {out.begin(), out.end()};
}

std::vector<world::ThingForm> TaskComponent::thing_forms() const {
  std::map<std::string, std::set<world::StateForm>> families;
  const auto add = [&](const std::map<std::string, StateTemplate>& states) {
    for (const auto& [thing, state] : states)
      families[thing.substr(0, thing.find('.'))].insert({state.name, state.arguments.size()});
  };
  add(settings_.things);
  for (const TaskCommand& command : settings_.commands) add(command.leaves);
  std::vector<world::ThingForm> out;
  for (const auto& [family, states] : families) out.push_back({family, {states.begin(), states.end()}});
  return out;
}

Ending TaskComponent::begin(const world::Task& task, Time now, Surroundings& around) {
  const auto found = std::find_if(settings_.commands.begin(), settings_.commands.end(),
                                  [&](const TaskCommand& one) { return one.name == task.command; });
  const TaskCommand& command = *found;
  if (Ending refused = unmet(command.needs, around.components)) return refused;
  const double duration =
      command.duration_s * (command.duration_noise > 0 ? noise_.factor(command.duration_noise) : 1);
  const auto form = [&](const std::optional<StateTemplate>& state) {
    return state ? filled(*state, task.arguments) : state_;
  };
  run_ = Run{static_cast<std::size_t>(found - settings_.commands.begin()),
             form(command.then),
             form(command.stopped),
             form(command.failed ? command.failed : command.stopped),
             state_,
             values_,
             around.body.battery ? around.body.battery->energy_j() : 0,
             std::nullopt,
             {}};
  if (command.gains_j > 0) {
    run_->gain_due = command.gains_within_s ? now + temporal::seconds(*command.gains_within_s) : Time::max();
  }
  for (const auto& [thing, state] : command.leaves)
    run_->leaves[fill_slots(thing, task.arguments)] = filled(state, task.arguments);
  work_.start(temporal::seconds(duration), now);
  std::string object;
  for (const auto& [name, value] : task.arguments) object += (object.empty() ? "" : " ") + value;
  around.effects.push_back({command.name, std::move(object)});
  state_ = command.during ? filled(*command.during, task.arguments) : State{command.name, {}};
  return std::nullopt;
}

std::optional<Time> TaskComponent::next_change() const {
  if (!run_) return std::nullopt;
  return std::min(run_->gain_due.value_or(Time::max()), work_.end());
}

Ending TaskComponent::finish(Surroundings& around) {
  if (run_->gain_due) {
    const Time now = *next_change();
    run_->gain_due.reset();
    const Ending failure =
        missing_gain(settings_.commands[run_->command], run_->energy_before_j, around.body.battery);
    if (failure) run_->stopped = run_->failed;
    if (failure) halt(now, around);
    if (failure || now < work_.end()) return failure;
  }
  const Run done = *std::exchange(run_, std::nullopt);
  if (hollow_.take(settings_.commands[done.command].name)) {
    values_ = done.numbers_before;
    state_ = done.before;
    return std::nullopt;
  }
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const auto& changes = settings_.commands[done.command].changes;
    const auto change = changes.find(settings_.numbers[i].name);
    if (change == changes.end()) continue;
    values_[i] = change->second.to.value_or(done.numbers_before[i] + change->second.by);
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

void TaskComponent::settle(Time now, world::Body&) {
  if (!run_ || work_.work().count() <= 0) return;
  const double share = work_.share_by(now);
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const auto& changes = settings_.commands[run_->command].changes;
    const auto change = changes.find(settings_.numbers[i].name);
    if (change != changes.end() && !change->second.to)
      values_[i] = run_->numbers_before[i] + share * change->second.by;
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

// A colon parts the names of numbers and things, which are the mission's, from the state's.
world::Memory TaskComponent::memory() const {
  world::Memory out{{"state", run_ ? run_->stopped : state_}};
  for (const auto& [thing, state] : things_) out["thing:" + thing] = state;
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
  constexpr std::string_view kThing = "thing:";
  for (const auto& [name, value] : memory) {
    const auto* state = name.starts_with(kThing) ? std::get_if<State>(&value) : nullptr;
    if (state) things_.insert_or_assign(name.substr(kThing.size()), *state);
  }
}

}  // namespace roci::sim::components
