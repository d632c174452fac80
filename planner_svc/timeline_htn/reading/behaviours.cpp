#include <algorithm>
#include <array>

#include "planner_svc/timeline_htn/model/bounds.hpp"
#include "planner_svc/timeline_htn/reading/sections.hpp"

namespace roci::planner::timeline_htn::reading {

using mission::Entry;
using model::Behaviour, model::Index, model::Pattern, model::Point, model::SubgoalConstraint, model::Variable;

namespace {

/// Reads one behaviour.
class BehaviourReader {
 public:
  BehaviourReader(const Entry& entry, Vocabulary& vocabulary, Behaviour& out)
      : entry_(entry), vocabulary_(vocabulary), out_(out) {}

  void read() {
    entry_.allow_only({"achieves", "triggers", "on_goal_change", "priority", "variables", "where",
                       "conditions", "subgoals", "constraints", "decisions"});
    read_head();
    out_.variables = scope_.variables;
    out_.where = vocabulary_.tests(entry_, scope_);
    if (const auto conditions = entry_.find("conditions"))
      for (const Entry& one : one_or_more(*conditions, model::kMostInList))
        one.attempt([&] { read_condition(one); });
    if (const auto subgoals = entry_.find("subgoals"))
      for (const auto& [name, value] : fields(*subgoals, model::kMostInList))
        value.attempt([&, &name = name, &value = value] { read_subgoal(name, value); });
    if (const auto constraints = entry_.find("constraints"))
      for (const Entry& one : one_or_more(*constraints, model::kMostInList))
        one.attempt([&] { read_constraint(one); });
    if (const auto decisions = entry_.find("decisions"))
      for (const auto& [name, value] : fields(*decisions, model::kMostInList))
        value.attempt([&, &name = name, &value = value] { read_decision(name, value); });
  }

 private:
  void read_head() {
    scope_.grows = true;
    if (const auto achieves = entry_.find("achieves")) {
      Line line(*achieves);
      const Pattern pattern = vocabulary_.pattern(line, scope_);
      line.expect_end();
      const model::Component& component = vocabulary_.model.components[pattern.component];
      const model::State& state = component.states[pattern.state];
      if (state.kind != model::StateKind::complex) {
        std::vector<std::string> complex;
        for (const model::State& one : component.states)
          if (one.kind == model::StateKind::complex) complex.push_back(one.name);
        achieves->fail("'" + component.name + "." + state.name + "' is " + to_text(state.kind) +
                       ", and a behaviour achieves a complex state; " +
                       (complex.empty() ? "name one" : known_or_declare(complex)));
      }
      out_.achieves = pattern;
    }
    if (const auto triggers = entry_.find("triggers"))
      for (const Entry& one : one_or_more(*triggers, model::kMostInList)) {
        Line line(one);
        out_.triggers.push_back(vocabulary_.pattern(line, scope_));
        line.expect_end();
      }
    scope_.grows = false;
    out_.on_goal_change = entry_.truth_or("on_goal_change", false);
    if (out_.on_goal_change && out_.achieves && !scope_.variables.empty())
      entry_.at("on_goal_change")
          .fail(
              "what it achieves has arguments, which no trigger binds; name a trigger, or leave 'achieves' "
              "out");
    if (const auto priority = entry_.find("priority")) {
      const std::int64_t number = priority->integer();
      if (number < -1'000'000 || number > 1'000'000)
        priority->fail("expected a whole number from -1000000 to 1000000");
      out_.priority = static_cast<std::int32_t>(number);
    }
    const auto variables = entry_.find("variables");
    if (!variables) return;
    for (const Variable& variable : vocabulary_.variables(*variables)) {
      if (std::ranges::find(scope_.variables, variable.name, &Variable::name) != scope_.variables.end())
        variables->fail("'" + variable.name + "' stands in 'achieves' or 'triggers' already; rename one");
      if (scope_.variables.size() >= model::kMostVariables)
        variables->fail("more than " + std::to_string(model::kMostVariables) + " variables; use fewer");
      scope_.variables.push_back(variable);
    }
  }

  void read_condition(const Entry& entry) {
    Line line(entry);
    model::Precondition condition;
    condition.negated = line.take_word("not");
    condition.state = vocabulary_.pattern(line, scope_);
    line.expect_end();
    out_.conditions.push_back(std::move(condition));
  }

  void read_subgoal(const std::string& name, const Entry& entry) {
    if (name == "self") entry.fail("'self' is the behaviour itself; rename the subgoal");
    names_.add(name, entry);
    model::Subgoal& subgoal = out_.subgoals.emplace_back();
    subgoal.name = name;
    Entry state = entry;
    if (entry.is_mapping()) {
      entry.allow_only({"state", "contingency"});
      state = entry.at("state");
      subgoal.contingency = entry.text_or("contingency", "");
    }
    Line line(state);
    subgoal.state = vocabulary_.pattern(line, scope_);
    line.expect_end();
  }

  std::optional<Index> subgoal(Line& line) {
    const std::string name = line.name();
    if (name == "self") return std::nullopt;
    const Index index = names_.index(name, line.entry());
    if (index >= out_.subgoals.size()) line.fail("subgoal '" + name + "' has a fault; mend that first");
    return index;
  }

  Point point(Line& line) {
    Point out{subgoal(line), false};
    line.expect(".");
    if (line.take_word("end")) {
      out.end = true;
    } else if (!line.take_word("start")) {
      line.fail("expected 'start' or 'end' before '" + line.rest() + "'");
    }
    return out;
  }

  // "[5, none]"
  void bounds(Line& line, SubgoalConstraint& out) {
    line.expect("[");
    out.lower.clear();
    if (!line.take_word("none")) out.lower = vocabulary_.expression(line, scope_);
    line.expect(",");
    out.upper.clear();
    if (!line.take_word("none")) out.upper = vocabulary_.expression(line, scope_);
    line.expect("]");
  }

  void add(Point from, Point to, bool not_before, bool not_after) {
    const model::Expression zero{{model::Operator::constant, 0, 0, {}}};
    out_.constraints.push_back(
        {from, to, not_before ? zero : model::Expression{}, not_after ? zero : model::Expression{}});
  }

  // "a.end to b.start [0, 60]", "a before b before c [0, 60]", "a meets b", "a during b", …
  void read_constraint(const Entry& entry) {
    Line line(entry);
    std::optional<Index> first = subgoal(line);
    if (line.take(".")) return read_points(line, first);
    bool related = false;
    for (;;) {
      if (line.take_word("before")) {
        const auto second = subgoal(line);
        add({first, true}, {second, false}, true, false);
        first = second;
      } else if (line.take_word("meets")) {
        const auto second = subgoal(line);
        add({first, true}, {second, false}, true, true);
        first = second;
      } else {
        break;
      }
      related = true;
    }
    if (related) {
      if (!line.ends()) bounds(line, out_.constraints.back());
      return line.expect_end();
    }
    static constexpr std::array words{"starts", "ends", "equals", "during", "contains"};
    const auto found = std::ranges::find_if(words, [&](const char* word) { return line.take_word(word); });
    if (found == words.end())
      line.fail(
          "expected one of before, meets, starts, ends, equals, during, contains, or '.start' or '.end'" +
          (line.ends() ? std::string() : ", not '" + line.rest() + "'"));
    const auto second = subgoal(line);
    line.expect_end();
    const std::string_view word = *found;
    if (word == "starts" || word == "equals") add({first, false}, {second, false}, true, true);
    if (word == "ends" || word == "equals") add({first, true}, {second, true}, true, true);
    const bool inside = word == "during";
    if (!inside && word != "contains") return;
    const auto inner = inside ? first : second, outer = inside ? second : first;
    add({outer, false}, {inner, false}, true, false);
    add({inner, true}, {outer, true}, true, false);
  }

  void read_points(Line& line, std::optional<Index> first) {
    SubgoalConstraint out;
    out.from.subgoal = first;
    if (line.take_word("end")) {
      out.from.end = true;
    } else if (!line.take_word("start")) {
      line.fail("expected 'start' or 'end' before '" + line.rest() + "'");
    }
    if (!line.take_word("to")) line.expect("to");
    out.to = point(line);
    bounds(line, out);
    line.expect_end();
    out_.constraints.push_back(std::move(out));
  }

  void read_decision(const std::string& name, const Entry& entry) {
    entry.allow_only({"resolver", "asks", "before", "choices", "binds", "over", "subgoals"});
    decisions_.add(name, entry);
    model::Decision decision;
    decision.name = name;
    const Entry resolver = entry.at("resolver");
    static const std::vector<std::pair<std::string, temporal::ResolverKind>> kinds{
        {"engine", temporal::ResolverKind::engine},
        {"ground", temporal::ResolverKind::ground},
        {"rule", temporal::ResolverKind::rule}};
    const auto kind = std::ranges::find(kinds, resolver.text(), [](const auto& one) { return one.first; });
    if (kind == kinds.end())
      resolver.fail("expected one of engine, ground, rule, not '" + resolver.text() + "'");
    decision.resolver_kind = kind->second;
    decision.resolver = entry.text_or("asks", "");
    Line before(entry.at("before"));
    decision.before = point(before);
    before.expect_end();
    const auto choices = entry.find("choices"), binds = entry.find("binds"), over = entry.find("over");
    if (choices.has_value() + binds.has_value() + over.has_value() != 1)
      entry.fail(
          "a decision has either 'choices', a variable that it 'binds', or one that it is 'over'; write one "
          "of "
          "them");
    if (!over && entry.find("subgoals"))
      entry.at("subgoals").fail("subgoals stand here of a decision 'over' a variable alone; take them out");
    if (const auto& of = binds ? binds : over) {
      const auto variable = std::ranges::find(scope_.variables, of->text(), &Variable::name);
      if (variable == scope_.variables.end())
        of->fail("'" + of->text() + "' is no variable of the behaviour; declare it under 'variables'");
      if (decision.resolver_kind == temporal::ResolverKind::rule)
        resolver.fail(
            "a rule picks among choices that are named; let ground or engine decide on the variable");
      decision.variable = static_cast<Index>(variable - scope_.variables.begin());
      decision.over = over.has_value();
      if (over) decision.subgoals = subgoals_of(entry);
      if (binds) refuse_property_of(*decision.variable, *binds);
    } else {
      for (const auto& [choice, value] : fields(*choices, model::kMostInList))
        decision.choices.push_back(read_choice(choice, value));
      if (decision.choices.size() < 2) choices->fail("there is nothing to decide; name two choices or more");
    }
    out_.decisions.push_back(std::move(decision));
  }

  // An answer binds names of objects alone.
  void refuse_property_of(Index variable, const Entry& binds) const {
    for (const model::Subgoal& subgoal : out_.subgoals) {
      const model::State& state =
          vocabulary_.model.components[subgoal.state.component].states[subgoal.state.state];
      if (!state.command) continue;
      for (const model::Argument& argument : state.command->arguments)
        if (argument.term && !argument.property.empty() &&
            subgoal.state.terms[argument.term->index] == model::Term{variable, false})
          binds.fail("'" + argument.text + "' of the command " + state.command->name +
                     " is a property of what stays open; let the command have the object itself");
    }
  }

  std::vector<Index> subgoals_of(const Entry& entry) {
    std::vector<Index> out;
    for (const Entry& one : one_or_more(entry.at("subgoals"), model::kMostInList)) {
      out.push_back(names_.index(one.text(), one));
      if (out.back() >= out_.subgoals.size())
        one.fail("subgoal '" + one.text() + "' has a fault; mend that first");
    }
    return out;
  }

  model::Choice read_choice(const std::string& name, const Entry& entry) {
    entry.allow_only({"subgoals", "when", "instead"});
    model::Choice out;
    out.name = name;
    out.subgoals = subgoals_of(entry);
    out.instead = entry.truth_or("instead", false);
    const auto when = entry.find("when");
    if (!when) return out;
    std::vector<temporal::Condition> parts;
    for (const Entry& one : one_or_more(*when, model::kMostInList)) parts.push_back(comparison(one));
    out.rule = parts.size() == 1 ? parts.front() : temporal::all_of(parts);
    return out;
  }

  // "scout.nav = no_path", "battery >= 500"
  static temporal::Condition comparison(const Entry& entry) {
    static constexpr std::pair<const char*, temporal::ConditionOp> ops[] = {
        {"<=", temporal::ConditionOp::le}, {">=", temporal::ConditionOp::ge},
        {"!=", temporal::ConditionOp::ne}, {"=", temporal::ConditionOp::eq},
        {"<", temporal::ConditionOp::lt},  {">", temporal::ConditionOp::gt}};
    Line line(entry);
    std::string timeline = line.name();
    while (line.take(".")) timeline += "." + line.name();
    for (const auto& [symbol, op] : ops) {
      if (!line.take(symbol)) continue;
      temporal::Value value;
      if (line.take_word("true")) {
        value = true;
      } else if (line.take_word("false")) {
        value = false;
      } else if (line.at_name()) {
        Application state = line.application();
        value = temporal::State{std::move(state.name), std::move(state.arguments)};
      } else if (const auto number = line.number()) {
        value = *number;
      } else {
        line.fail("expected a state, true, false or a number before '" + line.rest() + "'");
      }
      line.expect_end();
      const bool order = op != temporal::ConditionOp::eq && op != temporal::ConditionOp::ne;
      if (order && !std::holds_alternative<double>(value))
        entry.fail("only numbers are greater or less; write '='");
      return temporal::compare(timeline, op, std::move(value));
    }
    line.fail("expected a comparison: one of =, !=, <, <=, >, >=");
  }

  const Entry& entry_;
  Vocabulary& vocabulary_;
  Behaviour& out_;
  Scope scope_;
  Names names_{"subgoal"};
  Names decisions_{"decision"};
};

}  // namespace

void read_behaviours(const Entry& section, Vocabulary& vocabulary, Places& places) {
  section.each_field([&](const std::string& name, const Entry& entry) {
    if (vocabulary.behaviours.size() >= model::kMostBehaviours)
      entry.fail("more than " + std::to_string(model::kMostBehaviours) +
                 " behaviours; make the model smaller");
    vocabulary.behaviours.add(name, entry);
    Behaviour behaviour;
    behaviour.name = name;
    BehaviourReader(entry, vocabulary, behaviour).read();
    places[{model::Part::behaviour, static_cast<Index>(vocabulary.model.behaviours.size()), 0}] =
        entry.place();
    vocabulary.model.behaviours.push_back(std::move(behaviour));
  });
}

}  // namespace roci::planner::timeline_htn::reading
