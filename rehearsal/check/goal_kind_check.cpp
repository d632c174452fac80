#include "rehearsal/check/goal_kind_check.hpp"

#include <algorithm>
#include <set>

#include "core/pddl/ast.hpp"
#include "exec_svc/mission/template_text.hpp"
#include "rehearsal/check/words.hpp"

namespace roci::rehearsal::check {

using mission::Entry;

namespace {

// Words that stand behind a parenthesis and name no predicate.
const std::set<std::string, std::less<>> kLogic{"and", "or", "not", "imply", "forall", "exists", "=", "<",
                                                ">",   "<=", ">=",  "+",     "-",      "*",      "/"};

// The first words of all parentheses of a formula: "(not (sent ?1))" → {"not", "sent"}.
std::vector<std::string> heads_of(const std::string& formula) {
  std::vector<std::string> out;
  for (std::size_t open = formula.find('('); open != std::string::npos; open = formula.find('(', open + 1)) {
    const std::size_t begin = formula.find_first_not_of(" \t\n", open + 1);
    if (begin == std::string::npos) break;
    out.push_back(formula.substr(begin, formula.find_first_of(" \t\n()", begin) - begin));
  }
  return out;
}

// Calls `read` with every single value below the entry.
void each_text(const Entry& entry, const std::function<void(const Entry&)>& read) {
  if (entry.is_mapping()) {
    entry.each_field([&](const std::string&, const Entry& value) { each_text(value, read); });
  } else if (entry.is_sequence()) {
    entry.each([&](const Entry& item) { each_text(item, read); });
  } else {
    read(entry);
  }
}

class GoalKindCheck {
 public:
  GoalKindCheck(const CheckedMission& mission, const CheckedExecutive& executive)
      : mission_(mission), executive_(executive), timelines_(mission, executive) {
    note_states("components");
    note_states("families");
    for (const std::string& fact : executive.model.facts) note(fact);
    if (const auto windows = executive.file.find("windows"); windows && windows->is_sequence())
      for (const Entry& window : windows->items())
        if (window.is_mapping())
          if (const auto fact = window.find("fact")) note(fact->text());
    if (!executive.model.domain) return;
    for (const auto& function : executive.model.domain->functions) elsewhere_.insert(function.name);
    for (const auto& derived : executive.model.domain->derived) elsewhere_.insert(derived.head.name);
    for (const auto& predicate : executive.model.domain->predicates) predicates_.insert(predicate.name);
  }

  void kind(const Entry& entry) const {
    std::vector<std::string> known{"id", "robot"};
    if (const auto arguments = entry.find("arguments"))
      for (const auto& [name, argument] : arguments->fields()) known.push_back(name);
    for (const char* key :
         {"objects", "facts", "facts_while_open", "unobserved", "window", "goal", "achieved"})
      if (const auto part = entry.find(key)) each_text(*part, [&](const Entry& text) { slots(text, known); });
    if (const auto unobserved = entry.find("unobserved"))
      unobserved->each(
          [&](const Entry& item) { timelines_.require(item.at("timeline"), item.at("timeline").text()); });
    const auto achieved = entry.find("achieved");
    if (achieved) condition(*achieved);
    if (const auto goal = entry.find("goal"); goal && !achieved) facts(*goal);
  }

 private:
  void note(const std::string& fact) {
    const auto words = exec::mission::words_of(fact);
    if (!words.empty()) given_.insert(words.front());
  }

  void note_states(const char* key) {
    const auto list = executive_.file.find(key);
    if (!list) return;
    list->each([&](const Entry& item) {
      item.at("states").each_field([&](const std::string&, const Entry& state) {
        if (const auto facts = state.find("facts"))
          for (const std::string& fact : facts->texts()) note(fact);
      });
    });
  }

  void slots(const Entry& entry, const std::vector<std::string>& known) const {
    for (const std::string& slot : slots_of(entry.text())) {
      if (contains(known, slot)) continue;
      entry.complain("{" + slot + "} stands here, and the goal kind has no such argument; " +
                     instead_of(slot, known));
    }
  }

  void condition(const Entry& entry) const {
    if (entry.is_sequence()) return entry.each([&](const Entry& part) { condition(part); });
    if (!entry.is_mapping()) return;
    for (const char* key : {"all", "any", "not"})
      if (const auto part = entry.find(key)) condition(*part);
    const auto timeline = entry.find("timeline");
    if (!timeline) return;
    timelines_.require(*timeline, timeline->text());
    const std::string name =
        exec::mission::fill_names(timeline->text(), {{"robot", executive_.model.role.robot}});
    for (const char* key : {"is", "is_not"}) {
      const auto value = entry.find(key);
      if (!value) continue;
      if (value->is_sequence() && value->items().empty()) continue;
      const Entry state = value->is_sequence() ? value->items().front() : *value;
      require_state(state, mission_.world, name, state.text());
    }
  }

  void facts(const Entry& goal) const {
    goal.each([&](const Entry& formula) {
      for (const std::string& head : heads_of(formula.text())) {
        if (kLogic.contains(head) || given_.contains(head) || elsewhere_.contains(head)) continue;
        if (!predicates_.contains(head)) continue;  // told by the reader
        formula.complain(
            "no state of a component or family stands for (" + head +
            " ...), so that the goal would never be seen as achieved; give the fact to a state, or say "
            "under 'achieved' what is to be observed");
      }
    });
  }

  const CheckedMission& mission_;
  const CheckedExecutive& executive_;
  KnownTimelines timelines_;
  std::set<std::string, std::less<>> given_;  // predicates that something observed stands for
  std::set<std::string, std::less<>>
      elsewhere_;  // functions and derived predicates, which follow from others
  std::set<std::string, std::less<>> predicates_;
};

}  // namespace

void check_goal_kinds(const CheckedMission& mission, const CheckedExecutive& executive) {
  const auto kinds = executive.file.find("goal_kinds");
  if (!kinds) return;
  const GoalKindCheck check(mission, executive);
  kinds->each_field([&](const std::string&, const Entry& kind) { check.kind(kind); });
}

}  // namespace roci::rehearsal::check
