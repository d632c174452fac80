#include "planner_svc/utility_htn/checking/sent_downlinks.hpp"

#include <algorithm>

#include "planner_svc/utility_htn/checking/version.hpp"

namespace roci::planner::utility_htn::checking {

namespace {

// Returns the seconds of the longest sol that the network permits.
double longest_sol_s(const model::Network& network) {
  const auto found = std::ranges::find(network.parameters, "sol_s", &model::Parameter::name);
  return found == network.parameters.end() ? 86'400 : std::max(1.0, found->highest);
}

}  // namespace

void SentDownlinks::take(const model::Network& network, const engine::CheckedPlan& checked) {
  if (checked.progress == nullptr) return;
  for (const temporal::FlexiblePlan* plan : {checked.before, &checked.plan})
    if (plan != nullptr)
      for (const Step& step : downlinks_over(network, *plan, *checked.progress))
        sent_[step.id] = {network.tasks[step.task].id, step};
  const double longest_s = longest_sol_s(network);
  std::erase_if(sent_, [&](const auto& sent) {
    return temporal::to_seconds(checked.request.origin - sent.second.step.start) >= longest_s;
  });
}

std::vector<Step> SentDownlinks::steps(const model::Network& network) const {
  std::vector<Step> out;
  for (const auto& [id, sent] : sent_) {
    const auto task = std::ranges::find(network.tasks, sent.task, &model::Task::id);
    if (task == network.tasks.end()) continue;
    out.push_back(sent.step);
    out.back().task = static_cast<model::TaskIndex>(task - network.tasks.begin());
  }
  return out;
}

}  // namespace roci::planner::utility_htn::checking
