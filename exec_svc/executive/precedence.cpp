#include "exec_svc/executive/precedence.hpp"

#include <algorithm>
#include <cstdint>

namespace roci::exec::executive {

using temporal::TimePoint;

namespace {

using Links = std::vector<std::vector<TimePoint>>;

/// Finds strongly connected components by Tarjan's algorithm without recursion.
class Components {
 public:
  explicit Components(const Links& links) : links_(links), order_(links.size(), 0), low_(links.size(), 0) {
    component_.assign(links.size(), unassigned);
    for (TimePoint p = 0; p < links.size(); ++p)
      if (order_[p] == 0) visit(p);
  }

  std::vector<std::vector<TimePoint>> groups;  ///< members of each component

 private:
  struct Frame {
    TimePoint point;
    std::size_t next_link;
  };

  void visit(TimePoint root) {
    std::vector<Frame> frames{open(root)};
    while (!frames.empty()) {
      Frame& frame = frames.back();
      const TimePoint point = frame.point;
      if (frame.next_link < links_[point].size()) {
        const TimePoint next = links_[point][frame.next_link++];
        if (order_[next] == 0) {
          frames.push_back(open(next));
        } else if (component_[next] == unassigned) {
          low_[point] = std::min(low_[point], order_[next]);
        }
        continue;
      }
      frames.pop_back();
      if (!frames.empty()) low_[frames.back().point] = std::min(low_[frames.back().point], low_[point]);
      if (low_[point] == order_[point]) close(point);
    }
  }

  Frame open(TimePoint point) {
    order_[point] = low_[point] = ++visited_;
    stack_.push_back(point);
    return {point, 0};
  }

  void close(TimePoint root) {
    std::vector<TimePoint>& group = groups.emplace_back();
    do {
      group.push_back(stack_.back());
      component_[stack_.back()] = groups.size();
      stack_.pop_back();
    } while (group.back() != root);
  }

  static constexpr std::size_t unassigned = 0;
  const Links& links_;
  std::vector<std::uint32_t> order_, low_;
  std::vector<std::size_t> component_;
  std::vector<TimePoint> stack_;
  std::uint32_t visited_ = 0;
};

void join_group(const std::vector<TimePoint>& group, const std::vector<PointOwner>& owners,
                Precedence& precedence) {
  Links& predecessors = precedence.predecessors;
  std::vector<TimePoint> outside;
  std::vector<TimePoint> observed;
  std::vector<TimePoint> starts;
  const auto member = [&](TimePoint p) { return std::find(group.begin(), group.end(), p) != group.end(); };
  const auto started_inside = [&](TimePoint end) {
    return std::any_of(group.begin(), group.end(), [&](TimePoint p) {
      return owners[p].role == PointRole::start && owners[p].activity == owners[end].activity;
    });
  };
  for (const TimePoint p : group) {
    for (const TimePoint q : predecessors[p])
      if (!member(q)) outside.push_back(q);
    if (owners[p].role == PointRole::observed_end && !started_inside(p)) observed.push_back(p);
    if (owners[p].role == PointRole::start) starts.push_back(p);
  }
  for (const TimePoint p : group) {
    predecessors[p] = outside;
    if (owners[p].role != PointRole::observed_end)
      predecessors[p].insert(predecessors[p].end(), observed.begin(), observed.end());
    if (owners[p].role == PointRole::free || owners[p].role == PointRole::internal_end)
      predecessors[p].insert(predecessors[p].end(), starts.begin(), starts.end());
  }
  for (const TimePoint p : starts) {
    precedence.together[p] = starts;
    std::erase(precedence.together[p], p);
  }
}

void sort_once(std::vector<TimePoint>& points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
}

}  // namespace

std::vector<PointOwner> point_owners(const temporal::FlexiblePlan& plan) {
  std::vector<PointOwner> owners(plan.point_count);
  for (std::size_t i = 0; i < plan.activities.size(); ++i) {
    const temporal::PlanActivity& activity = plan.activities[i];
    owners[activity.start_point] = {PointRole::start, i};
    owners[activity.end_point] = {activity.owner.empty() ? PointRole::internal_end : PointRole::observed_end,
                                  i};
  }
  return owners;
}

Precedence precedence_of(const std::vector<temporal::TemporalConstraint>& constraints,
                         const std::vector<PointOwner>& owners) {
  Precedence precedence{Links(owners.size()), Links(owners.size()), Links(owners.size())};
  const auto precede = [&](TimePoint first, TimePoint second) {
    if (first != temporal::origin_point && second != temporal::origin_point)
      precedence.predecessors[second].push_back(first);
  };
  for (const temporal::TemporalConstraint& c : constraints) {
    if (c.lower >= temporal::Duration{0}) precede(c.from_point, c.to_point);
    if (c.upper == temporal::Duration{0}) precede(c.to_point, c.from_point);
  }
  for (const auto& group : Components(precedence.predecessors).groups)
    if (group.size() > 1) join_group(group, owners, precedence);
  for (TimePoint p = 0; p < owners.size(); ++p) {
    sort_once(precedence.predecessors[p]);
    for (const TimePoint q : precedence.predecessors[p]) precedence.successors[q].push_back(p);
  }
  return precedence;
}

}  // namespace roci::exec::executive
