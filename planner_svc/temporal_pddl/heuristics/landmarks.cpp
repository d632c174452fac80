#include "planner_svc/temporal_pddl/heuristics/landmarks.hpp"

#include <algorithm>
#include <iterator>
#include <map>

#include "planner_svc/temporal_pddl/heuristics/landmark_orderings.hpp"

namespace roci::planner::temporal_pddl::heuristics {

using call::SearchLimits;
using task::ActionId, task::FactId, task::FactName, task::Goal, task::IdVector, task::Snap, task::SnapId,
    task::SnapKind, task::Task, task::TimedStep;

namespace {

constexpr std::size_t kMostAlternatives = 4;

class Finder {
 public:
  Finder(const Task& task, const RelaxedTask& relaxed, std::size_t max_visits, const SearchLimits& limits)
      : task_(task),
        relaxed_(relaxed),
        visits_left_(max_visits),
        limits_(limits),
        reached_(relaxed.propositions(), false),
        initially_(relaxed.propositions(), false),
        supporters_(relaxed.propositions()),
        is_left_out_(relaxed.propositions(), false),
        open_(relaxed.operators()) {
    RelaxedTask::each_fact(task, task.initial_state,
                           [&](FactId fact) { initially_[relaxed.proposition(fact)] = true; });
    explore();
  }

  IdVector<LandmarkId, Landmark> run(std::span<const SnapId> relaxed_plan) {
    if (task_.goals.size() == 1) {
      for (const FactId fact : task_.goals.front().facts) {
        const LandmarkId goal = add({relaxed_.proposition(fact)});
        found_[goal].goal = true;
      }
    }
    close();
    for (const SnapId op : relaxed_plan) {
      for (const PropositionId need : relaxed_.needs(op)) {
        if (initially_[need] || known_.contains({need}) || visits_left_ == 0) continue;
        explore_without(std::vector{need});
        if (goal_reached()) continue;
        add({need});
        close();
      }
    }
    order();
    return std::move(found_);
  }

 private:
  LandmarkId add(const std::vector<PropositionId>& any_of) {
    const auto [place, fresh] = known_.try_emplace(any_of, LandmarkId(found_.size()));
    if (fresh) {
      Landmark landmark;
      landmark.any_of = any_of;
      landmark.initially = std::ranges::any_of(any_of, [&](PropositionId p) { return initially_[p]; });
      found_.push_back(std::move(landmark));
      out_of_reach_.push_back({});
    }
    return place->second;
  }

  // Looks for what lies right before each landmark, and before that, until nothing is new.
  void close() {
    for (; closed_ < found_.size() && visits_left_ > 0; ++closed_) look_before(LandmarkId(closed_));
  }

  void look_before(LandmarkId id) {
    if (found_[id].initially) return;
    explore_without(found_[id].any_of);
    out_of_reach_[id] = reached_;
    std::vector<SnapId> first;
    for (const PropositionId proposition : found_[id].any_of) {
      std::ranges::copy_if(relaxed_.added_by(proposition), std::back_inserter(first),
                           [&](SnapId op) { return open_[op] == 0; });
    }
    if (first.empty()) return;
    for (const SnapId op : first) {
      const Snap& snap = task_.snaps[op];
      found_[id].achievers.push_back(snap.kind == SnapKind::end ? task_.actions[snap.action].start : op);
    }
    for (const PropositionId need : relaxed_.needs(first.front())) {
      const bool common = std::ranges::all_of(
          first, [&](SnapId op) { return std::ranges::count(relaxed_.needs(op), need) > 0; });
      if (common) right_before({need}, id);
    }
    if (first.size() > 1) look_for_alternatives(first, id);
  }

  void right_before(const std::vector<PropositionId>& any_of, LandmarkId id) {
    const LandmarkId before = add(any_of);
    if (before != id && std::ranges::count(found_[before].needed_by, id) == 0)
      found_[before].needed_by.push_back(id);
  }

  // Looks for facts of one predicate of which each of the operators needs one.
  void look_for_alternatives(const std::vector<SnapId>& first, LandmarkId id) {
    std::map<std::size_t, std::pair<std::vector<PropositionId>, std::size_t>> by_kind;  // and by how many
    for (const SnapId op : first) {
      std::vector<std::size_t> kinds;
      for (const PropositionId need : relaxed_.needs(op)) {
        auto& [needs, operators] = by_kind[kind(need)];
        if (std::ranges::count(needs, need) == 0) needs.push_back(need);
        if (std::ranges::count(kinds, kind(need)) == 0) ++operators;
        kinds.push_back(kind(need));
      }
    }
    for (auto& [unused, entry] : by_kind) {
      auto& [needs, operators] = entry;
      if (operators != first.size() || needs.size() < 2 || needs.size() > kMostAlternatives) continue;
      if (std::ranges::any_of(needs, [&](PropositionId p) { return initially_[p]; })) continue;
      std::ranges::sort(needs);
      right_before(needs, id);
    }
  }

  // Returns a number for the predicate of a fact, negated or not, or for the schema of a running action.
  std::size_t kind(PropositionId proposition) const {
    const std::size_t facts = task_.fact_names.size();
    if (proposition.index() < facts) {
      const FactName& name = task_.fact_names[FactId(proposition.index())];
      return 2 * name.predicate.index() + (name.negated ? 1 : 0);
    }
    return 2 * task_.predicates.size() + task_.actions[ActionId(proposition.index() - facts)].schema.index();
  }

  // Finds all that is within reach, and by what.
  void explore() {
    for (std::size_t i = 0; i < relaxed_.operators(); ++i)
      open_[SnapId(i)] = static_cast<std::uint32_t>(relaxed_.needs(SnapId(i)).size());
    const auto reach = [&](PropositionId proposition, SnapId by) {
      if (reached_[proposition]) return;
      reached_[proposition] = true;
      supporters_[proposition] = by;
      queue_.push_back(proposition);
    };
    const auto reach_from = [&](SnapId op) {
      for (const PropositionId added : relaxed_.adds(op)) reach(added, SnapId());
    };
    RelaxedTask::each_fact(task_, task_.initial_state,
                           [&](FactId fact) { reach(relaxed_.proposition(fact), SnapId()); });
    for (const TimedStep& timed : task_.timed_steps) reach_from(timed.snap);
    for (const SnapId op : relaxed_.free()) reach_from(op);
    visits_ = relaxed_.operators();
    while (!queue_.empty()) {
      const PropositionId proposition = queue_.back();
      queue_.pop_back();
      for (const SnapId op : relaxed_.needed_by(proposition)) {
        ++visits_;
        if (--open_[op] > 0) continue;
        for (const PropositionId added : relaxed_.adds(op)) reach(added, op);
      }
    }
  }

  // Finds what is within reach if some propositions do not exist: first all goes that hangs on them by its
  // supporters, then what of that has another supporter comes back. It counts as much as to explore
  // everything.
  void explore_without(std::span<const PropositionId> left_out) {
    limits_.poll();
    restore();
    visits_left_ -= std::min(visits_, visits_left_);
    for (const PropositionId proposition : left_out) {
      is_left_out_[proposition] = true;
      lose(proposition);
    }
    for (std::size_t i = 0; i < lost_.size(); ++i) {
      for (const SnapId op : relaxed_.needed_by(lost_[i])) {
        if (++open_[op] > 1) continue;
        for (const PropositionId added : relaxed_.adds(op)) {
          if (supporters_[added] == op) lose(added);
        }
      }
    }
    for (const PropositionId proposition : lost_) {
      if (std::ranges::any_of(relaxed_.added_by(proposition), [&](SnapId op) { return open_[op] == 0; }))
        find_again(proposition);
    }
    while (!queue_.empty()) {
      const PropositionId proposition = queue_.back();
      queue_.pop_back();
      for (const SnapId op : relaxed_.needed_by(proposition)) {
        if (--open_[op] > 0) continue;
        for (const PropositionId added : relaxed_.adds(op)) find_again(added);
      }
    }
    for (const PropositionId proposition : left_out) is_left_out_[proposition] = false;
  }

  // Makes all as it was after explore().
  void restore() {
    for (const PropositionId proposition : lost_) {
      if (reached_[proposition]) continue;
      reached_[proposition] = true;
      for (const SnapId op : relaxed_.needed_by(proposition)) --open_[op];
    }
    lost_.clear();
  }

  void lose(PropositionId proposition) {
    if (!reached_[proposition]) return;
    reached_[proposition] = false;
    lost_.push_back(proposition);
  }

  void find_again(PropositionId proposition) {
    if (reached_[proposition] || is_left_out_[proposition]) return;
    reached_[proposition] = true;
    queue_.push_back(proposition);
  }

  bool goal_reached() const {
    return std::ranges::any_of(task_.goals, [&](const Goal& goal) {
      return std::ranges::all_of(goal.facts,
                                 [&](FactId fact) { return reached_[relaxed_.proposition(fact)]; });
    });
  }

  void order() {
    LandmarkOrderings orders(task_, relaxed_, found_);
    for (std::size_t i = 0; i < found_.size(); ++i) {
      const LandmarkId before(i);
      const auto& reached = out_of_reach_[before];
      if (reached.empty()) continue;
      for (std::size_t j = 0; j < found_.size(); ++j) {
        const Landmark& other = found_[LandmarkId(j)];
        const bool later = !other.initially &&
                           std::ranges::none_of(other.any_of, [&](PropositionId p) { return reached[p]; });
        if (i != j && later) orders.add(before, LandmarkId(j));
      }
    }
    for (std::size_t i = 0; i < found_.size(); ++i) {
      for (const LandmarkId later : found_[LandmarkId(i)].needed_by) {
        if (!found_[later].initially) orders.add(LandmarkId(i), later);
      }
    }
    orders.add_reasonable();
    for (std::size_t i = 0; i < found_.size(); ++i)
      found_[LandmarkId(i)].after = orders.just_before(LandmarkId(i));
  }

  const Task& task_;
  const RelaxedTask& relaxed_;
  std::size_t visits_left_;
  const SearchLimits& limits_;
  IdVector<LandmarkId, Landmark> found_;
  std::map<std::vector<PropositionId>, LandmarkId> known_;
  std::size_t closed_ = 0;
  IdVector<LandmarkId, IdVector<PropositionId, bool>> out_of_reach_;  // reached without it; empty: not asked

  // These belong to the last exploration.
  IdVector<PropositionId, bool> reached_;
  IdVector<PropositionId, bool> initially_;
  IdVector<PropositionId, SnapId> supporters_;  // with nothing left out; none: holds, or is out of reach
  IdVector<PropositionId, bool> is_left_out_;
  IdVector<SnapId, std::uint32_t> open_;  // needs that were not reached; 0: could be taken
  std::vector<PropositionId> lost_;       // some of them found again
  std::vector<PropositionId> queue_;
  std::size_t visits_ = 0;  // of operators, to explore everything
};

}  // namespace

IdVector<LandmarkId, Landmark> find_landmarks(const Task& task, const RelaxedTask& relaxed,
                                              std::span<const SnapId> relaxed_plan, std::size_t max_visits,
                                              const SearchLimits& limits) {
  return Finder(task, relaxed, max_visits, limits).run(relaxed_plan);
}

}  // namespace roci::planner::temporal_pddl::heuristics
