#include "exec_svc/problem/problem_writer.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <set>

#include "exec_svc/mission/template_text.hpp"

namespace roci::exec::problem {

using beliefs::Beliefs;
using goals::GoalRecord;
using goals::GoalRequest;
using goals::GoalSet;
using mission::fill_names;
using mission::FluentSource;
using mission::GoalKind;
using mission::MissionModel;
using mission::ObjectModel;
using mission::PropertySource;
using mission::WindowModel;
using mission::words_of;

namespace {

using temporal::Time;

std::string number_text(double value) {
  std::array<char, 32> buffer{};
  const auto result =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, 6);
  return std::string(buffer.data(), result.ptr);
}

std::string seconds_text(Time time) { return number_text(static_cast<double>(time.count()) / 1e6); }

// The problem while it is put together.
class Draft {
 public:
  Draft(const MissionModel& mission, const Beliefs& beliefs, Time now, Time origin, Reserves reserves)
      : mission_(mission), beliefs_(beliefs), now_(now), origin_(origin), reserves_(reserves) {}

  void foresee(const Forecast& forecast) {
    for (const auto& [fact, holds] : forecast.facts) {
      if (holds) {
        facts_.insert(fact);
        declare_words(fact);
      } else {
        facts_.erase(fact);
      }
    }
    changes_ = forecast.changes;
  }

  void add_goals(const GoalSet& goals) {
    for (const GoalRecord* record : goals.present()) {
      const GoalRequest& goal = record->request;
      const GoalKind& kind = mission_.goal_kinds.at(goal.kind);
      const auto values = template_values(goal);
      for (ObjectModel object : kind.objects) {
        object.name = fill_names(object.name, values);
        for (PropertySource& property : object.properties) property.text = fill_names(property.text, values);
        known_.insert_or_assign(object.name, object);
        if (!is_final(record->state)) declared_.insert(object.name);
      }
      for (const std::string& fact : kind.facts) facts_.insert(fill_names(fact, values));
      if (!kind.window_fact.empty()) add_goal_window(fill_names(kind.window_fact, values), goal);
      if (is_final(record->state)) continue;
      for (const std::string& fact : goal_facts(mission_, goal)) {
        goal_.push_back(fact);
        declare_words(fact);
      }
    }
  }

  void add_state() {
    for (const ObjectModel& object : mission_.objects) {
      known_.insert_or_assign(object.name, object);
      if (!object.dynamic) declared_.insert(object.name);
    }
    for (const std::string& fact : beliefs_.component_facts()) {
      facts_.insert(fact);
      declare_words(fact);
    }
    facts_.merge(beliefs_.family_facts());
    for (const WindowModel& window : mission_.windows) add_window(window);
  }

  Problem finish(const std::string& name) {
    Problem out;
    out.text = "(define (problem " + name + ")\n  (:domain " + mission_.domain_name + ")\n  (:objects\n";
    for (const std::string& object_name : declared_) {
      const auto model = known_.find(object_name);
      if (model == known_.end()) continue;
      out.text += "    " + object_name + " - " + model->second.type + "\n";
      out.objects.push_back({object_name, model->second.type, properties_of(model->second)});
    }
    out.text += "  )\n  (:init\n";
    for (const std::string& fact : facts_) {
      if (is_declared(fact)) out.text += "    " + fact + "\n";
    }
    for (const FluentSource& source : mission_.fluents) {
      const auto value = beliefs_.lookup(source.fluent);
      const double* number = value ? std::get_if<double>(&*value) : nullptr;
      if (reserves_ == Reserves::spent && source.last) number = &*source.last;
      if (number == nullptr) continue;
      const auto change = changes_.find(source.fluent);
      const double then = *number + (change == changes_.end() ? 0.0 : change->second);
      out.text += "    (= " + source.fluent + " " + number_text(then) + ")\n";
    }
    for (const auto& [time, literal] : timed_) {
      if (is_declared(literal)) out.text += "    (at " + seconds_text(time) + " " + literal + ")\n";
    }
    out.text += "  )\n  (:goal (and\n";
    for (const std::string& fact : goal_) out.text += "    " + fact + "\n";
    out.text += "  ))\n  (:metric minimize (total-time))\n)\n";
    return out;
  }

 private:
  void declare_words(const std::string& fact) {
    const auto words = words_of(fact);
    declared_.insert(words.begin() + 1, words.end());
  }

  // Objects that exist but are not declared (those of finished goals) take their facts with them; a word that
  // is no object of the mission is one of the domain's constants.
  bool is_declared(const std::string& literal) const {
    const auto words = words_of(literal);
    return std::all_of(words.begin(), words.end(), [&](const std::string& word) {
      return !known_.contains(word) || declared_.contains(word);
    });
  }

  void add_interval(const std::string& fact, Time from, Time to) {
    if (to <= origin_) return;
    if (from <= origin_) {
      facts_.insert(fact);
    } else {
      timed_.emplace_back(from - origin_, fact);
    }
    timed_.emplace_back(to - origin_, "(not " + fact + ")");
  }

  void add_window(const WindowModel& window) {
    const temporal::Value* observed = beliefs_.value(window.timeline);
    const bool seen_closed = observed != nullptr && *observed == temporal::Value(false);
    for (const auto& [from, to] : window.open) {
      if (from < now_ && seen_closed) continue;  // should be open, and is not
      add_interval(window.fact, from, to);
    }
  }

  void add_goal_window(const std::string& fact, const GoalRequest& goal) {
    const bool has_end = goal.closes.count() != 0;
    if (has_end) {
      add_interval(fact, goal.opens, goal.closes);
    } else if (goal.opens <= origin_) {
      facts_.insert(fact);
    } else {
      timed_.emplace_back(goal.opens - origin_, fact);
    }
  }

  std::vector<temporal::Property> properties_of(const ObjectModel& object) const {
    std::vector<temporal::Property> out;
    for (const PropertySource& property : object.properties) {
      if (!property.timeline) {
        out.push_back({property.name, property.text});
      } else if (const temporal::Value* observed = beliefs_.value(*property.timeline)) {
        const double* number = std::get_if<double>(observed);
        if (number != nullptr) out.push_back({property.name, number_text(*number)});
      }
    }
    return out;
  }

  const MissionModel& mission_;
  const Beliefs& beliefs_;
  Time now_;
  Time origin_;
  Reserves reserves_;
  std::map<std::string, ObjectModel> known_;
  std::set<std::string> declared_;
  std::set<std::string> facts_;
  std::vector<std::pair<Time, std::string>> timed_;
  std::vector<std::string> goal_;
  std::map<std::string, double> changes_;
};

}  // namespace

std::vector<std::string> goal_facts(const MissionModel& mission, const GoalRequest& goal) {
  std::vector<std::string> out;
  const auto kind = mission.goal_kinds.find(goal.kind);
  if (kind == mission.goal_kinds.end()) return out;
  for (const std::string& fact : kind->second.goal) out.push_back(fill_names(fact, template_values(goal)));
  return out;
}

Problem write_problem(const MissionModel& mission, const Beliefs& beliefs, const GoalSet& goals,
                      const std::string& name, Time now, Time origin, Reserves reserves,
                      const Forecast& forecast) {
  Draft draft(mission, beliefs, now, origin, reserves);
  draft.add_state();
  draft.foresee(forecast);
  draft.add_goals(goals);
  return draft.finish(name);
}

}  // namespace roci::exec::problem
