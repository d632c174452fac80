#include <algorithm>
#include <limits>
#include <unordered_map>
#include <unordered_set>

#include "core/temporal/flexible_plan.hpp"
#include "core/temporal/plan_bounds.hpp"
#include "core/temporal/schedule.hpp"

namespace roci::temporal {
namespace {

/// Collects the faults of one plan.
class PlanCheck {
 public:
  explicit PlanCheck(const FlexiblePlan& plan)
      : plan_(plan),
        largest_(Duration{std::numeric_limits<std::int64_t>::max() / 4 / (std::int64_t{plan.point_count} + 1)}) {}

  std::vector<std::string> run() {
    if (plan_.point_count == 0) return {"the plan has no time point; point 0 is its origin"};
    if (plan_.point_count > kMostPoints)
      return {"the plan has more than " + std::to_string(kMostPoints) + " time points"};
    for (std::size_t i = 0; i < plan_.activities.size(); ++i) check_id(i);
    for (const PlanActivity& activity : plan_.activities) check_activity(activity);
    for (std::size_t i = 0; i < plan_.tokens.size(); ++i) check_token(i);
    for (const DecisionPoint& decision : plan_.decisions) check_decision(decision);
    for (std::size_t i = 0; i < plan_.constraints.size(); ++i) check_constraint(i);
    if (faults_.empty()) check_hierarchy();
    if (faults_.empty()) check_network();
    return std::move(faults_);
  }

 private:
  void fault(const std::string& where, const std::string& what) { faults_.push_back(where + ": " + what); }

  void check_id(std::size_t index) {
    const std::string& id = plan_.activities[index].id;
    if (id.empty()) fault("activity " + std::to_string(index), "has no id");
    if (!index_of_.emplace(id, index).second) fault("activity " + id, "the id stands twice");
  }

  void check_point(const std::string& where, const char* which, TimePoint point) {
    if (point >= plan_.point_count)
      fault(where, std::string(which) + " point " + std::to_string(point) + " is not below point_count " +
                       std::to_string(plan_.point_count));
  }

  void check_bounds(const std::string& where, Duration lower, Duration upper) {
    if (lower > upper)
      fault(where, "lower bound " + to_text(lower) + " is above upper bound " + to_text(upper));
    for (const Duration bound : {lower, upper})
      if (bounded(bound) && (bound > largest_ || bound < -largest_))
        fault(where, "bound " + to_text(bound) + " is too large for exact sums; leave it unbounded");
  }

  void check_condition(const std::string& where, const char* which, const Condition& condition) {
    if (const std::string wrong = check(condition); !wrong.empty())
      fault(where, std::string(which) + ": " + wrong);
  }

  void check_activity(const PlanActivity& activity) {
    const std::string where = "activity " + activity.id;
    for (const TimePoint point : {activity.start_point, activity.end_point}) {
      if (point == origin_point) fault(where, "its time points must not be the origin");
      check_point(where, "time", point);
      if (point != origin_point && !owned_points_.insert(point).second)
        fault(where, "time point " + std::to_string(point) +
                         " belongs to an activity already; give each its own and join them by [0, 0]");
    }
    check_bounds(where, activity.duration_lower, activity.duration_upper);
    if (activity.duration_lower < Duration{0}) fault(where, "its shortest duration is negative");
    check_commands(where, activity);
    if (!activity.utility.finite()) fault(where, "its utility is not finite");
    if (bounded(activity.preferred_start) && activity.preferred_start < Duration{0})
      fault(where, "its preferred start lies before the origin");
    if (activity.wait_timeout < Duration{0}) fault(where, "its wait timeout is negative");
    if (activity.lateness == LatenessPolicy::push && !bounded(activity.wait_timeout))
      fault(where, "lateness push needs a wait timeout");
    check_condition(where, "pre", activity.pre);
    check_condition(where, "maintenance", activity.maintenance);
    check_condition(where, "post", activity.post);
    check_condition(where, "skip_if", activity.skip_if);
    for (const Impact& impact : activity.impacts) check_impact(where, impact);
  }

  void check_commands(const std::string& where, const PlanActivity& activity) {
    if (!activity.owner.empty() && activity.command_name.empty()) fault(where, "has an owner but no command");
    if (activity.owner.empty() && !activity.then.empty())
      fault(where, "has commands that follow, but no first one");
    if (activity.answer_within <= Duration{0}) fault(where, "its command must be answered in no time");
    for (const PlanCommand& command : activity.then) {
      if (command.owner.empty() || command.command_name.empty())
        fault(where, "a command that follows lacks its owner or its name");
      if (command.answer_within <= Duration{0})
        fault(where, "a command that follows must be answered in no time");
    }
  }

  void check_impact(const std::string& where, const Impact& impact) {
    if (impact.timeline.empty()) fault(where, "an impact names no timeline");
    const bool number = std::holds_alternative<double>(impact.amount);
    if (impact.kind != ImpactKind::assign && !number)
      fault(where, "impact on " + impact.timeline + " needs a number");
    if (impact.kind == ImpactKind::rate && impact.moment != ImpactWhen::during)
      fault(where, "a rate on " + impact.timeline + " can only act during the activity");
  }

  void check_token(std::size_t index) {
    const Token& token = plan_.tokens[index];
    const std::string where = "token " + std::to_string(index) + " on " + token.timeline;
    if (token.timeline.empty()) fault(where, "names no timeline");
    check_point(where, "start", token.start_point);
    check_point(where, "end", token.end_point);
  }

  void check_decision(const DecisionPoint& decision) {
    const std::string where = "decision " + decision.id;
    if (decision.id.empty()) fault(where, "has no id");
    if (!decisions_.insert(decision.id).second) fault(where, "the id stands twice");
    if (decision.choices.empty() && decision.bindings.empty())
      fault(where, "has no choices, and no arguments that it binds");
    if (!decision.choices.empty() && !decision.bindings.empty())
      fault(where, "picks among choices and binds arguments; make two decisions of it");
    if (decision.resolver_kind == ResolverKind::rule && decision.choices.empty())
      fault(where, "a rule picks among choices; it binds no argument");
    if (decision.resolver_kind == ResolverKind::rule && !decision.resolver.empty())
      fault(where, "a rule is resolved by the plan itself, not by " + decision.resolver);
    check_point(where, "decide_before", decision.decide_before);
    if (decision.decide_before == origin_point) fault(where, "decide_before must not be the origin");
    std::unordered_set<std::string> names;
    for (const DecisionChoice& choice : decision.choices) {
      if (!names.insert(choice.name).second) fault(where, "choice " + choice.name + " stands twice");
      for (const std::string& id : choice.activities)
        if (!index_of_.contains(id))
          fault(where, "choice " + choice.name + " names no activity of the plan: " + id);
      check_condition(where, "rule", choice.rule);
    }
    for (const ArgumentBinding& binding : decision.bindings) {
      if (!index_of_.contains(binding.activity))
        fault(where, "binds an argument of no activity of the plan: " + binding.activity);
      if (binding.argument.empty()) fault(where, "binds an argument without a name");
    }
  }

  void check_constraint(std::size_t index) {
    const TemporalConstraint& constraint = plan_.constraints[index];
    const std::string where = "constraint " + std::to_string(index);
    check_point(where, "from", constraint.from_point);
    check_point(where, "to", constraint.to_point);
    if (constraint.from_point == constraint.to_point) fault(where, "joins a point with itself");
    if (constraint.upper < Duration{0}) fault(where, "its upper bound is negative; turn it round");
    check_bounds(where, constraint.lower, constraint.upper);
  }

  void check_hierarchy() {
    for (const PlanActivity& activity : plan_.activities) {
      std::string parent = activity.parent;
      for (std::size_t steps = 0; !parent.empty(); ++steps) {
        const auto found = index_of_.find(parent);
        if (found == index_of_.end()) {
          if (steps == 0) fault("activity " + activity.id, "its parent is not in the plan: " + parent);
          break;
        }
        if (steps > plan_.activities.size() || parent == activity.id) {
          fault("activity " + activity.id, "is its own ancestor");
          break;
        }
        parent = plan_.activities[found->second].parent;
      }
    }
  }

  void check_network() {
    const std::vector<TemporalConstraint> constraints = all_constraints(plan_);
    if (earliest_schedule(plan_.point_count, constraints)) return;
    Stn network(
        plan_.point_count);  // slower, but it knows the first constraint that contradicts those before it
    for (const TemporalConstraint& c : constraints) {
      if (network.add(c.from_point, c.to_point, c.lower, c.upper)) continue;
      fault("network", "no schedule satisfies it: point " + std::to_string(c.to_point) + " cannot lie " +
                           to_text(c.lower) + " to " + to_text(c.upper) + " after point " +
                           std::to_string(c.from_point));
      return;
    }
  }

  const FlexiblePlan& plan_;
  Duration largest_;
  std::unordered_map<std::string, std::size_t> index_of_;
  std::unordered_set<TimePoint> owned_points_;
  std::unordered_set<std::string> decisions_;
  std::vector<std::string> faults_;
};

}  // namespace

std::vector<std::string> check(const FlexiblePlan& plan) { return PlanCheck(plan).run(); }

std::vector<TemporalConstraint> all_constraints(const FlexiblePlan& plan) {
  std::vector<TemporalConstraint> all;
  all.reserve(plan.activities.size() + plan.point_count + plan.tokens.size() + plan.constraints.size());
  std::unordered_map<TimePoint, std::size_t> activity_at;
  for (const PlanActivity& activity : plan.activities) {
    activity_at[activity.start_point] = all.size();
    all.push_back({activity.start_point, activity.end_point, ConstraintKind::duration,
                   activity.duration_lower, activity.duration_upper});
  }
  for (TimePoint point = 1; point < plan.point_count; ++point)
    all.push_back({origin_point, point, ConstraintKind::window, Duration{0}, no_bound});
  for (const Token& token : plan.tokens)
    if (token.start_point != token.end_point)
      all.push_back({token.start_point, token.end_point, ConstraintKind::ordering, Duration{0}, no_bound});
  for (const TemporalConstraint& constraint : plan.constraints) {
    const auto found = activity_at.find(constraint.from_point);
    const bool own_duration = constraint.kind == ConstraintKind::duration && found != activity_at.end() &&
                              plan.activities[found->second].end_point == constraint.to_point;
    if (!own_duration) {
      all.push_back(constraint);
      continue;
    }
    TemporalConstraint& duration = all[found->second];
    duration.lower = std::max(duration.lower, constraint.lower);
    duration.upper = std::min(duration.upper, constraint.upper);
  }
  return all;
}

}  // namespace roci::temporal
