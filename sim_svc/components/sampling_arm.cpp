#include "sim_svc/components/sampling_arm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace roci::sim::components {

using temporal::State;
using temporal::Time;
using world::Ending;
using world::Failure;
using world::SampleOrigin;
using world::Surroundings;

namespace {

constexpr std::size_t kMove = 1;  // the phase after warming

template <class T>
const T* kept(const world::Memory& memory, const std::string& name) {
  const auto found = memory.find(name);
  return found == memory.end() ? nullptr : std::get_if<T>(&found->second);
}

std::string argument(const world::Task& task, const std::string& name) {
  const auto found = task.arguments.find(name);
  return found == task.arguments.end() ? "" : found->second;
}

}  // namespace

SamplingArm::SamplingArm(SamplingArmSettings settings, world::RandomStream noise)
    : PhasedComponent(settings.zone),
      settings_(std::move(settings)),
      noise_(std::move(noise)),
      joints_(settings_.rest) {
  for (const auto& [name, site] : settings_.sites)
    trenches_.emplace(name, Trench{IceColumn(site.ice, settings_.depth_m, noise_.branch("ice " + name))});
}

State SamplingArm::state() const {
  if (!run_) return {prepared_ ? "ready" : "rests", {}};
  if (run_->command == "prepare") return {"preparing", {}};
  if (run_->command == "excavate") return {"digging", {run_->where.site}};
  if (run_->command == "collect") return {"collecting", {run_->where.site, run_->where.target}};
  return {run_->command == "transport" ? "carrying" : "discarding", {}};
}

Ending SamplingArm::refusal_of(const world::Task& task) const {
  if (task.command == "prepare") return std::nullopt;
  if (!prepared_) return Failure{"not-prepared", "the arm rests; prepare it first"};
  if (task.command == "discard") return std::nullopt;
  if (task.command == "transport") {
    if (held_) return std::nullopt;
    return Failure{"no-sample", "the arm holds no sample; collect one first"};
  }
  const std::string site = argument(task, "site");
  const auto trench = trenches_.find(site);
  if (trench == trenches_.end()) return Failure{"unknown-site", "there is no site '" + site + "'"};
  if (task.command == "excavate") return std::nullopt;
  const auto& targets = settings_.targets;
  const std::string target = argument(task, "target");
  if (!targets.empty() && std::ranges::find(targets, target) == targets.end())
    return Failure{"unknown-target", "site " + site + " has no target '" + target + "'"};
  if (!excavated(trench->second))
    return Failure{"not-excavated", "the trench of site " + site + " is not deep enough; excavate it first"};
  if (!held_) return std::nullopt;
  return Failure{"not-empty",
                 "the tool holds a sample of site " + held_->site + "; transport or discard it first"};
}

Phase SamplingArm::work(double seconds, double power_w) const {
  const double power = power_w * (run_ ? run_->power_factor : 1);
  return {Phase::Until::over, seconds, power, settings_.waste_share * power};
}

double SamplingArm::cutting_w() const {
  return settings_.arm_w + settings_.cutter.power_w / settings_.cutter_efficiency;
}

std::vector<Phase> SamplingArm::phases_of(const Run& run, double noise) const {
  double travel = 0;
  for (std::size_t i = 0; i < run.to.size(); ++i)
    travel = std::max(travel, std::abs(run.to[i] - run.from[i]));
  const double factor = settings_.duration_factor * noise;
  const auto lasting = [&](double seconds, double power_w) { return work(factor * seconds, power_w); };
  std::vector<Phase> out{Phase::warming(), lasting(travel / settings_.joint_speed_rad_s, settings_.arm_w)};
  if (run.command == "prepare")
    out.push_back(lasting(settings_.prepare_s, settings_.arm_w + settings_.prepare_w));
  if (run.command == "transport")
    out.push_back(lasting(settings_.transport_s, settings_.arm_w + settings_.transfer_w));
  if (run.command == "discard") out.push_back(lasting(settings_.discard_s, settings_.arm_w));
  if (run.command == "excavate")
    out.push_back(work(0, cutting_w()));  // how long, is known when it begins to cut
  if (run.command == "collect") {
    const IceColumn& ice = trenches_.at(run.where.site).ice;
    const double hardness = ice.specific_energy_j_m3(settings_.depth_m) / settings_.specific_energy_j_m3;
    out.push_back(lasting(hardness * settings_.collect_s, settings_.arm_w + settings_.drill_w));
  }
  return out;
}

bool SamplingArm::add_warming(const Run& run, double noise, const world::Body& body, Phase& work) const {
  const auto found = settings_.warms.find(run.command);
  if (found == settings_.warms.end() || !body.thermal) return true;
  const world::ColdPart& part = found->second;
  const auto usual = world::warming(part, part.usual_k);
  const auto here = world::warming(part, body.thermal->surroundings_k(), body.thermal->loss_factor());
  if (!usual || !here) return false;
  const double factor = settings_.duration_factor * noise;
  const double held_s = std::max(0.0, work.work_s - factor * usual->seconds);
  const double more_s = std::max(-work.work_s, factor * (here->seconds - usual->seconds));
  const double warming_w = run.power_factor * (settings_.arm_w + part.heater_w);
  const double holding_j = run.power_factor * (here->holding_w - usual->holding_w) * held_s;
  work.work_s += more_s;
  if (work.work_s > 0) work.power_w += (more_s * (warming_w - work.power_w) + holding_j) / work.work_s;
  return true;
}

Ending SamplingArm::begin(const world::Task& task, Time now, Surroundings& around) {
  if (Ending refused = refusal_of(task)) return refused;
  results_.clear();
  // All commands draw alike, so that what one of them was changes nothing for those after it.
  const double duration_noise = noise_.factor(settings_.duration_noise);
  const double power_noise = noise_.factor(settings_.power_noise);
  const double jam_noise = noise_.uniform();
  Run run{task.command, {argument(task, "site"), argument(task, "target")}, joints_, joints_};
  run.power_factor = power_noise;
  const auto site = settings_.sites.find(run.where.site);
  if (task.command == "prepare") run.to = settings_.rest;
  if (task.command == "transport") run.to = settings_.inlet;
  if (task.command == "discard") run.to = settings_.dump;
  if (site != settings_.sites.end()) {
    const Trench& trench = trenches_.at(site->first);
    run.to = site->second.joints;
    run.depth_before_m = trench.depth_m;
    run.jam_in_s = site->second.jams_per_h > 0 ? -std::log(1 - jam_noise) * 3600 / site->second.jams_per_h
                                               : std::numeric_limits<double>::infinity();
    if (task.command == "excavate" && excavated(trench)) {
      run_ = run;
      return phases_.begin({Phase{}}, now, around.body);
    }
  }
  run_ = run;
  std::vector<Phase> phases = phases_of(run, duration_noise);
  Ending cold;
  if (!add_warming(run, duration_noise, around.body, phases.back()))
    cold = Failure{"too-cold", "what '" + task.command + "' warms would never be warm enough to work"};
  if (!cold) cold = phases_.begin(std::move(phases), now, around.body);
  if (cold) {
    run_.reset();
    return cold;
  }
  around.effects.push_back(
      {task.command, run.where.site + (run.where.target.empty() ? "" : " " + run.where.target)});
  return std::nullopt;
}

std::vector<Phase> SamplingArm::cutting() {
  const Trench& trench = trenches_.at(run_->where.site);
  const double needed = trench.ice.cutting_s(trench.depth_m, trench.ice.bottom_m(), settings_.cutter);
  run_->cut_phase = phases_.phase();
  run_->cut_from_m = trench.depth_m;
  std::vector<Phase> out{work(std::min(needed, run_->jam_in_s), cutting_w())};
  if (run_->jam_in_s > needed && !trench.ice.passable())
    out.push_back(work(settings_.give_up_s, cutting_w()));
  return out;
}

// Says at the end of a phase of the cutting whether that has failed.
Ending SamplingArm::end_of_cutting() {
  Trench& trench = trenches_.at(run_->where.site);
  if (phases_.phase() != *run_->cut_phase)
    return Failure{"too-hard", "the ice gives way no more at " + std::to_string(trench.depth_m) +
                                   " m; choose another site"};
  const double needed = trench.ice.cutting_s(run_->cut_from_m, trench.ice.bottom_m(), settings_.cutter);
  if (run_->jam_in_s <= needed) {
    trench.depth_m = trench.ice.depth_after(run_->cut_from_m, run_->jam_in_s, settings_.cutter);
    return Failure{"stuck", "the cutter has jammed at " + std::to_string(trench.depth_m) + " m; dig again"};
  }
  run_->jam_in_s -= needed;
  trench.depth_m = trench.ice.bottom_m();
  return std::nullopt;
}

bool SamplingArm::moves() const { return run_ && phases_.phase() <= kMove; }

Ending SamplingArm::finish(Surroundings& around) {
  ++version_;
  const Time now = *next_change();
  if (phases_.phase() == kMove) joints_ = run_->to;
  Ending failure;
  if (run_->cut_phase) failure = end_of_cutting();
  if (!failure && phases_.go_on(around.body)) {
    if (run_->command == "excavate" && !run_->cut_phase && phases_.phase() > kMove)
      phases_.change_rest(cutting(), now, around.body);
    return std::nullopt;
  }
  phases_.halt(now, around.body);
  const Run done = *std::exchange(run_, std::nullopt);
  if (const auto trench = trenches_.find(done.where.site); trench != trenches_.end())
    results_["depth_m"] = trench->second.depth_m;
  if (failure) return failure;
  if (!hollow_.take(done.command)) {
    take_effect(done);
  } else if (done.command == "excavate") {
    trenches_.at(done.where.site).depth_m = done.depth_before_m;
  }
  return std::nullopt;
}

// A trench has grown by and by.
void SamplingArm::take_effect(const Run& done) {
  if (done.command == "prepare") {
    prepared_ = true;
    held_.reset();
  }
  if (done.command == "collect") held_ = done.where;
  if (done.command == "transport") delivered_ = std::exchange(held_, std::nullopt);
  if (done.command == "discard") {
    held_.reset();
    delivered_.reset();
  }
}

void SamplingArm::halt(Time now, Surroundings& around) {
  settle(now, around.body);
  phases_.halt(now, around.body);
  run_.reset();
}

void SamplingArm::settle(Time now, world::Body& body) {
  PhasedComponent::settle(now, body);
  if (!run_) return;
  if (run_->cut_phase == phases_.phase()) {
    Trench& trench = trenches_.at(run_->where.site);
    trench.depth_m = trench.ice.depth_after(run_->cut_from_m, phases_.done_s(now), settings_.cutter);
  } else if (phases_.phase() == kMove) {
    const double share = phases_.share(now);
    for (std::size_t i = 0; i < joints_.size(); ++i)
      joints_[i] = run_->from[i] + share * (run_->to[i] - run_->from[i]);
  }
}

std::optional<std::string> SamplingArm::spared_from(const world::Mishap& mishap) const {
  const auto* collapse = std::get_if<world::TrenchCollapse>(&mishap);
  if (!collapse) return std::nullopt;
  if (trenches_.contains(collapse->site)) return "";
  std::string known;
  for (const auto& [name, trench] : trenches_) known += (known.empty() ? "" : ", ") + name;
  return "no site '" + collapse->site + "'; known: " + known;
}

void SamplingArm::suffer(const world::Mishap& mishap, Time now, Surroundings& around) {
  const auto& collapse = std::get<world::TrenchCollapse>(mishap);
  Trench& trench = trenches_.at(collapse.site);
  trench.depth_m *= collapse.share;
  ++version_;
  if (!run_ || run_->where.site != collapse.site || !run_->cut_phase) return;
  if (run_->cut_phase == phases_.phase()) run_->jam_in_s -= phases_.done_s(now);
  phases_.change_rest(cutting(), now, around.body);
}

std::vector<world::NamedState> SamplingArm::states() const {
  std::vector<world::NamedState> out;
  for (const auto& [name, trench] : trenches_)
    out.push_back({"site." + name, {excavated(trench) ? "excavated" : "untouched", {}}});
  State sample{"none", {}};
  if (delivered_) sample = {"delivered", {delivered_->site, delivered_->target}};
  if (held_) sample = {"held", {held_->site, held_->target}};
  out.push_back({"sample", sample});
  return out;
}

std::vector<world::NamedNumber> SamplingArm::numbers() const {
  std::vector<world::NamedNumber> out;
  for (std::size_t i = 0; i < joints_.size(); ++i) out.push_back({"q" + std::to_string(i), joints_[i]});
  for (const auto& [name, trench] : trenches_) out.push_back({"depth_" + name, trench.depth_m});
  return out;
}

world::Memory SamplingArm::memory() const {
  world::Memory out{{"prepared", prepared_}};
  for (std::size_t i = 0; i < joints_.size(); ++i) out["q" + std::to_string(i)] = joints_[i];
  for (const auto& [name, trench] : trenches_) out["depth:" + name] = trench.depth_m;
  if (held_) out["held"] = State{"held", {held_->site, held_->target}};
  if (delivered_) out["delivered"] = State{"delivered", {delivered_->site, delivered_->target}};
  return out;
}

void SamplingArm::restore(const world::Memory& memory) {
  const auto number = [&](const std::string& name, double& out) {
    const auto* value = kept<double>(memory, name);
    if (value && std::isfinite(*value)) out = *value;
  };
  if (const auto* prepared = kept<bool>(memory, "prepared")) prepared_ = *prepared;
  for (std::size_t i = 0; i < joints_.size(); ++i) number("q" + std::to_string(i), joints_[i]);
  for (auto& [name, trench] : trenches_) {
    number("depth:" + name, trench.depth_m);
    trench.depth_m = std::clamp(trench.depth_m, 0.0, settings_.depth_m);
  }
  const auto sample = [&](const std::string& name) -> std::optional<SampleOrigin> {
    const auto* state = kept<State>(memory, name);
    if (!state || state->arguments.size() != 2) return std::nullopt;
    return SampleOrigin{state->arguments[0], state->arguments[1]};
  };
  ++version_;
  held_ = sample("held");
  delivered_ = sample("delivered");
}

}  // namespace roci::sim::components
