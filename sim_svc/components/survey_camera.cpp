#include "sim_svc/components/survey_camera.hpp"

#include <utility>

namespace roci::sim::components {

using temporal::State;
using temporal::Time;
using world::Ending;
using world::Failure;
using world::Surroundings;

SurveyCamera::SurveyCamera(SurveyCameraSettings settings, world::RandomStream noise)
    : PhasedComponent(settings.zone), settings_(std::move(settings)), noise_(std::move(noise)) {}

State SurveyCamera::state() const { return run_ ? State{"surveying", {run_->command}} : State{"idle", {}}; }

Ending SurveyCamera::begin(const world::Task& task, Time now, Surroundings& around) {
  results_.clear();
  if (task.command == "find_targets" && !settings_.values.empty() &&
      !settings_.values.contains(task.arguments.at("site")))
    return Failure{"unknown-site", "there is no site '" + task.arguments.at("site") + "'"};
  const Survey& survey = settings_.surveys.at(task.command);
  const double duration_s =
      survey.duration_s * settings_.duration_factor * noise_.factor(settings_.duration_noise);
  const double power = noise_.factor(settings_.power_noise);
  const Phase looking{Phase::Until::over, duration_s, power * survey.power_w, power * survey.heat_w};
  if (Ending refused = phases_.begin({Phase::warming(), looking}, now, around.body)) return refused;
  run_ = task;
  around.effects.push_back({task.command, task.arguments.contains("site") ? task.arguments.at("site") : ""});
  return std::nullopt;
}

Ending SurveyCamera::finish(Surroundings& around) {
  const Time now = *next_change();
  if (phases_.go_on(around.body)) return std::nullopt;
  const world::Task done = *std::exchange(run_, std::nullopt);
  if (hollow_.take(done.command)) return std::nullopt;
  if (done.command == "find_sites") {
    for (const auto& [site, value] : settings_.values) results_["value_" + site] = value;
  } else if (done.command == "find_targets") {
    const std::string prefix = done.arguments.at("site") + "_";
    for (const auto& [target, value] : settings_.visual)
      if (target.starts_with(prefix)) results_["visual_" + target] = value;
  }
  const auto products = settings_.products.find(done.command);
  if (products == settings_.products.end()) return std::nullopt;
  return make_products(products->second, done.key, done.arguments, 1, now, noise_, around);
}

void SurveyCamera::halt(Time now, Surroundings& around) {
  phases_.halt(now, around.body);
  run_.reset();
}

}  // namespace roci::sim::components
