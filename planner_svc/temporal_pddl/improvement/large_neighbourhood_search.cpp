#include "planner_svc/temporal_pddl/improvement/large_neighbourhood_search.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace roci::planner::temporal_pddl::improvement {

using search::Guide;
using search::PlanPrefix;
using search::SearchContext;
using task::ObjectId;
using task::Snap;
using task::SnapKind;
using temporal::Duration;

namespace {

constexpr std::array<std::int64_t, 3> kWeights = {1, 2, 5};
constexpr std::size_t kSizes = 6;  // up to 64 actions go
constexpr std::size_t kMostEvaluations = 200;

}  // namespace

LargeNeighbourhoodSearch::LargeNeighbourhoodSearch(const SearchContext& context,
                                                   std::span<const Guide> guides)
    : task_(context.task), guides_(guides), completion_(context), random_(context.options.seed + 1) {
  repair_rules_.push_back({{false, false, false}});
  repair_rules_.push_back({{true, false, false}});
  repair_rules_.push_back({{true, true, false}});
  repair_rules_.push_back({{true, false, true}});
  repair_rules_.push_back({{true, true, true}});
}

void LargeNeighbourhoodSearch::find_units(const PlanPrefix& plan, PlanReplay& replay) {
  const std::vector<Duration>& times = *replay.check().earliest(plan);
  units_.clear();
  std::vector<std::size_t> unit_of(plan.steps.size());
  for (std::uint32_t i = 0; i < plan.steps.size(); ++i) {
    const Snap& snap = task_.snaps[plan.steps[i]];
    if (snap.kind == SnapKind::timed_literal) continue;
    if (snap.kind == SnapKind::end) {
      units_[unit_of[plan.start_of[i]]].end = times[i];
    } else {
      unit_of[i] = units_.size();
      units_.push_back({i, times[i], times[i], snap.action});
    }
  }
  std::ranges::stable_sort(units_, {}, &Unit::start);
}

// Returns how many actions go; small numbers are about as likely as large ones.
std::size_t LargeNeighbourhoodSearch::choose_size() {
  const std::size_t most = std::size_t{2} << below(kSizes);
  return std::min(1 + below(most), units_.size());
}

// Drops some actions that start one after the other.
void LargeNeighbourhoodSearch::choose_stretch() {
  const std::size_t size = choose_size();
  const std::size_t first = below(units_.size() - size + 1);
  for (std::size_t i = first; i < first + size; ++i) dropped_.push_back(units_[i].step);
}

// Drops the last actions.
void LargeNeighbourhoodSearch::choose_late() {
  for (std::size_t i = units_.size() - choose_size(); i < units_.size(); ++i)
    dropped_.push_back(units_[i].step);
}

// Drops some actions that have to do with one object.
void LargeNeighbourhoodSearch::choose_object() {
  const std::size_t size = choose_size();
  const std::size_t from = below(units_.size());
  const auto arguments = task_.action_arguments[units_[from].action];
  if (arguments.empty()) return choose_stretch();
  const ObjectId object = arguments[below(arguments.size())];
  for (std::size_t i = 0; i < units_.size() && dropped_.size() < size; ++i) {
    const Unit& unit = units_[(from + i) % units_.size()];
    if (std::ranges::count(task_.action_arguments[unit.action], object) > 0) dropped_.push_back(unit.step);
  }
}

// Chooses mostly the rule that gave most for its work.
LargeNeighbourhoodSearch::RepairRule& LargeNeighbourhoodSearch::choose_repair_rule() {
  if (below(3) == 0) return repair_rules_[below(repair_rules_.size())];
  return *std::ranges::max_element(repair_rules_, {}, [](const RepairRule& repair) {
    return static_cast<double>(repair.gains + 1) / static_cast<double>(repair.spent + 200);
  });
}

LargeNeighbourhoodSearch::Outcome LargeNeighbourhoodSearch::vary(PlanPrefix& plan, PlanReplay& replay) {
  find_units(plan, replay);
  if (units_.empty()) return {false, 1};
  const PlanQuality known = quality_of(task_, plan, replay.check());
  dropped_.clear();
  switch (below(4)) {
    case 0:
      choose_stretch();
      break;
    case 1:
      choose_late();
      break;
    default:
      choose_object();
  }
  const auto rest = replay.rest(plan.steps, dropped_);
  if (!rest) return {false, 1};
  const std::size_t lost = plan.steps.size() - rest->steps.size();
  RepairRule& repair = choose_repair_rule();
  repair.rule.weight = kWeights[below(kWeights.size())];
  repair.rule.evaluations = std::min(10 + 4 * lost, kMostEvaluations);
  auto found = completion_.find(rest->steps, known, guides_[below(guides_.size())], repair.rule);
  repair.spent += 1 + completion_.evaluated();
  if (found) {
    plan = std::move(*found);
    if (quality_of(task_, plan, replay.check()) < known) ++repair.gains;
  }
  return {found.has_value(), 1 + completion_.evaluated()};
}

}  // namespace roci::planner::temporal_pddl::improvement
