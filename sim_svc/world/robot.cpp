#include "sim_svc/world/robot.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace roci::sim::world {

using temporal::Time;
using temporal::to_seconds;

namespace {

std::string joined(const std::vector<CommandForm>& forms) {
  std::string out;
  for (const CommandForm& form : forms) out += form.name + ", ";
  return out + kStopCommand;
}

}  // namespace

Robot::Robot(RobotSetup setup, bool first, std::uint64_t seed)
    : name_(std::move(setup.name)), telemetry_(setup.telemetry) {
  body_.pose = setup.pose;
  if (setup.power) {
    power_ = setup.power->parameters;
    body_.battery.emplace(setup.power->start_j, power_->capacity_j);
  }
  if (setup.thermal) body_.thermal.emplace(std::move(*setup.thermal));
  if (setup.data_bytes) body_.data.emplace(*setup.data_bytes);
  std::set<std::string> types;
  for (const ComponentSetup& one : setup.components) {
    const bool first_of_type = types.insert(one.type).second;
    const std::string stream = (first ? "" : name_ + "/") + one.type + (first_of_type ? "" : ":" + one.name);
    parts_.push_back({one.name, one.make(RandomStream(seed, stream)), std::nullopt, {}, {}});
    components_.add(one.name, parts_.back().component.get());
  }
  for (Part& one : parts_) one.component->meet(components_);
}

RobotMemory Robot::memory(Time now) const {
  RobotMemory out{body_.pose, std::nullopt, body_.images.images(), {}};
  if (body_.thermal) out.temperatures_k = body_.thermal->memory(now);
  if (body_.data) out.data = body_.data->memory();
  if (body_.battery) out.energy_j = body_.battery->energy_j();
  for (const Part& one : parts_) out.components[one.name] = one.component->memory();
  return out;
}

void Robot::restore(const RobotMemory& memory, Time at) {
  next_report_ = at;
  if (body_.pose && memory.pose) body_.pose = memory.pose;
  if (body_.battery && memory.energy_j) body_.battery.emplace(*memory.energy_j, power_->capacity_j);
  body_.images.restore(memory.images);
  if (body_.thermal) body_.thermal->restore(memory.temperatures_k, at);
  if (body_.data) body_.data->restore(memory.data);
  for (Part& one : parts_)
    if (const auto own = memory.components.find(one.name); own != memory.components.end())
      one.component->restore(own->second);
}

std::string Robot::component_names() const {
  std::string out;
  for (const Part& one : parts_) out += (out.empty() ? "" : ", ") + one.name;
  return out;
}

Robot::Part* Robot::part(std::string_view name) {
  const auto found =
      std::find_if(parts_.begin(), parts_.end(), [&](const Part& p) { return p.name == name; });
  return found == parts_.end() ? nullptr : &*found;
}

Robot::Part* Robot::part_that_runs(const TaskKey& key) {
  const auto found = std::find_if(parts_.begin(), parts_.end(),
                                  [&](const Part& p) { return p.running && p.running->key == key; });
  return found == parts_.end() ? nullptr : &*found;
}

bool Robot::runs(const TaskKey& key) const {
  return std::any_of(parts_.begin(), parts_.end(),
                     [&](const Part& p) { return p.running && p.running->key == key; });
}

// Returns why the command is none for this component, or none for now.
Ending Robot::refusal_of(const Part& one, const Task& task) const {
  const auto forms = one.component->commands();
  const auto form =
      std::find_if(forms.begin(), forms.end(), [&](const CommandForm& f) { return f.name == task.command; });
  if (form == forms.end()) {
    return Failure{"unknown-command",
                   one.name + " has no command '" + task.command + "'; known: " + joined(forms)};
  }
  const auto missing = form->missing([&](const std::string& name) { return task.arguments.contains(name); });
  if (!missing.empty())
    return Failure{"missing-argument", task.command + " needs the argument '" + missing.front() + "'"};
  if (one.running) return Failure{"busy", one.name + " still runs " + one.running->key.activity};
  return std::nullopt;
}

bool Robot::begin(const std::string& component, const Task& task, Time now, Environment& environment,
                  Outputs& out) {
  const auto say = [&](TaskStage stage, const Failure& why) {
    out.push_back(TaskReport{task.key, stage, why.code, why.reason, now});
  };
  Part* one = part(component);
  if (!one) {
    say(TaskStage::rejected,
        {"unknown-component", "no component '" + component + "'; known: " + component_names()});
    return false;
  }
  if (task.command == kStopCommand) {
    break_off(*one, TaskStage::cancelled, {"stopped", "stopped by " + task.key.activity}, now, environment,
              out);
    say(TaskStage::completed, {"done", ""});
    return false;
  }
  if (const Ending refusal = refusal_of(*one, task)) {
    say(TaskStage::rejected, *refusal);
    return false;
  }
  say(TaskStage::accepted, {});
  Ending failure;
  if (now < one->out_of_order_until) {
    failure = Failure{"fault", "the component is out of order"};
  } else if (flat()) {
    failure = Failure{"battery-flat", "the battery is empty"};
  } else {
    Surroundings surroundings = around(environment, out);
    failure = one->component->begin(task, now, surroundings);
    note_effects(*one, task.key, now, surroundings);
  }
  if (failure) {
    say(TaskStage::failed, *failure);
    return false;
  }
  one->running = Running{task.key, now, 0};
  return true;
}

void Robot::halt(const TaskKey& key, TaskStage stage, const Failure& why, Time now, Environment& environment,
                 Outputs& out) {
  if (Part* one = part_that_runs(key)) break_off(*one, stage, why, now, environment, out);
}

void Robot::answer(const TaskKey& key, const Answer& answer, Time now, Environment& environment,
                   Outputs& out) {
  Part* one = part_that_runs(key);
  if (!one || !one->component->waits_for_answer()) return;
  Ending failure;
  if (const auto* refused = std::get_if<Failure>(&answer)) {
    failure = *refused;
  } else {
    Surroundings surroundings = around(environment, out);
    failure = one->component->answer(answer, now, surroundings);
    note_effects(*one, key, now, surroundings);
  }
  if (failure) break_off(*one, TaskStage::failed, *failure, now, environment, out);
}

void Robot::finish_due(Time now, Environment& environment, Outputs& out) {
  for (Part& one : parts_) {
    if (!one.running || one.component->next_change() != now) continue;
    Surroundings surroundings = around(environment, out);
    const Ending failure = one.component->finish(surroundings);
    note_effects(one, one.running->key, now, surroundings);
    if (one.component->busy()) continue;  // it goes on
    if (failure) {
      conclude(one, TaskStage::failed, *failure, one.component->results(), now, out);
    } else {
      conclude(one, TaskStage::completed, {"done", ""}, one.component->results(), now, out);
    }
  }
}

void Robot::run_routines(Time now, Environment& environment, Outputs& out) {
  for (Part& one : parts_) {
    Surroundings surroundings = around(environment, out);
    one.component->run_routine(now, now >= one.out_of_order_until && !flat(), surroundings);
  }
}

void Robot::break_component(const std::string& component, Time until, Time now, Environment& environment,
                            Outputs& out) {
  Part* one = part(component);
  if (!one) return;
  one->out_of_order_until = until;
  break_off(*one, TaskStage::failed, {"fault", "the component broke down"}, now, environment, out);
}

void Robot::slow_component(const std::string& component, double pace, Time until, Time now,
                           Environment& environment, Outputs& out) {
  Part* one = part(component);
  if (!one) return;
  Surroundings surroundings = around(environment, out);
  one->component->slow_down(pace, until, now, surroundings);
}

void Robot::hollow_success(const std::string& component, const std::string& command) {
  if (Part* one = part(component)) one->component->hollow_next(command);
}

void Robot::ground_changed(Time now, Environment& environment, Outputs& out) {
  Surroundings surroundings = around(environment, out);
  for (Part& one : parts_) one.component->ground_changed(now, surroundings);
}

void Robot::lose_energy(double joules) {
  if (body_.battery) body_.battery->add(-joules);
}

void Robot::drop_energy(double to_j) {
  if (body_.battery) body_.battery->add(std::min(0.0, to_j - body_.battery->energy_j()));
}

void Robot::set_surroundings(double kelvin, Time now, Environment& environment, Outputs& out) {
  if (!body_.thermal) return;
  body_.thermal->set_surroundings(kelvin, now);
  surroundings_changed(now, environment, out);
}

void Robot::add_heat(const std::string& zone, double joules, Time now, Environment& environment,
                     Outputs& out) {
  if (!body_.thermal || !body_.thermal->has(zone)) return;
  body_.thermal->add_heat(zone, joules, now);
  surroundings_changed(now, environment, out);
}

void Robot::change_rate(const std::string& component, double factor, Time now) {
  if (Part* one = part(component)) one->component->change_rate(factor, now);
}

void Robot::surroundings_changed(Time now, Environment& environment, Outputs& out) {
  Surroundings surroundings = around(environment, out);
  for (Part& one : parts_) one.component->surroundings_changed(now, surroundings);
}

void Robot::heed(const DownlinkSchedule& schedule) {
  for (Part& one : parts_) one.component->heed(schedule);
}

void Robot::lose_generation(double share, Time until) {
  generation_ = share;
  dim_until_ = until;
}

void Robot::suffer(const Mishap& what, Time now, Environment& environment, Outputs& out) {
  for (Part& one : parts_) {
    if (one.component->spared_from(what) != std::string()) continue;
    Surroundings surroundings = around(environment, out);
    one.component->suffer(what, now, surroundings);
    return;
  }
}

void Robot::settle(Time from, Time to, Environment& environment, Outputs& out) {
  const double factor = power_ ? power_->use_factor : 1;
  double used = power_ ? factor * power_->idle_w * to_seconds(to - from) : 0;
  for (Part& one : parts_) {
    const double energy = one.component->energy_j(from, to);
    const double drawn = energy > 0 ? factor * energy : energy;
    if (one.running) one.running->energy_j += drawn;
    used += drawn;
  }
  used += heaters_j(from, to);
  if (body_.battery) {
    const double share = from < dim_until_ ? generation_ : 1;
    body_.battery->add(share * solar_energy_j(*power_, from, to) - used);
  }
  for (Part& one : parts_) one.component->settle(to, body_);
  if (!flat()) return;
  for (Part& one : parts_) {
    break_off(one, TaskStage::failed, {"battery-flat", "the battery is empty"}, to, environment, out);
  }
  if (!has_panel(*power_)) leave_behind(out);
}

// Returns what all heaters use. That of a zone which is held for work counts as used by the task of
// the first that holds it.
double Robot::heaters_j(Time from, Time to) {
  if (!body_.thermal || to == from) return 0;
  const double factor = power_ ? power_->use_factor : 1;
  double out = 0;
  for (const ZoneParameters& zone : body_.thermal->zones()) {
    const double joules = factor * body_.thermal->heater_j(zone.name, from, to);
    out += joules;
    if (joules <= 0 || !body_.thermal->held(zone.name)) continue;
    const auto holder = std::ranges::find_if(
        parts_, [&](const Part& one) { return one.running && one.component->held_zone() == zone.name; });
    if (holder != parts_.end()) holder->running->energy_j += joules;
  }
  return out;
}

// Nothing brings energy any more, so what is still on board stays there.
void Robot::leave_behind(Outputs& out) {
  if (!body_.data) return;
  for (const Product& one : std::vector<Product>(body_.data->products()))
    if (one.fate == Fate::stored) out.push_back(*body_.data->set_fate(one.id, Fate::left_behind));
}

bool Robot::has_data_under_way() const {
  return body_.data && std::ranges::find(body_.data->products(), Fate::sent, &Product::fate) !=
                           body_.data->products().end();
}

void Robot::note_effects(const Part& one, const TaskKey& cause, Time now, Surroundings& surroundings) {
  for (PhysicalEffect& effect : surroundings.effects)
    surroundings.environment.effects.push_back({now, name_, one.name, std::move(effect), cause});
  surroundings.effects.clear();
}

void Robot::break_off(Part& one, TaskStage stage, const Failure& why, Time now, Environment& environment,
                      Outputs& out) {
  if (!one.running) return;
  Surroundings surroundings = around(environment, out);
  one.component->halt(now, surroundings);
  conclude(one, stage, why, {}, now, out);
}

void Robot::conclude(Part& one, TaskStage stage, const Failure& why,
                     std::map<std::string, temporal::Value> values, Time now, Outputs& out) {
  Results results{now - one.running->since, one.running->energy_j, std::move(values)};
  out.push_back(TaskReport{one.running->key, stage, why.code, why.reason, now, std::move(results)});
  one.running.reset();
  task_ended_ = true;
}

}  // namespace roci::sim::world
