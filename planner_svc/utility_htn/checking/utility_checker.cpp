#include "planner_svc/utility_htn/checking/utility_checker.hpp"

#include <algorithm>
#include <iterator>

#include "planner_svc/utility_htn/checking/check.hpp"
#include "planner_svc/utility_htn/checking/version.hpp"
#include "planner_svc/utility_htn/reading/load.hpp"

namespace roci::planner::utility_htn::checking {

namespace {

std::optional<double> number(const temporal::timelines::Definition& timeline, const temporal::Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* truth = std::get_if<bool>(&value); truth != nullptr && timeline.states.empty())
    return *truth;
  const auto state = std::ranges::find(timeline.states, temporal::to_text(value));
  if (state == timeline.states.end()) return std::nullopt;
  return static_cast<double>(state - timeline.states.begin());
}

std::optional<double> newest(const std::vector<Observation>& expected, temporal::timelines::Index timeline) {
  std::optional<Observation> out;
  for (const Observation& one : expected)
    if (one.timeline == timeline && (!out || one.sampled > out->sampled)) out = one;
  return out ? std::optional(out->value) : std::nullopt;
}

bool stands_in(const std::vector<Step>& steps, const Step& one) {
  return std::ranges::find(steps, one.id, &Step::id) != steps.end();
}

}  // namespace

std::vector<std::string> faults_of(const model::Network& network, const engine::CheckedPlan& checked,
                                   std::span<const Step> sent) {
  const temporal::Time now = checked.request.origin;
  Version version = version_of(network, checked.plan, checked.progress, now);
  if (!version.faults.empty()) return version.faults;
  std::vector<Observation> expected = std::move(version.expected);
  Question question{.network = network, .values = version.values, .plan = std::move(version.blocks)};
  if (checked.before != nullptr) {
    Version before = version_of(network, *checked.before, checked.progress, now);
    expected.insert(expected.end(), before.expected.begin(), before.expected.end());
    std::erase_if(before.blocks, [&](const Block& block) {
      return before.over.contains(number_of(block)) || version.broken.contains(number_of(block));
    });
    question.before = std::move(before.blocks);
  }
  question.rests = std::move(version.rests);
  question.broken_off = std::move(version.broken_off);
  std::ranges::copy_if(sent, std::back_inserter(question.sent), [&](const Step& one) {
    return !stands_in(question.rests, one) && std::ranges::none_of(question.plan, [&](const Block& block) {
      return stands_in(block.steps, one);
    });
  });
  question.downlinks_told = false;
  question.observations = std::move(version.internal);
  question.closed = std::move(version.closed);
  question.origin = checked.plan.origin;
  question.now = now;
  question.from = now + network.cycle.commit_window;
  const auto& budget = network.timelines[network.budget];
  question.budget = budget.initial - budget.lowest;
  for (temporal::timelines::Index i = 0; i < network.timelines.size(); ++i) {
    const auto& timeline = network.timelines[i];
    const auto observed = checked.request.state.find(timeline.name);
    if (!timeline.reported || observed == checked.request.state.end()) continue;
    const auto value = number(timeline, observed->second);
    if (!value) continue;
    question.observations.push_back({i, now, newest(expected, i).value_or(*value)});
    if (i == network.budget) question.budget = *value - timeline.lowest;
  }
  return faults(question);
}

std::vector<std::string> UtilityChecker::faults(const engine::CheckedPlan& checked) const {
  const model::Network& of = network(checked.model_file);
  std::vector<Step> sent;
  {
    const std::scoped_lock lock(mutex_);
    sent_.take(of, checked);
    sent = sent_.steps(of);
  }
  return faults_of(of, checked, sent);
}

const model::Network& UtilityChecker::network(const std::filesystem::path& file) const {
  const std::scoped_lock lock(mutex_);
  if (!network_ || file_ != file) {
    network_ = reading::load_network(file);
    file_ = file;
  }
  return *network_;
}

}  // namespace roci::planner::utility_htn::checking
