#include "core/pddl/grammar.hpp"
#include "core/pddl/parser.hpp"

namespace roci::pddl {

namespace {

using namespace grammar;

struct Value {
  Atom fluent;
  double value;
};

Value read_value(const Sexpr& s, const Source& source) {
  if (s.items.size() != 3)
    source.fail(s.where, "'=' needs a function and a number", "write (= (f …) NUMBER)");
  return {read_function(s.items[1], source), read_number(s.items[2], "a number", source)};
}

Literal read_literal(const Sexpr& s, const Source& source) {
  if (s.head() != "not") return {read_atom(s, "a fact", source), false};
  if (s.items.size() != 2) source.fail(s.where, "'not' needs one fact", "write (not (p …))");
  return {read_atom(s.items[1], "a fact", source), true};
}

// Tells a timed fact, (at NUMBER FACT), from the atom of a predicate named `at`.
bool is_timed(const Sexpr& s) {
  return s.head() == "at" && s.items.size() == 3 && s.items[2].is_list && !s.items[1].is_list &&
         as_number(s.items[1].word);
}

void read_timed(const Sexpr& s, Problem& problem, const Source& source) {
  const double time = read_number(s.items[1], "a time", source);
  if (time < 0)
    source.fail(s.items[1].where, "a fact at a time before 0", "times count from the problem's start");
  if (s.items[2].head() == "=") {
    Value value = read_value(s.items[2], source);
    problem.timed_values.push_back({time, std::move(value.fluent), value.value, s.where});
  } else {
    problem.timed_literals.push_back({time, read_literal(s.items[2], source), s.where});
  }
}

void read_init(const Sexpr& s, Problem& problem, const Source& source) {
  for (const Sexpr& item : rest(s)) {
    if (is_timed(item)) {
      read_timed(item, problem, source);
    } else if (item.head() == "=") {
      Value value = read_value(item, source);
      problem.values.push_back({std::move(value.fluent), value.value});
    } else if (item.head() == "not") {
      problem.false_facts.push_back(read_literal(item, source).atom);
    } else {
      problem.facts.push_back(read_atom(item, "a fact", source));
    }
  }
}

Metric read_metric(const Sexpr& s, const Source& source) {
  if (s.items.size() != 3 || !(s.items[1].is_word("minimize") || s.items[1].is_word("maximize"))) {
    source.fail(s.where, "not a metric",
                "write (:metric minimize EXPRESSION) or (:metric maximize EXPRESSION)");
  }
  const auto sense = s.items[1].is_word("minimize") ? Metric::Sense::minimize : Metric::Sense::maximize;
  return {sense, read_expression(s.items[2], source), s.where};
}

const Sexpr& only_part(const Sexpr& s, std::string_view what, const Source& source) {
  if (s.items.size() != 2) {
    source.fail(s.where, std::string(s.head()) + " needs one " + std::string(what),
                "write (" + std::string(s.head()) + " …)");
  }
  return s.items[1];
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

void read_section(const Sexpr& s, Problem& problem, Seen& seen, const Source& source) {
  const std::string_view head = s.head();
  if (head == ":domain") {
    require_first(seen.domain, s, source);
    problem.domain_name = read_name(only_part(s, "name", source), "the name of a domain", source);
  } else if (head == ":requirements") {
    problem.requirements = read_requirements(s, source);
  } else if (head == ":objects") {
    for (TypedName& name : read_typed_names(rest(s), "an object", source))
      problem.objects.push_back(std::move(name));
  } else if (head == ":init") {
    require_first(seen.init, s, source);
    read_init(s, problem, source);
  } else if (head == ":goal") {
    require_first(seen.goal, s, source);
    problem.goal = read_condition(only_part(s, "condition", source), source);
  } else if (head == ":metric") {
    if (problem.metric) source.fail(s.where, "a second :metric", "keep one");
    problem.metric = read_metric(s, source);
  } else if (head == ":constraints") {
    source.fail(s.where, "trajectory constraints are not supported", "state them as conditions or goals");
  } else {
    source.fail(s.where, "unknown section of a problem",
                "known: :domain :requirements :objects :init :goal :metric");
  }
}

}  // namespace

Problem parse_problem(std::string_view text, std::string_view file) {
  const Source source(file);
  const Sexpr s = read_sexpr(text, file);
  Problem problem;
  problem.file = source.file();
  problem.where = s.where;
  problem.name = read_define(s, "problem", source);
  Seen seen;
  for (const Sexpr& section : rest(s, 2)) read_section(section, problem, seen, source);
  const auto require = [&](bool present, std::string_view keyword) {
    if (!present) source.fail(s.where, "the problem has no " + std::string(keyword), "add one");
  };
  require(seen.domain, ":domain");
  require(seen.init, ":init");
  require(seen.goal, ":goal");
  return problem;
}

}  // namespace roci::pddl
