#include "planner_svc/utility_htn/adapter/measurements.hpp"

#include <algorithm>
#include <utility>

#include "planner_svc/utility_htn/adapter/products.hpp"

namespace roci::planner::utility_htn::adapter {

using assessor::Measured;

// Where the executive's word is missing, the owner's tell.
std::uint32_t Measurements::Heard::last_attempt() const {
  if (attempt != 0) return attempt;
  return results.empty() ? 0 : results.rbegin()->first;
}

void Measurements::hear(const engine::StepStatus& step) {
  const temporal::ActivityProgress& progress = step.progress;
  if (progress.state != temporal::ActivityState::succeeded || !progress.started || !progress.ended) return;
  Heard& heard = heard_[step.activity];
  heard.took = *progress.ended - *progress.started;
  heard.attempt = std::max(heard.attempt, step.attempt);
}

void Measurements::hear(const engine::CommandResult& result) {
  heard_[result.activity].results.insert_or_assign(result.attempt, result);
}

// The commands of the attempt that succeeded are the last ones, and theirs are energy and values. The time from the
// start of the activity on holds the attempts that failed, too, and says nothing of what the task takes.
std::optional<Measured> Measurements::measured(const Heard& heard, std::size_t commands) {
  if (commands == 0 || heard.results.empty()) return std::nullopt;
  const std::uint32_t last = heard.last_attempt();
  Measured out;
  out.energy = 0;
  out.values.emplace();
  for (std::size_t before = 0; before < commands; ++before) {
    if (before >= last) return std::nullopt;
    const auto found = heard.results.find(last - static_cast<std::uint32_t>(before));
    if (found == heard.results.end()) return std::nullopt;
    const engine::CommandResult& result = found->second;
    out.energy = out.energy && result.energy_j ? std::optional(*out.energy + *result.energy_j) : std::nullopt;
    out.values->insert(result.values.begin(), result.values.end());  // of two of a name the later counts
  }
  const double seconds = temporal::to_seconds(*heard.took);
  if (out.energy && seconds > 0 && last <= commands) out.power = *out.energy / seconds;
  return out;
}

std::vector<Measurements::Measurement> Measurements::take(const model::Network& network) {
  std::vector<Measurement> out;
  for (auto& [activity, heard] : heard_) {
    if (!heard.took || taken_.contains(activity)) continue;
    const model::TaskIndex task = task_of_activity(network, activity);
    if (task >= network.tasks.size() || network.tasks[task].learns.empty()) continue;
    const model::Task& of = network.tasks[task];
    const bool tried_again = heard.last_attempt() > of.commands.size();
    if (!std::exchange(heard.duration_taken, true) && !tried_again)
      out.push_back({task, {temporal::to_seconds(*heard.took), {}, {}, {}}});
    const bool more = std::ranges::any_of(
        of.learns, [](const model::Learns& learns) { return learns.measure != model::Measure::duration_s; });
    if (more) {
      std::optional<Measured> rest = measured(heard, of.commands.size());
      if (!rest) continue;
      out.push_back({task, std::move(*rest)});
    }
    taken_.insert(activity);
  }
  return out;
}

void Measurements::keep_only(const std::function<bool(const std::string&)>& is_kept) {
  std::erase_if(heard_, [&](const auto& one) { return !is_kept(one.first); });
  std::erase_if(taken_, [&](const std::string& one) { return !is_kept(one); });
}

}  // namespace roci::planner::utility_htn::adapter
