#include "planner_svc/timeline_htn/reading/vocabulary.hpp"

#include <algorithm>

#include "core/words/nearest_word.hpp"
#include "planner_svc/timeline_htn/model/bounds.hpp"

namespace roci::planner::timeline_htn::reading {

using mission::Entry;
using model::Expression, model::Index, model::Operator, model::Pattern, model::Term, model::Test,
    model::Variable;

namespace {

void too_many(const Entry& entry, std::size_t count, std::size_t most) {
  if (count > most)
    entry.fail(std::to_string(count) + " entries do not fit: at most " + std::to_string(most) +
               " are permitted here; make the model smaller");
}

}  // namespace

std::vector<Entry> one_or_more(const Entry& entry, std::size_t most) {
  return entry.is_sequence() ? items(entry, most) : std::vector<Entry>{entry};
}

std::vector<Entry> items(const Entry& list, std::size_t most) {
  auto out = list.items();
  too_many(list, out.size(), most);
  return out;
}

std::vector<std::pair<std::string, Entry>> fields(const Entry& mapping, std::size_t most) {
  auto out = mapping.fields();
  too_many(mapping, out.size(), most);
  return out;
}

Index Vocabulary::type(const std::string& name, const Entry& place) const {
  Index out = kUnknownType;
  place.attempt([&] { out = types.index(name, place); });
  return out;
}

Term Vocabulary::term(const std::string& name, Index type, Scope& scope, const Entry& place) const {
  const auto wrong_type = [&](Index found) {
    if (!may_be_same(found, type))
      place.fail("'" + name + "' is of type " + model.types[found] + ", and a " + model.types[type] +
                 " is wanted; name another one");
  };
  const auto variable = std::ranges::find(scope.variables, name, &Variable::name);
  if (variable != scope.variables.end()) {
    wrong_type(variable->type);
    return {static_cast<Index>(variable - scope.variables.begin()), false};
  }
  if (const auto object = objects.find(name)) {
    wrong_type(model.objects[*object].type);
    return {*object, true};
  }
  if (!scope.grows) {
    std::vector<std::string> known;
    for (const Variable& one : scope.variables) known.push_back(one.name);
    for (const model::Object& one : model.objects)
      if (may_be_same(one.type, type)) known.push_back(one.name);
    place.fail("'" + name + "' is no variable here and no " +
               (type == kUnknownType ? "object" : model.types[type]) + "; " +
               words::nearest(name, known).remedy(known_or_declare(known)));
  }
  if (scope.variables.size() >= model::kMostVariables)
    place.fail("more than " + std::to_string(model::kMostVariables) + " variables; use fewer");
  scope.variables.push_back({name, type});
  return {static_cast<Index>(scope.variables.size() - 1), false};
}

std::vector<Term> Vocabulary::terms(const Application& application, const std::vector<Index>& wanted,
                                    Scope& scope, const Entry& place) const {
  if (application.arguments.size() != wanted.size())
    place.fail("'" + application.name + "' has " + std::to_string(wanted.size()) + " arguments, not " +
               std::to_string(application.arguments.size()) + "; write as many");
  std::vector<Term> out;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    out.push_back(term(application.arguments[i], wanted[i], scope, place));
  return out;
}

Pattern Vocabulary::pattern(Line& line, Scope& scope) const {
  const std::string component = line.name();
  const Index index = components.index(component, line.entry());
  line.expect(".");
  return pattern_of(index, line, scope);
}

Pattern Vocabulary::pattern_of(Index component, Line& line, Scope& scope) const {
  const Application application = line.application();
  Pattern out{component, states[component].index(application.name, line.entry()), {}};
  std::vector<Index> wanted;
  for (const Variable& parameter : model.components[component].states[out.state].parameters)
    wanted.push_back(parameter.type);
  out.terms = terms(application, wanted, scope, line.entry());
  return out;
}

void Vocabulary::factor(Line& line, Scope& scope, Expression& out) const {
  if (line.take("(")) {
    const Expression inner = sum(line, scope);
    out.insert(out.end(), inner.begin(), inner.end());
    return line.expect(")");
  }
  if (const auto number = line.number()) {
    out.push_back({Operator::constant, *number, 0, {}});
    return;
  }
  const Application table = line.application();
  const Index index = numbers.index(table.name, line.entry());
  out.push_back({Operator::table, 0, index, terms(table, model.numbers[index].types, scope, line.entry())});
}

void Vocabulary::product(Line& line, Scope& scope, Expression& out) const {
  factor(line, scope, out);
  for (;;) {
    const bool times = line.take("*");
    if (!times && !line.take("/")) return;
    factor(line, scope, out);
    if (!times && out.back().op == Operator::constant && out.back().constant == 0)
      line.fail("nothing can be divided by 0; mend the number");
    out.push_back({times ? Operator::multiply : Operator::divide, 0, 0, {}});
  }
}

Expression Vocabulary::sum(Line& line, Scope& scope) const {
  Expression out;
  if (line.take("-")) {
    out.push_back({Operator::constant, 0, 0, {}});
    product(line, scope, out);
    out.push_back({Operator::subtract, 0, 0, {}});
  } else {
    product(line, scope, out);
  }
  for (;;) {
    const bool plus = line.take("+");
    if (!plus && !line.take("-")) break;
    product(line, scope, out);
    out.push_back({plus ? Operator::add : Operator::subtract, 0, 0, {}});
  }
  if (out.size() > model::kLongestExpression) line.fail("the expression is too long; put it into a table");
  return out;
}

Expression Vocabulary::expression(Line& line, Scope& scope) const { return sum(line, scope); }

Expression Vocabulary::bound(const Entry& entry, Scope& scope) const {
  Line line(entry);
  Expression out;
  if (!line.take_word("none")) out = sum(line, scope);
  line.expect_end();
  return out;
}

Test Vocabulary::test(Line& line, Scope& scope) const {
  static constexpr std::pair<const char*, model::Comparison> comparisons[] = {
      {"<=", model::Comparison::le}, {">=", model::Comparison::ge}, {"!=", model::Comparison::ne},
      {"=", model::Comparison::eq},  {"<", model::Comparison::lt},  {">", model::Comparison::gt}};
  const auto comparison = [&] {
    for (const auto& [symbol, one] : comparisons)
      if (line.take(symbol)) return one;
    line.fail("expected a comparison before '" + line.rest() + "': one of =, !=, <, <=, >, >=");
  };
  Test out;
  out.negated = line.take_word("not");
  if (line.at_name()) {
    Line probe = line;
    const Application first = probe.application();
    if (const auto relation = relations.find(first.name); relation && !first.arguments.empty()) {
      line = probe;
      out.relation = *relation;
      out.terms = terms(first, model.relations[*relation].types, scope, line.entry());
      return out;
    }
    if (out.negated) line.fail("'not' stands before a relation alone; write '!=' between two names");
    const auto variable = std::ranges::find(scope.variables, first.name, &Variable::name);
    const auto object = objects.find(first.name);
    if (first.arguments.empty() && (variable != scope.variables.end() || object)) {
      line = probe;
      const Index type = variable != scope.variables.end() ? variable->type : model.objects[*object].type;
      out.kind = Test::Kind::terms;
      out.comparison = comparison();
      if (out.comparison != model::Comparison::eq && out.comparison != model::Comparison::ne)
        line.fail("objects are equal or not; write '=' or '!='");
      out.terms = {term(first.name, type, scope, line.entry()), term(line.name(), type, scope, line.entry())};
      return out;
    }
    if (!numbers.find(first.name)) {
      std::vector<std::string> known;
      for (const auto& one : model.relations) known.push_back(one.name);
      for (const auto& one : model.numbers) known.push_back(one.name);
      for (const auto& one : scope.variables) known.push_back(one.name);
      line.fail("'" + first.name + "' is no relation, number, variable or object here; " +
                words::nearest(first.name, known).remedy(known_or_declare(known)));
    }
  }
  out.kind = Test::Kind::numbers;
  out.left = sum(line, scope);
  out.comparison = comparison();
  out.right = sum(line, scope);
  return out;
}

std::vector<Test> Vocabulary::tests(const Entry& mapping, Scope& scope) const {
  std::vector<Test> out;
  const auto where = mapping.find("where");
  if (!where) return out;
  for (const Entry& one : one_or_more(*where, model::kMostInList)) {
    one.attempt([&] {
      Line line(one);
      out.push_back(test(line, scope));
      line.expect_end();
    });
  }
  return out;
}

std::vector<Variable> Vocabulary::variables(const Entry& mapping) const {
  std::vector<Variable> out;
  Names names("variable");
  for (const auto& [name, type] : fields(mapping, model::kMostParameters)) {
    Variable& variable = out.emplace_back(Variable{name, kUnknownType});
    type.attempt([&] {
      names.add(name, type);
      if (objects.find(name)) type.fail("'" + name + "' is an object, too; rename one");
      variable.type = types.index(type.text(), type);
    });
  }
  return out;
}

}  // namespace roci::planner::timeline_htn::reading
