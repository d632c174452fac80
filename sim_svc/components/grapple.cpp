#include "sim_svc/components/grapple.hpp"

#include <algorithm>
#include <utility>

#include "core/words/nearest_word.hpp"

namespace roci::sim::components {

using temporal::State;
using temporal::Time;
using world::Ending;
using world::Failure;
using world::Surroundings;

namespace {

template <class Things>
std::string unknown(const std::string& what, const std::string& name, const Things& things) {
  std::vector<std::string> known;
  for (const auto& [one, thing] : things) known.push_back(one);
  return "no " + what + " '" + name + "'; " +
         words::nearest(name, known)
             .remedy("name one of the " + std::to_string(known.size()) +
                     " that the grapple has in mission.yaml");
}

// Returns the value if the memory has one of that kind, else null.
template <class Kept>
const Kept* kept(const world::Memory& memory, const std::string& key) {
  const auto found = memory.find(key);
  return found == memory.end() ? nullptr : std::get_if<Kept>(&found->second);
}

const char* name_of(bool works) { return works ? "works" : "damaged"; }

}  // namespace

Grapple::Grapple(GrappleSettings settings, world::RandomStream noise)
    : settings_(std::move(settings)), noise_(std::move(noise)) {
  for (auto& [name, slot] : settings_.slots) slots_[name] = {slot, false};
  for (auto& [name, module] : settings_.modules) modules_[name] = {module, {"latched", {module.slot}}};
  settings_.slots.clear();
  settings_.modules.clear();
}

void Grapple::meet(const world::ComponentSet& components) { arm_ = components.find<world::Manipulator>(); }

std::vector<world::ThingForm> Grapple::thing_forms() const {
  return {{"module", {{"latched", 1}, {"resting", 1}, {"held"}}},
          {"health", {{"works"}, {"damaged"}}},
          {"slot", {{"free"}, {"taken", 1}, {"blocked"}}}};
}

std::vector<std::string> Grapple::awaited_windows() const {
  if (settings_.light.empty()) return {};
  return {settings_.light};
}

State Grapple::state() const {
  if (work_) return {"working", {}};
  return held_ ? State{"holding", {*held_}} : State{"empty", {}};
}

Ending Grapple::at_work() const {
  if (!work_) return std::nullopt;
  return Failure{"grapple-busy", "the grapple is working; wait for it"};
}

std::optional<world::Payload> Grapple::payload() const {
  if (!held_) return std::nullopt;
  const ModuleSettings& module = modules_.at(*held_).settings;
  return world::Payload{module.mass_kg, module.true_mass_kg, module.size_m};
}

bool Grapple::at_pose_of(const std::string& slot) const {
  return !arm_ || arm_->pose() == slots_.at(slot).settings.pose;
}

bool Grapple::has_fix() const { return fix_ && at_pose_of(*fix_); }

std::optional<std::string> Grapple::module_in(const std::string& slot) const {
  const auto found = std::ranges::find_if(modules_, [&](const auto& one) {
    const State& where = one.second.where;
    return !where.arguments.empty() && where.arguments.front() == slot;
  });
  if (found == modules_.end()) return std::nullopt;
  return found->first;
}

void Grapple::put(const std::string& module, State where) {
  modules_.at(module).where = std::move(where);
  ++changes_;
}

Ending Grapple::refusal(const Work& work) const {
  const auto slot = slots_.find(work.slot);
  if (slot == slots_.end()) return Failure{"unknown-slot", unknown("slot", work.slot, slots_)};
  if (!at_pose_of(work.slot))
    return Failure{"wrong-pose",
                   "the arm does not rest at '" + slot->second.settings.pose + "'; move it there first"};
  if (work.kind == Kind::localize) return std::nullopt;
  if (!modules_.contains(work.module))
    return Failure{"unknown-module", unknown("module", work.module, modules_)};
  if (!has_fix() || *fix_ != work.slot)
    return Failure{"no-fix", "there is no fix on '" + work.slot + "' since the arm moved; localize it first"};
  const auto inside = module_in(work.slot);
  if (work.kind == Kind::grasp) {
    if (held_) return Failure{"not-empty", "the grapple holds '" + *held_ + "'; place it first"};
    if (inside != work.module)
      return Failure{"no-module",
                     "'" + work.module + "' is not in '" + work.slot + "'; grasp it where it is"};
    return std::nullopt;
  }
  if (held_ != work.module)
    return Failure{"not-held", "the grapple does not hold '" + work.module + "'; grasp it first"};
  if (inside) return Failure{"slot-taken", "'" + *inside + "' is in '" + work.slot + "'; place it elsewhere"};
  return std::nullopt;
}

Ending Grapple::begin(const world::Task& task, Time now, Surroundings& around) {
  Work work{Kind::localize, task.key, task.latest_end, {}, task.arguments.at("slot")};
  double nominal = settings_.localize_s;
  if (task.command != "localize") {
    const bool grasp = task.command == "grasp";
    work.kind = grasp ? Kind::grasp : Kind::place;
    work.module = task.arguments.at("module");
    nominal = grasp ? settings_.grasp_s : settings_.place_s;
  }
  if (Ending refused = refusal(work)) return refused;
  work.end = now + temporal::seconds(nominal * noise_.factor(settings_.duration_noise));
  if (work.kind == Kind::localize && !settings_.light.empty()) {
    const auto& windows = around.environment.windows;
    const auto light = std::ranges::find(windows, settings_.light, &world::Window::timeline);
    if (light == windows.end() || !light->is_open(now))
      return Failure{"too-dark",
                     settings_.light + " is closed and nothing can be seen; localize in the next window"};
    const Time closes = light->next_change(now).value_or(work.end);
    work.gets_dark = closes < work.end;
    work.end = std::min(work.end, closes);
  }
  results_.clear();
  work_ = std::move(work);
  return std::nullopt;
}

std::optional<Time> Grapple::next_change() const {
  if (!work_) return std::nullopt;
  return work_->end;
}

Ending Grapple::finish(Surroundings& around) {
  Work done = *std::exchange(work_, std::nullopt);
  if (done.kind == Kind::localize) return end_localize(done, around);
  return done.kind == Kind::grasp ? end_grasp(done, around) : end_place(std::move(done), around);
}

Ending Grapple::see_blocked(const std::string& slot) {
  slots_.at(slot).seen_blocked = true;
  fix_.reset();
  ++changes_;
  return Failure{"slot-blocked", "something blocks '" + slot + "'; use another slot"};
}

Ending Grapple::end_localize(const Work& done, Surroundings& around) {
  if (done.gets_dark) return Failure{"too-dark", settings_.light + " closed before the slot was localized"};
  around.effects.push_back({"localize", done.slot});
  if (slots_.at(done.slot).settings.blocked && !module_in(done.slot)) return see_blocked(done.slot);
  fix_ = done.slot;
  ++changes_;
  return std::nullopt;
}

Ending Grapple::end_grasp(const Work& done, Surroundings& around) {
  around.effects.push_back({"grasp", done.module});
  held_ = done.module;
  put(done.module, {"held", {}});
  return std::nullopt;
}

Ending Grapple::end_place(Work done, Surroundings& around) {
  if (slots_.at(done.slot).settings.blocked) return see_blocked(done.slot);
  Module& module = modules_.at(done.module);
  ++done.tries;
  results_ = {{"tries", static_cast<double>(done.tries)}};
  const bool closed = module.settings.latch_tries <= 1;
  module.settings.latch_tries = std::max<std::int64_t>(1, module.settings.latch_tries - 1);
  if (!closed) {
    const Time again = done.end + temporal::seconds(settings_.latch_s);
    if (!done.latest_end || again <= *done.latest_end) {
      around.out.push_back(
          world::TaskReport{done.key, world::TaskStage::repairing, "repairing",
                            "the latch of '" + done.slot + "' did not close; it is tried again", done.end});
      done.end = again;
      work_ = std::move(done);
      return std::nullopt;
    }
  }
  around.effects.push_back({"place", done.module});
  held_.reset();
  put(done.module, {closed ? "latched" : "resting", {done.slot}});
  if (closed) return std::nullopt;
  return Failure{"latch-failed", "the latch of '" + done.slot + "' did not close in time; '" + done.module +
                                     "' rests there: grasp it and place it again"};
}

void Grapple::settle(Time, world::Body&) {
  if (fix_ && !has_fix()) fix_.reset();
}

std::optional<std::string> Grapple::spared_from(const world::Mishap& what) const {
  if (const auto* failure = std::get_if<world::ModuleFailure>(&what))
    return modules_.contains(failure->module) ? std::string() : unknown("module", failure->module, modules_);
  if (const auto* block = std::get_if<world::SlotBlock>(&what))
    return slots_.contains(block->slot) ? std::string() : unknown("slot", block->slot, slots_);
  return std::nullopt;
}

void Grapple::suffer(const world::Mishap& what, Time, Surroundings&) {
  if (const auto* failure = std::get_if<world::ModuleFailure>(&what)) {
    modules_.at(failure->module).settings.works = false;
    ++changes_;
  } else {
    slots_.at(std::get<world::SlotBlock>(what).slot).settings.blocked = true;
  }
}

double Grapple::energy_j(Time from, Time to) const {
  return busy() ? settings_.power_w * temporal::to_seconds(to - from) : 0;
}

std::optional<std::uint64_t> Grapple::states_version() const { return 2 * changes_ + (has_fix() ? 1 : 0); }

std::vector<world::NamedState> Grapple::states() const {
  std::vector<world::NamedState> out{{"fix", has_fix() ? State{"on", {*fix_}} : State{"none", {}}}};
  std::map<std::string, std::string> inside;
  for (const auto& [name, module] : modules_) {
    out.push_back({"module." + name, module.where});
    out.push_back({"health." + name, {name_of(module.settings.works), {}}});
    if (!module.where.arguments.empty()) inside[module.where.arguments.front()] = name;
  }
  for (const auto& [name, slot] : slots_) {
    const auto module = inside.find(name);
    State state = slot.seen_blocked ? State{"blocked", {}} : State{"free", {}};
    if (module != inside.end()) state = {"taken", {module->second}};
    out.push_back({"slot." + name, std::move(state)});
  }
  return out;
}

world::Memory Grapple::memory() const {
  world::Memory out;
  for (const auto& [name, module] : modules_) {
    out["module." + name] = module.where;
    out["health." + name] = State{name_of(module.settings.works), {}};
    out["tries." + name] = static_cast<double>(module.settings.latch_tries);
  }
  for (const auto& [name, slot] : slots_) {
    out["blocked." + name] = slot.settings.blocked;
    out["seen." + name] = slot.seen_blocked;
  }
  return out;
}

void Grapple::restore(const world::Memory& memory) {
  for (auto& [name, module] : modules_) {
    const State* where = kept<State>(memory, "module." + name);
    if (where && where->name == "held" && !held_) {
      held_ = name;
      module.where = *where;
    } else if (where && where->arguments.size() == 1 && slots_.contains(where->arguments.front())) {
      module.where = *where;
    }
    if (const State* health = kept<State>(memory, "health." + name))
      module.settings.works = health->name == "works";
    if (const double* tries = kept<double>(memory, "tries." + name))
      module.settings.latch_tries =
          std::max<std::int64_t>(1, static_cast<std::int64_t>(std::min(*tries, 1e9)));
  }
  for (auto& [name, slot] : slots_) {
    if (const bool* blocked = kept<bool>(memory, "blocked." + name)) slot.settings.blocked = *blocked;
    if (const bool* seen = kept<bool>(memory, "seen." + name)) slot.seen_blocked = *seen;
  }
  ++changes_;
}

}  // namespace roci::sim::components
