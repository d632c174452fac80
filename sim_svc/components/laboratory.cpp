#include "sim_svc/components/laboratory.hpp"

#include <algorithm>
#include <utility>

namespace roci::sim::components {

using temporal::State;
using temporal::Time;
using world::Ending;
using world::Failure;
using world::SampleOrigin;
using world::Surroundings;

namespace {

std::string id_of(const SampleOrigin& sample) { return sample.site + "_" + sample.target; }

State to_state(bool positive) { return {positive ? "positive" : "negative", {}}; }

}  // namespace

Laboratory::Laboratory(LaboratorySettings settings, world::RandomStream noise)
    : PhasedComponent(settings.zone), settings_(std::move(settings)), noise_(std::move(noise)) {
  for (const auto& [sample, truth] : settings_.signatures) {
    const double drawn = noise_.branch("signature " + sample).uniform();
    positive_[sample] =
        truth == Signature::drawn ? drawn < settings_.positive_share : truth == Signature::positive;
  }
}

State Laboratory::state() const {
  if (!run_) return {"idle", {}};
  const std::size_t instrument = std::max<std::size_t>(phases_.phase(), 1) - 1;  // the first phase warms it
  return {"analyzing", {run_->sample.site, run_->sample.target, settings_.instruments[instrument].name}};
}

Ending Laboratory::begin(const world::Task& task, Time now, Surroundings& around) {
  const SampleOrigin sample{task.arguments.at("site"), task.arguments.at("target")};
  if (!positive_.contains(id_of(sample)))
    return Failure{"unknown-sample", "there is no sample " + id_of(sample)};
  const std::string& form = task.arguments.at("form");
  if (!settings_.products.empty() && !settings_.products.contains(form))
    return Failure{"unknown-form", "there is no form '" + form + "' of what an analysis brings"};
  const auto* carrier = around.components.find<world::SampleCarrier>();
  if (!carrier || carrier->delivered() != sample)
    return Failure{"no-sample",
                   "the sample " + id_of(sample) + " is not in the inlet; transport it there first"};
  const double duration = settings_.duration_factor * noise_.factor(settings_.duration_noise);
  const double power = noise_.factor(settings_.power_noise);
  std::vector<Phase> phases{Phase::warming()};
  for (const Instrument& one : settings_.instruments)
    phases.push_back(
        {Phase::Until::over, duration * one.duration_s, power * one.power_w, power * one.heat_w});
  if (Ending cold = phases_.begin(std::move(phases), now, around.body)) return cold;
  run_ = Run{task, sample};
  around.effects.push_back({task.command, id_of(sample)});
  return std::nullopt;
}

Ending Laboratory::finish(Surroundings& around) {
  const Time now = *next_change();
  if (phases_.go_on(around.body)) return std::nullopt;
  const Run done = *std::exchange(run_, std::nullopt);
  if (hollow_.take("analyze")) return std::nullopt;
  const std::string sample = id_of(done.sample);
  const bool positive = found_[sample] = positive_.at(sample);
  const auto forms = settings_.products.find(done.task.arguments.at("form"));
  if (forms == settings_.products.end()) return std::nullopt;
  return make_products(forms->second, done.task.key, done.task.arguments,
                       positive ? settings_.positive_content : 1, now, noise_, around);
}

void Laboratory::halt(Time now, Surroundings& around) {
  phases_.halt(now, around.body);
  run_.reset();
}

std::vector<world::NamedState> Laboratory::states() const {
  std::vector<world::NamedState> out;
  for (const auto& [sample, positive] : positive_) {
    const auto found = found_.find(sample);
    out.push_back(
        {"signature." + sample, found == found_.end() ? State{"unknown", {}} : to_state(found->second)});
  }
  return out;
}

world::Memory Laboratory::memory() const {
  world::Memory out;
  for (const auto& [sample, positive] : found_) out[sample] = to_state(positive);
  return out;
}

void Laboratory::restore(const world::Memory& memory) {
  for (const auto& [sample, value] : memory) {
    const auto* state = std::get_if<State>(&value);
    if (state && positive_.contains(sample)) found_[sample] = state->name == "positive";
  }
}

}  // namespace roci::sim::components
