#include "exec_svc/reactor/resource_monitor.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "exec_svc/reactor/conjuncts.hpp"

namespace roci::exec::reactor {
namespace {

using temporal::Condition;
using temporal::ConditionNode;
using temporal::ConditionOp;
using temporal::PlanActivity;
using temporal::Value;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Sums of amounts round; a lack as small as that is none.
double slack(double value) { return 1e-9 * std::max(1.0, std::abs(value)); }

}  // namespace

ResourceMonitor::Segment::Segment() : least(-kInfinity), most(kInfinity) {}

bool ResourceMonitor::Segment::holds(double value) const {
  return value + slack(value) >= least && value - slack(value) <= most;
}

ResourceMonitor::Segment ResourceMonitor::join(const Segment& first, const Segment& second) {
  Segment out;
  out.change = first.change + second.change;
  out.least = std::max(first.least, second.least - first.change);
  out.most = std::min(first.most, second.most - first.change);
  return out;
}

void ResourceMonitor::Timeline::build(const std::vector<Segment>& of_activities) {
  const std::size_t leaves_wanted = std::bit_ceil(std::max<std::size_t>(of_activities.size(), 1));
  tree.assign(2 * leaves_wanted, Segment{});
  std::copy(of_activities.begin(), of_activities.end(),
            tree.begin() + static_cast<std::ptrdiff_t>(leaves_wanted));
  for (std::size_t i = leaves_wanted - 1; i > 0; --i) tree[i] = join(tree[2 * i], tree[2 * i + 1]);
}

void ResourceMonitor::Timeline::clear(std::size_t leaf) {
  std::size_t i = leaves() + leaf;
  tree[i] = Segment{};
  for (i /= 2; i > 0; i /= 2) tree[i] = join(tree[2 * i], tree[2 * i + 1]);
}

// Walks down to the first leaf that fails; `before` becomes the value that the activity will find.
std::optional<std::size_t> ResourceMonitor::Timeline::first_failing(double value, double& before) const {
  before = value;
  if (tree[1].holds(before)) return std::nullopt;
  std::size_t i = 1;
  while (i < leaves()) {
    i = 2 * i;
    if (!tree[i].holds(before)) continue;
    before += tree[i].change;
    ++i;
  }
  return i - leaves();
}

ResourceMonitor::ResourceMonitor(const temporal::FlexiblePlan& plan) {
  for (const PlanActivity& activity : plan.activities) {
    index_of_[activity.id] = activities_.size();
    activities_.push_back({activity.id, activity.pre, {}});
    for (const temporal::Impact& impact : activity.impacts)
      if (impact.kind == temporal::ImpactKind::delta) timelines_.try_emplace(impact.timeline);
  }
  for (const PlanActivity& activity : plan.activities)
    for (const temporal::Impact& impact : activity.impacts)
      if (impact.kind != temporal::ImpactKind::delta) timelines_.erase(impact.timeline);
  std::map<std::string, std::vector<Segment>> stretches;
  for (std::size_t i = 0; i < plan.activities.size(); ++i) {
    const PlanActivity& activity = plan.activities[i];
    std::map<std::string, Segment> touched;
    for (const temporal::Impact& impact : activity.impacts) {
      const double* amount = std::get_if<double>(&impact.amount);
      if (amount != nullptr && timelines_.contains(impact.timeline))
        touched[impact.timeline].change += *amount;
    }
    for (const auto& [timeline, stretch] : touched) activities_[i].changes[timeline] = stretch.change;
    for (const ConditionNode& node : conjuncts(activity.pre)) {
      const double* limit = std::get_if<double>(&node.operand);
      if (limit == nullptr || !timelines_.contains(node.timeline)) continue;
      Segment& stretch = touched[node.timeline];
      if (node.op == ConditionOp::ge || node.op == ConditionOp::gt)
        stretch.least = std::max(stretch.least, *limit);
      if (node.op == ConditionOp::le || node.op == ConditionOp::lt)
        stretch.most = std::min(stretch.most, *limit);
    }
    for (const auto& [timeline, stretch] : touched) {
      timelines_[timeline].activities.push_back(i);
      stretches[timeline].push_back(stretch);
    }
  }
  for (auto& [name, timeline] : timelines_) timeline.build(stretches[name]);
}

void ResourceMonitor::remove(const std::string& activity) {
  const auto index = index_of_.find(activity);
  if (index == index_of_.end()) return;
  for (auto& [name, timeline] : timelines_) {
    const auto& touching = timeline.activities;
    const auto leaf = std::lower_bound(touching.begin(), touching.end(), index->second);
    if (leaf != touching.end() && *leaf == index->second)
      timeline.clear(static_cast<std::size_t>(leaf - touching.begin()));
  }
}

void ResourceMonitor::charge_again(const std::string& activity, const temporal::Lookup& now) {
  settle(activity);
  const auto index = index_of_.find(activity);
  if (index == index_of_.end()) return;
  for (const auto& [timeline, change] : activities_[index->second].changes) {
    const auto value = now(timeline);
    const double* number = value ? std::get_if<double>(&*value) : nullptr;
    if (number != nullptr) charges_[timeline].push_back({activity, change, *number + change});
  }
}

void ResourceMonitor::settle(const std::string& activity) {
  for (auto& [timeline, charges] : charges_)
    std::erase_if(charges, [&](const Charge& charge) { return charge.activity == activity; });
}

double ResourceMonitor::Charge::remaining(double value) const {
  const double left = expected - value;
  return change < 0 ? std::clamp(left, change, 0.0) : std::clamp(left, 0.0, change);
}

std::optional<PredictedConflict> ResourceMonitor::conflict(const temporal::Lookup& now) const {
  std::optional<std::size_t> first;
  std::optional<PredictedConflict> out;
  for (const auto& [name, timeline] : timelines_) {
    const auto value = now(name);
    const double* number = value ? std::get_if<double>(&*value) : nullptr;
    if (number == nullptr) continue;
    double left = *number;
    if (const auto charges = charges_.find(name); charges != charges_.end())
      for (const Charge& charge : charges->second) left += charge.remaining(*number);
    double before = 0;
    const auto leaf = timeline.first_failing(left, before);
    if (!leaf || (first && *first <= timeline.activities[*leaf])) continue;
    first = timeline.activities[*leaf];
    const Asked& activity = activities_[*first];
    const auto projected = [&, &name = name](const std::string& asked) -> std::optional<Value> {
      return asked == name ? std::optional<Value>(before) : std::nullopt;
    };
    for (const ConditionNode& node : conjuncts(activity.pre)) {
      const Condition part{{node}};
      if (node.timeline == name && temporal::evaluate(part, projected) == temporal::Truth::no)
        out = PredictedConflict{activity.id, temporal::explain(part, projected)};
    }
  }
  return out;
}

}  // namespace roci::exec::reactor
