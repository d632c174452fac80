#include "planner_svc/temporal_pddl/grounding/invariants/mutex_groups.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <span>

#include "planner_svc/temporal_pddl/grounding/simplification/relaxed_pruning.hpp"

namespace roci::planner::temporal_pddl::grounding::invariants {

using call::SearchLimits;
using instantiation::GroundAction;
using instantiation::GroundEffects;
using instantiation::GroundModel;
using simplification::literal_index;
using task::ObjectId;

namespace {

constexpr std::size_t kMaxCandidates = 300;
constexpr std::size_t kMaxArity = 4;  // of predicates that start a candidate

using Key = std::vector<ObjectId>;

// Symbols number the predicates first, then "running" of each schema.
struct Part {
  std::uint32_t symbol = 0;
  std::vector<std::uint32_t> key_positions;  // one per element of the key
  auto operator<=>(const Part&) const = default;
};

using Candidate = std::vector<Part>;  // sorted, one part per symbol

// Is an atom or a running action.
struct Member {
  std::uint32_t symbol = 0;
  std::uint32_t id = 0;  // atom or action
  std::span<const ObjectId> objects;
  bool same(const Member& other) const { return symbol == other.symbol && id == other.id; }
};

struct SnapView {
  std::vector<Member> needs, adds, deletes;
};

class Synthesis {
 public:
  Synthesis(const GroundModel& model, const std::vector<bool>& reached, std::size_t predicates,
            std::size_t schemas, SearchLimits& limits)
      : model_(model),
        reached_(reached),
        predicates_(predicates),
        adders_(predicates + schemas),
        limits_(limits) {
    for (std::size_t i = 0; i < model.actions.size(); ++i) {
      add_snap(i, false);
      if (model.actions[i].durative) add_snap(i, true);
    }
    for (const auto& timed : model.timed) {
      for (const std::uint32_t atom : timed.effects.adds) timed_adds_.insert(model.atoms.symbol(atom));
    }
  }

  std::vector<MutexGroup> run() {
    seed();
    std::vector<MutexGroup> result;
    for (std::size_t tried = 0; !queue_.empty() && tried < kMaxCandidates; ++tried) {
      const Candidate candidate = std::move(queue_.front());
      queue_.pop_front();
      if (is_balanced(candidate)) collect_groups(candidate, result);
    }
    return result;
  }

 private:
  Member atom(std::uint32_t id) const { return {model_.atoms.symbol(id), id, model_.atoms.objects(id)}; }
  Member running(std::size_t action) const {
    const GroundAction& a = model_.actions[action];
    return {static_cast<std::uint32_t>(predicates_ + a.schema.index()), static_cast<std::uint32_t>(action),
            a.arguments};
  }

  void add_snap(std::size_t action, bool end) {
    look_at(2 * action + end);
    for (const auto& member : view_.adds) {
      auto& list = adders_[member.symbol];
      if (list.empty() || list.back() != 2 * action + end) list.push_back(2 * action + end);
    }
  }

  // Fills view_ with what the snap action needs, adds and deletes.
  void look_at(std::size_t snap) {
    const GroundAction& action = model_.actions[snap / 2];
    const bool end = snap % 2 == 1;
    const GroundEffects& effects = end ? action.end_effects : action.start_effects;
    for (auto* members : {&view_.needs, &view_.adds, &view_.deletes}) members->clear();
    for (const auto literal : end ? action.at_end.literals : action.at_start.literals) {
      if (!literal.negated) view_.needs.push_back(atom(literal.atom));
    }
    for (const auto literal : action.over_all.literals) {
      const bool own = !end && std::ranges::binary_search(effects.adds, literal.atom);
      if (!literal.negated && !own) view_.needs.push_back(atom(literal.atom));
    }
    for (const std::uint32_t id : effects.adds) view_.adds.push_back(atom(id));
    for (const std::uint32_t id : effects.deletes) view_.deletes.push_back(atom(id));
    if (end) {
      view_.needs.push_back(running(snap / 2));
      view_.deletes.push_back(running(snap / 2));
    } else if (action.durative) {
      view_.adds.push_back(running(snap / 2));
    }
  }

  // Queues every predicate that effects change, with every subset of its positions as key; larger sets of
  // atoms come first.
  void seed() {
    std::map<std::uint32_t, std::size_t> arities;
    for (std::uint32_t id = 0; id < model_.atoms.size(); ++id) {
      if (model_.derived[id]) continue;
      if (reached_[literal_index({id, true})] && reached_[literal_index({id, false})]) {
        arities[model_.atoms.symbol(id)] = model_.atoms.objects(id).size();
      }
    }
    for (std::size_t keys = 0; keys <= kMaxArity; ++keys) {
      for (const auto& [symbol, arity] : arities) {
        if (arity > kMaxArity) continue;
        for (std::uint32_t mask = 0; mask < (1u << arity); ++mask) {
          Part part{symbol, {}};
          for (std::uint32_t i = 0; i < arity; ++i) {
            if (mask >> i & 1) part.key_positions.push_back(i);
          }
          if (part.key_positions.size() == keys) push({part});
        }
      }
    }
  }

  void push(Candidate candidate) {
    std::ranges::sort(candidate);
    if (seen_.insert(candidate).second) queue_.push_back(std::move(candidate));
  }

  static const Part* part_of(const Candidate& candidate, std::uint32_t symbol) {
    for (const auto& part : candidate) {
      if (part.symbol == symbol) return &part;
    }
    return nullptr;
  }

  static std::optional<Key> key_of(const Candidate& candidate, const Member& member) {
    const Part* part = part_of(candidate, member.symbol);
    if (!part) return std::nullopt;
    Key key;
    for (const std::uint32_t position : part->key_positions) key.push_back(member.objects[position]);
    return key;
  }

  // Checks all adders, and queues refinements of a candidate that one of them breaks.
  bool is_balanced(const Candidate& candidate) {
    for (const auto& part : candidate) {
      if (timed_adds_.contains(part.symbol)) return false;
    }
    for (const auto& part : candidate) {
      for (const std::size_t snap : adders_[part.symbol]) {
        limits_.step();
        look_at(snap);
        for (const auto& added : view_.adds) {
          if (added.symbol != part.symbol || balanced(candidate, added, view_)) continue;
          return false;
        }
      }
    }
    return true;
  }

  bool balanced(const Candidate& candidate, const Member& added, const SnapView& snap) {
    const Key key = *key_of(candidate, added);
    const auto needed = [&](const Member& member) {
      return std::ranges::any_of(snap.needs, [&](const Member& need) { return need.same(member); });
    };
    for (const auto& other : snap.adds) {
      if (!other.same(added) && key_of(candidate, other) == key) return false;  // too heavy
    }
    if (needed(added)) return true;
    for (const auto& taken : snap.deletes) {
      if (needed(taken) && key_of(candidate, taken) == key) return true;
    }
    for (const auto& taken : snap.deletes) {
      if (needed(taken) && !part_of(candidate, taken.symbol)) refine(candidate, key, taken);
    }
    return false;
  }

  // Queues the candidates with one more part, under which `taken` has this key.
  void refine(const Candidate& candidate, const Key& key, const Member& taken) {
    std::vector<std::vector<std::uint32_t>> choices{{}};
    for (const ObjectId object : key) {
      std::vector<std::vector<std::uint32_t>> longer;
      for (const auto& choice : choices) {
        for (std::uint32_t i = 0; i < taken.objects.size(); ++i) {
          if (taken.objects[i] != object || std::ranges::count(choice, i) > 0) continue;
          longer.push_back(choice);
          longer.back().push_back(i);
        }
      }
      choices = std::move(longer);
    }
    for (auto& choice : choices) {
      Candidate refined = candidate;
      refined.push_back({taken.symbol, std::move(choice)});
      push(std::move(refined));
    }
  }

  // Appends the groups of which at most one atom holds at first.
  void collect_groups(const Candidate& candidate, std::vector<MutexGroup>& result) const {
    std::map<Key, std::size_t> initially;
    for (const std::uint32_t id : model_.initial_atoms) {
      if (const auto key = key_of(candidate, atom(id))) ++initially[*key];
    }
    std::map<Key, MutexGroup> groups;
    for (std::uint32_t id = 0; id < model_.atoms.size(); ++id) {
      if (!reached_[literal_index({id, false})]) continue;
      if (const auto key = key_of(candidate, atom(id))) groups[*key].atoms.push_back(id);
    }
    for (std::uint32_t action = 0; action < model_.actions.size(); ++action) {
      if (const auto key = key_of(candidate, running(action))) groups[*key].running.push_back(action);
    }
    for (auto& [key, group] : groups) {
      const auto weight = initially.find(key);
      const bool exclusive = weight == initially.end() || weight->second <= 1;
      if (exclusive && group.atoms.size() + group.running.size() > 1) result.push_back(std::move(group));
    }
  }

  const GroundModel& model_;
  const std::vector<bool>& reached_;
  std::size_t predicates_;
  std::vector<std::vector<std::size_t>> adders_;  // by symbol: snaps, 2 · action + (end ? 1 : 0)
  std::set<std::uint32_t> timed_adds_;
  std::deque<Candidate> queue_;
  std::set<Candidate> seen_;
  SnapView view_;  // of the snap action at hand
  SearchLimits& limits_;
};

}  // namespace

std::vector<MutexGroup> find_mutex_groups(const GroundModel& model, const std::vector<bool>& reached,
                                          std::size_t predicates, std::size_t schemas, SearchLimits& limits) {
  return Synthesis(model, reached, predicates, schemas, limits).run();
}

}  // namespace roci::planner::temporal_pddl::grounding::invariants
