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

// Returns the lack that counts as none, since sums of amounts are rounded.
double slack(double value) { return 1e-9 * std::max(1.0, std::abs(value)); }

}  // namespace

ResourceMonitor::Segment::Segment() : least(-kInfinity), most(kInfinity) {}

bool ResourceMonitor::Segment::holds(const Range& values) const {
  return values.high + slack(values.high) >= least && values.low - slack(values.low) <= most;
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
std::optional<std::size_t> ResourceMonitor::Timeline::first_failing(Range values, Range& before) const {
  before = values;
  if (tree[1].holds(before)) return std::nullopt;
  std::size_t i = 1;
  while (i < leaves()) {
    i = 2 * i;
    if (!tree[i].holds(before)) continue;
    before.low += tree[i].change;
    before.high += tree[i].change;
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
      if (impact.kind != temporal::ImpactKind::delta || impact.moment == temporal::ImpactWhen::during)
        timelines_.erase(impact.timeline);
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

void ResourceMonitor::begin(const std::string& activity) {
  const auto index = index_of_.find(activity);
  if (index != index_of_.end()) under_way_.insert(index->second);
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
  if (const auto index = index_of_.find(activity); index != index_of_.end()) under_way_.erase(index->second);
  for (auto& [timeline, charges] : charges_)
    std::erase_if(charges, [&](const Charge& charge) { return charge.activity == activity; });
}

void ResourceMonitor::end(const std::string& activity, const temporal::Lookup& now) {
  const auto index = index_of_.find(activity);
  if (index != index_of_.end() && under_way_.contains(index->second)) {
    for (const auto& [timeline, change] : activities_[index->second].changes) {
      const auto value = now(timeline);
      const double* number = value ? std::get_if<double>(&*value) : nullptr;
      if (number != nullptr) unseen_ends_[timeline][index->second] = *number;
    }
  }
  settle(activity);
}

double ResourceMonitor::Charge::remaining(double value) const {
  const double left = expected - value;
  return change < 0 ? std::clamp(left, change, 0.0) : std::clamp(left, 0.0, change);
}

ResourceMonitor::Range ResourceMonitor::reckoned(const std::string& timeline, double value) const {
  Range out{value, value};
  if (const auto charges = charges_.find(timeline); charges != charges_.end()) {
    for (const Charge& charge : charges->second) {
      out.low += charge.remaining(value);
      out.high += charge.remaining(value);
    }
  }
  const auto may_come = [&](std::size_t activity) {
    const auto change = activities_[activity].changes.find(timeline);
    if (change == activities_[activity].changes.end()) return;
    (change->second < 0 ? out.low : out.high) += change->second;
  };
  for (const std::size_t activity : under_way_) may_come(activity);
  if (const auto ends = unseen_ends_.find(timeline); ends != unseen_ends_.end())
    for (const auto& [activity, value_then] : ends->second)
      if (value_then == value) may_come(activity);
  return out;
}

std::optional<PredictedConflict> ResourceMonitor::conflict(const temporal::Lookup& now) const {
  std::optional<std::size_t> first;
  std::optional<PredictedConflict> out;
  for (const auto& [name, timeline] : timelines_) {
    const auto value = now(name);
    const double* number = value ? std::get_if<double>(&*value) : nullptr;
    if (number == nullptr) continue;
    Range before{};
    const auto leaf = timeline.first_failing(reckoned(name, *number), before);
    if (!leaf || (first && *first <= timeline.activities[*leaf])) continue;
    first = timeline.activities[*leaf];
    const Asked& activity = activities_[*first];
    for (const ConditionNode& node : conjuncts(activity.pre)) {
      const Condition part{{node}};
      const bool upper = node.op == ConditionOp::le || node.op == ConditionOp::lt;
      const auto projected = [&, &name = name](const std::string& asked) -> std::optional<Value> {
        return asked == name ? std::optional<Value>(upper ? before.low : before.high) : std::nullopt;
      };
      if (node.timeline == name && temporal::evaluate(part, projected) == temporal::Truth::no)
        out = PredictedConflict{activity.id, temporal::explain(part, projected)};
    }
  }
  return out;
}

}  // namespace roci::exec::reactor
