#include "exec_svc/problem/pddl_problem.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>

#include "core/pddl/ast.hpp"
#include "core/pddl/printer.hpp"
#include "exec_svc/mission/goal_formula.hpp"
#include "exec_svc/mission/template_text.hpp"
#include "exec_svc/problem/problem_writer.hpp"
#include "exec_svc/problem/usable_parts.hpp"

namespace roci::exec::problem {

using goals::GoalRecord;
using goals::GoalRequest;
using mission::fill_names;
using mission::FluentSource;
using mission::GoalKind;
using mission::ObjectModel;
using mission::WindowModel;
using mission::words_of;

namespace {

using temporal::Time;

// Rounds to the six decimals of numbers in problems: a microsecond, a micrometre.
double rounded(double value) {
  const std::string text = number_text(value);
  double out = value;
  std::from_chars(text.data(), text.data() + text.size(), out);
  return out;
}

double seconds_of(Time time) { return rounded(static_cast<double>(time.count()) / 1e6); }

pddl::Atom atom_of(const std::string& fact) {
  pddl::Atom out;
  for (std::string& word : words_of(fact)) {
    if (out.symbol.empty()) {
      out.symbol = std::move(word);
    } else {
      out.arguments.push_back({std::move(word), {}});
    }
  }
  return out;
}

// Holds a fact that becomes true or false after the origin.
struct Change {
  Time at;  // from the origin
  std::string fact;
  bool holds;
};

// Holds the problem while it is put together.
class Draft {
 public:
  Draft(const Situation& situation, Reserves reserves) : situation_(situation), reserves_(reserves) {}

  void add_state() {
    for (const ObjectModel& object : situation_.mission.objects) {
      known_.insert_or_assign(object.name, object);
      if (!object.dynamic) declared_.insert(object.name);
    }
    facts_.insert(situation_.mission.facts.begin(), situation_.mission.facts.end());
    for (const std::string& fact : situation_.beliefs.component_facts()) {
      facts_.insert(fact);
      declare_words(fact);
    }
    facts_.merge(situation_.beliefs.family_facts());
    for (const WindowModel& window : situation_.mission.windows)
      for (const OpenInterval& interval : intervals_ahead(window, situation_))
        add_interval(window.fact, interval);
  }

  void foresee() {
    for (const auto& [fact, value] : situation_.forecast.values) {
      const bool* holds = std::get_if<bool>(&value);
      if (holds == nullptr) continue;
      if (*holds) {
        facts_.insert(fact);
        declare_words(fact);
      } else {
        facts_.erase(fact);
      }
    }
  }

  void add_goals() {
    for (const GoalRecord* record : situation_.goals.present()) {
      const GoalRequest& goal = record->request;
      const GoalKind& kind = situation_.mission.goal_kinds.at(goal.kind);
      const auto values = template_values(goal);
      for (ObjectModel& object : objects_of(situation_.mission, goal)) {
        if (!is_final(record->state)) declared_.insert(object.name);
        const std::string name = object.name;
        known_.insert_or_assign(name, std::move(object));
      }
      for (const std::string& fact : kind.facts) facts_.insert(fill_names(fact, values));
      if (!kind.window_fact.empty()) add_goal_window(fill_names(kind.window_fact, values), goal);
      if (is_final(record->state)) continue;
      for (const std::string& fact : kind.facts_while_open) facts_.insert(fill_names(fact, values));
      GoalPart part{goal.key, {}};
      for (const std::string& fact : goal_facts(situation_.mission, goal)) {
        if (kind.formula) {
          part.facts.push_back(mission::read_goal_formula(fact));
        } else {
          part.facts.push_back({atom_of(fact), {}});
        }
        declare_words(fact);
      }
      goals_.push_back(std::move(part));
    }
  }

  Problem finish(const std::string& name) const {
    Problem out;
    pddl::Problem tree = this->tree(name, out);
    if (situation_.mission.domain) keep_usable_parts(tree, goals_, *situation_.mission.domain, out);
    out.text = print(tree);
    return out;
  }

  /// Names in `out` the objects as their owners see them.
  pddl::Problem tree(const std::string& name, Problem& out) const {
    pddl::Problem tree;
    tree.name = name;
    tree.domain_name = situation_.mission.domain_name;
    for (const std::string& object_name : declared_) {
      const auto model = known_.find(object_name);
      if (model == known_.end()) continue;
      tree.objects.push_back({object_name, {model->second.type}, {}});
      out.objects.push_back(
          {object_name, model->second.type, properties_of(model->second, situation_.beliefs)});
    }
    for (const std::string& fact : facts_)
      if (is_declared(fact)) tree.facts.push_back(atom_of(fact));
    for (const FluentSource& source : situation_.mission.fluents) add_fluent(source, tree);
    for (const Change& change : changes_) {
      if (!is_declared(change.fact)) continue;
      tree.timed_literals.push_back({seconds_of(change.at), {atom_of(change.fact), !change.holds}, {}});
    }
    pddl::And goal;
    for (const GoalPart& part : goals_)
      goal.parts.insert(goal.parts.end(), part.facts.begin(), part.facts.end());
    tree.goal.node = std::move(goal);
    tree.metric = pddl::Metric{pddl::Metric::Sense::minimize, {pddl::TotalTime{}, {}}, {}};
    return tree;
  }

 private:
  void declare_words(const std::string& fact) {
    const auto words = words_of(fact);
    declared_.insert(words.begin() + 1, words.end());
  }

  // Returns whether all objects of the fact are declared. Objects that exist undeclared are those of
  // finished goals; a word that is no object of the mission is one of the domain's constants.
  bool is_declared(const std::string& fact) const {
    const auto words = words_of(fact);
    return std::all_of(words.begin(), words.end(), [&](const std::string& word) {
      return !known_.contains(word) || declared_.contains(word);
    });
  }

  void add_fluent(const FluentSource& source, pddl::Problem& tree) const {
    const auto value = situation_.beliefs.lookup(source.fluent);
    const double* number = value ? std::get_if<double>(&*value) : nullptr;
    if (reserves_ == Reserves::spent && source.last) number = &*source.last;
    if (number == nullptr) return;
    const auto& changes = situation_.forecast.changes;
    const auto change = changes.find(source.fluent);
    tree.values.push_back(
        {atom_of(source.fluent), rounded(*number + (change == changes.end() ? 0.0 : change->second))});
  }

  void add_interval(const std::string& fact, const OpenInterval& interval) {
    if (interval.to <= situation_.origin) return;
    add_begin(fact, interval.from);
    changes_.push_back({interval.to - situation_.origin, fact, false});
  }

  void add_begin(const std::string& fact, Time from) {
    if (from <= situation_.origin) {
      facts_.insert(fact);
    } else {
      changes_.push_back({from - situation_.origin, fact, true});
    }
  }

  void add_goal_window(const std::string& fact, const GoalRequest& goal) {
    if (goal.closes.count() != 0) {
      add_interval(fact, {goal.opens, goal.closes});
    } else {
      add_begin(fact, goal.opens);
    }
  }

  const Situation& situation_;
  Reserves reserves_;
  std::map<std::string, ObjectModel> known_;
  std::set<std::string> declared_;
  std::set<std::string> facts_;
  std::vector<Change> changes_;
  std::vector<GoalPart> goals_;
};

Draft draft_of(const Situation& situation, Reserves reserves) {
  Draft draft(situation, reserves);
  draft.add_state();
  draft.foresee();
  draft.add_goals();
  return draft;
}

}  // namespace

Problem write_pddl_problem(const Situation& situation, const std::string& name, Reserves reserves) {
  return draft_of(situation, reserves).finish(name);
}

pddl::Problem pddl_tree(const Situation& situation, Reserves reserves) {
  Problem ignored;
  return draft_of(situation, reserves).tree("now", ignored);
}

}  // namespace roci::exec::problem
