// The owner's rules for commands (architecture, "The wire"): a key is taken once, repeated keys and queries
// get the last word again, a cancel is answered by how it went, and what is unknown is refused by naming what
// is known.
#include <algorithm>

#include "sim_svc/world.hpp"

namespace roci::sim {
namespace {

std::string joined(const std::vector<CommandForm>& forms) {
  std::string out;
  for (const CommandForm& form : forms) out += form.name + ", ";
  return out + "stop";
}

// What a world could be asked for, without a world.
template <class Visit>
void each_kind(Visit visit) {
  visit(Nav::name()), visit(ArmUnit::name()), visit(Camera::name()), visit(Gripper::name()),
      visit(Radio::name());
}

}  // namespace

bool World::has_component(std::string_view name) {
  bool found = false;
  each_kind([&](std::string_view one) { found = found || one == name; });
  return found;
}

std::string World::component_names() {
  std::string out;
  each_kind([&](std::string_view one) { out += (out.empty() ? "" : ", ") + std::string(one); });
  return out;
}

std::vector<Output> World::command(Time now, const Request& request) {
  advance_to(now);
  settle(now);
  if (auto refusal = ledger_.refuse_old(request.key, request.epoch, now)) {
    out_.push_back(*refusal);
  } else if (request.action == Action::query) {
    out_.push_back(ledger_.answer(request.key, now));
  } else if (request.action == Action::cancel) {
    cancel(now, request);
  } else {
    execute(now, request);
  }
  return done(now);
}

void World::execute(Time now, const Request& request) {
  if (auto repeated = ledger_.take(request.key, request.epoch, now)) {
    out_.push_back(*repeated);
    return;
  }
  const bool known = with(request.component, [&](auto& component) {
    if (request.command == "stop") {
      stop_by_command(component, now, request.key);
    } else {
      begin(component, now, request);
    }
  });
  if (known) return;
  acknowledge(request.key, Stage::rejected, "unknown-component",
              "no component '" + request.component + "'; known: " + component_names(), now);
}

template <class Component>
void World::begin(Component& component, Time now, const Request& request) {
  const auto reject = [&](std::string code, std::string reason) {
    acknowledge(request.key, Stage::rejected, std::move(code), std::move(reason), now);
  };
  const std::string name(component.name());
  const auto forms = component.commands();
  const auto form = std::find_if(forms.begin(), forms.end(),
                                 [&](const CommandForm& one) { return one.name == request.command; });
  if (form == forms.end()) {
    return reject("unknown-command",
                  name + " has no command '" + request.command + "'; known: " + joined(forms));
  }
  for (const std::string& argument : form->arguments) {
    if (request.arguments.contains(argument)) continue;
    return reject("missing-argument", request.command + " needs the argument '" + argument + "'");
  }
  if (component.busy()) return reject("busy", name + " still runs " + running_.at(name).activity);
  acknowledge(request.key, Stage::accepted, "", "", now);
  Ending failure;
  if (const auto fault = faults_.find(name); fault != faults_.end() && now < fault->second) {
    failure = Failure{"fault", "the component is out of order"};
  } else if (battery_.flat()) {
    failure = Failure{"battery-flat", "the battery is empty"};
  } else {
    const RobotView seen = view();
    Surroundings around = surroundings(seen);
    failure = component.begin({request.key, request.command, request.arguments}, now, around);
  }
  if (failure) return acknowledge(request.key, Stage::failed, failure->code, failure->reason, now);
  begun_.push_back({now, {request.key, request.command, request.arguments}});
  running_[name] = request.key;
}

template <class Component>
void World::stop_by_command(Component& component, Time now, const ActivityKey& key) {
  break_off(component, now, Stage::cancelled, {"stopped", "stopped by " + key.activity});
  acknowledge(key, Stage::completed, "done", "", now);
}

void World::cancel(Time now, const Request& request) {
  const auto running = std::find_if(running_.begin(), running_.end(),
                                    [&](const auto& entry) { return entry.second == request.key; });
  if (running != running_.end()) {
    with(std::string(running->first), [&](auto& component) {
      break_off(component, now, Stage::cancelled, {"cancelled", "cancelled on request"});
    });
    return;
  }
  Ack answer = ledger_.answer(request.key, now);
  if (answer.stage != Stage::unknown) {
    answer.stage = Stage::cancel_failed;
    answer.reason = "it has already ended (" + answer.code + ")";
    answer.code = "already-ended";
  }
  out_.push_back(std::move(answer));
}

}  // namespace roci::sim
