#include <array>
#include <utility>

#include "core/pddl/grammar.hpp"
#include "core/pddl/parse_parts.hpp"
#include "core/pddl/parser.hpp"

namespace roci::pddl {

namespace {

using namespace grammar;

struct Value {
  Atom fluent;
  double value;
};

Value read_value(const Sexpr& s, const Source& source) {
  if (s.items().size() != 3)
    source.fail(s.where, "'=' needs a function and a number", "write (= (f …) NUMBER)");
  return {read_function(s.items()[1], source), read_number(s.items()[2], "a number", source)};
}

Literal read_literal(const Sexpr& s, const Source& source) {
  if (s.head() != "not") return {read_atom(s, "a fact", source), false};
  if (s.items().size() != 2) source.fail(s.where, "'not' needs one fact", "write (not (p …))");
  return {read_atom(s.items()[1], "a fact", source), true};
}

// Tells a timed fact, (at NUMBER FACT), from the atom of a predicate named `at`.
bool is_timed(const Sexpr& s) {
  return s.head() == "at" && s.items().size() == 3 && s.items()[2].is_list() && !s.items()[1].is_list() &&
         as_number(s.items()[1].word());
}

void read_timed(const Sexpr& s, Problem& problem, const Source& source) {
  const double time = read_number(s.items()[1], "a time", source);
  if (time < 0)
    source.fail(s.items()[1].where, "a fact at a time before 0", "times count from the problem's start");
  if (s.items()[2].head() == "=") {
    Value value = read_value(s.items()[2], source);
    problem.timed_values.push_back({time, std::move(value.fluent), value.value, s.where});
  } else {
    problem.timed_literals.push_back({time, read_literal(s.items()[2], source), s.where});
  }
}

void read_fact(const Sexpr& s, Problem& problem, const Source& source) {
  if (is_timed(s)) {
    read_timed(s, problem, source);
  } else if (s.head() == "=") {
    Value value = read_value(s, source);
    problem.values.push_back({std::move(value.fluent), value.value});
  } else if (s.head() == "not") {
    problem.false_facts.push_back(read_literal(s, source).atom);
  } else {
    problem.facts.push_back(read_atom(s, "a fact", source));
  }
}

Metric read_metric(const Sexpr& s, const Source& source) {
  if (s.items().size() != 3 || !(s.items()[1].is_word("minimize") || s.items()[1].is_word("maximize"))) {
    source.fail(s.where, "not a metric",
                "write (:metric minimize EXPRESSION) or (:metric maximize EXPRESSION)");
  }
  const auto sense = s.items()[1].is_word("minimize") ? Metric::Sense::minimize : Metric::Sense::maximize;
  return {sense, read_expression(s.items()[2], source), s.where};
}

const Sexpr& only_part(const Sexpr& s, std::string_view what, const Source& source) {
  if (s.items().size() != 2) {
    source.fail(s.where, std::string(s.head()) + " needs one " + std::string(what),
                "write (" + std::string(s.head()) + " …)");
  }
  return s.items()[1];
}

struct Seen {
  bool domain = false;
  bool init = false;
  bool goal = false;
};

void require_first(bool& seen, const Sexpr& s, const Source& source) {
  if (seen) source.fail(s.where, "a second " + std::string(s.head()), "keep one");
  seen = true;
}

void read_section(const Sexpr& s, Problem& problem, Seen& seen, const Source& source, Unread& unread) {
  static constexpr std::array<std::string_view, 6> kKnown = {":domain", ":requirements", ":objects",
                                                             ":init",   ":goal",         ":metric"};
  const std::string_view head = s.head();
  if (head == ":domain") {
    require_first(seen.domain, s, source);
    problem.domain_name = read_name(only_part(s, "name", source), "the name of a domain", source);
  } else if (head == ":requirements") {
    problem.requirements = read_requirements(s, source);
  } else if (head == ":objects") {
    const bool whole = source.attempt([&] {
      for (TypedName& name : read_typed_names(rest(s), "an object", source))
        problem.objects.push_back(std::move(name));
    });
    unread.objects = !whole || unread.objects;
  } else if (head == ":init") {
    require_first(seen.init, s, source);
    for (const Sexpr& item : rest(s)) source.attempt([&] { read_fact(item, problem, source); });
  } else if (head == ":goal") {
    require_first(seen.goal, s, source);
    problem.goal = read_condition(only_part(s, "condition", source), source);
  } else if (head == ":metric") {
    if (problem.metric) source.fail(s.where, "a second :metric", "keep one");
    problem.metric = read_metric(s, source);
  } else if (head == ":length") {
    source.warn(Departure::old_section, s.where, "unknown section ':length', of PDDL 1.2, is passed over",
                "take it away");
  } else if (head == ":constraints") {
    source.refuse(s.where, "trajectory constraints are not supported", "state them as conditions or goals");
  } else if (head == ":htn") {
    source.refuse(s.where, "hierarchical tasks (HDDL) are not supported", "state goals instead of tasks");
  } else {
    source.fail(s.where, unknown_section(s, "problem"), remedy_for_section(s, kKnown));
  }
}

// What is missing may stand in something that could not be read.
void require_sections(const Seen& seen, SourceLocation where, const Source& source) {
  if (source.errors() > 0) return;
  const auto require = [&](bool present, std::string_view keyword) {
    if (!present) source.report(where, "the problem has no " + std::string(keyword), "add one");
  };
  require(seen.domain, ":domain");
  require(seen.init, ":init");
  if (seen.goal) return;
  source.warn(Departure::missing_goal, where, "the problem has no :goal, and nothing is asked for",
              "add (:goal …)");
}

}  // namespace

Problem read_problem(std::string_view text, DiagnosticLog& log, Unread& unread) {
  const Source source(log);
  const SexprTree tree = read_sexpr(text, "problem", log);
  const Sexpr& s = tree.root();
  Problem problem;
  problem.file = source.file();
  problem.where = s.where;
  if (!source.attempt([&] { problem.name = read_define(s, "problem", source); })) log.throw_errors();
  Seen seen;
  for (const Sexpr& section : rest(s, 2))
    source.attempt([&] { read_section(section, problem, seen, source, unread); });
  require_sections(seen, s.where, source);
  return problem;
}

Problem parse_problem(std::string_view text, std::string_view file, Strictness strictness) {
  DiagnosticLog log{std::string(file), strictness};
  Unread unread;
  Problem problem = read_problem(text, log, unread);
  log.throw_errors();
  problem.warnings = log.warnings();
  return problem;
}

}  // namespace roci::pddl
