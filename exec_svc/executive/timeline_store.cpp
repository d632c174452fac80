#include "exec_svc/executive/timeline_store.hpp"

namespace roci::exec::executive {

using temporal::Impact;
using temporal::ImpactKind;
using temporal::ImpactWhen;
using temporal::Value;

void TimelineStore::observe(const std::string& timeline, const Value& value) { observed_[timeline] = value; }

void TimelineStore::set(const std::string& timeline, const Value& value) {
  const auto observed = observed_.find(timeline);
  (observed != observed_.end() ? observed->second : internal_[timeline]) = value;
}

std::optional<Value> TimelineStore::value_of(const std::string& timeline) const {
  if (const auto found = observed_.find(timeline); found != observed_.end()) return found->second;
  if (const auto found = internal_.find(timeline); found != internal_.end()) return found->second;
  return std::nullopt;
}

std::optional<Value> TimelineStore::value_without(const std::string& activity,
                                                  const std::string& timeline) const {
  std::optional<Value> out = value_of(timeline);
  const auto taken = lasting_.find(activity);
  auto* const number = out ? std::get_if<double>(&*out) : nullptr;
  if (taken == lasting_.end() || number == nullptr || observed_.contains(timeline)) return out;
  for (const Lasting& impact : taken->second)
    if (impact.kind == ImpactKind::delta && impact.timeline == timeline) *number -= impact.amount;
  return out;
}

void TimelineStore::advance(temporal::Time now) {
  const double elapsed = now_ ? temporal::to_seconds(now - *now_) : 0.0;
  now_ = now;
  if (elapsed <= 0) return;
  for (const auto& [activity, impacts] : lasting_)
    for (const Lasting& impact : impacts)
      if (impact.kind == ImpactKind::rate) add(impact.timeline, impact.amount * elapsed);
}

bool TimelineStore::is_internal(const temporal::PlanActivity& activity, const Impact& impact) const {
  return activity.owner.empty() || internal_.contains(impact.timeline);
}

void TimelineStore::begin(const temporal::PlanActivity& activity) {
  std::vector<Lasting> lasting;
  for (const Impact& impact : activity.impacts) {
    if (!is_internal(activity, impact)) continue;
    if (impact.moment == ImpactWhen::at_start) apply(impact);
    if (impact.moment != ImpactWhen::during) continue;
    const auto* amount = std::get_if<double>(&impact.amount);
    const auto before = internal_.find(impact.timeline);
    lasting.push_back({impact.timeline, impact.kind, amount ? *amount : 0.0,
                       before == internal_.end() ? std::nullopt : std::optional(before->second)});
    if (impact.kind != ImpactKind::rate) apply(impact);
  }
  if (!lasting.empty()) lasting_[activity.id] = std::move(lasting);
}

void TimelineStore::end(const temporal::PlanActivity& activity, bool succeeded) {
  if (const auto found = lasting_.find(activity.id); found != lasting_.end()) {
    for (const Lasting& impact : found->second) {
      if (impact.kind == ImpactKind::delta) add(impact.timeline, -impact.amount);
      if (impact.kind != ImpactKind::assign) continue;
      internal_.erase(impact.timeline);
      if (impact.before) internal_[impact.timeline] = *impact.before;
    }
    lasting_.erase(found);
  }
  if (!succeeded) return;
  for (const Impact& impact : activity.impacts)
    if (impact.moment == ImpactWhen::at_end && is_internal(activity, impact)) apply(impact);
}

void TimelineStore::apply(const Impact& impact) {
  if (impact.kind == ImpactKind::assign) {
    internal_[impact.timeline] = impact.amount;
  } else if (const auto* amount = std::get_if<double>(&impact.amount)) {
    add(impact.timeline, *amount);
  }
}

void TimelineStore::add(const std::string& timeline, double amount) {
  Value& value = internal_[timeline];
  const auto* number = std::get_if<double>(&value);
  value = (number ? *number : 0.0) + amount;
}

}  // namespace roci::exec::executive
