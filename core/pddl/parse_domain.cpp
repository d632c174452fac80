#include <array>
#include <iterator>
#include <utility>

#include "core/pddl/grammar.hpp"
#include "core/pddl/parse_parts.hpp"
#include "core/pddl/parser.hpp"

namespace roci::pddl {

namespace {

using namespace grammar;

template <typename T>
void append(std::vector<T> from, std::vector<T>& to) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

constexpr const char* kFunctionForm =
    "write (:function (f ?x - TYPE …)), and :depends-on ((g ?x) LEVEL …) if its values depend on a fluent";

// Reads `((g ?x) 0 20 50)`.
StateDependence read_dependence(const Sexpr& s, const std::string& function, const Source& source) {
  if (s.items().size() < 2) source.fail(s.where, "a fluent with its levels expected", kFunctionForm);
  StateDependence dependence{function, read_function(s.items()[0], source), {}, s.where};
  for (const Sexpr& level : rest(s)) dependence.levels.push_back(read_number(level, "a level", source));
  return dependence;
}

void read_external_function(const Sexpr& s, Module& module, const Source& source) {
  const auto items = s.items();
  if (s.head() != ":function" || items.size() < 2 || items.size() % 2 != 0)
    source.fail(s.where, "an external function expected", kFunctionForm);
  module.functions.push_back(read_signature(items[1], "an external function", source));
  for (std::size_t i = 2; i < items.size(); i += 2) {
    if (!items[i].is_word(":depends-on"))
      source.fail(items[i].where, "':depends-on' expected", kFunctionForm);
    module.dependences.push_back(read_dependence(items[i + 1], module.functions.back().name, source));
  }
}

Module read_module(const Sexpr& s, const Source& source) {
  if (s.head() != ":module" || s.items().size() < 2) {
    source.fail(s.where, "a module expected", "write (:module NAME (:function (f ?x - TYPE …)) …)");
  }
  Module module;
  module.where = s.where;
  module.name = read_name(s.items()[1], "the name of a module", source);
  for (const Sexpr& item : rest(s, 2)) source.attempt([&] { read_external_function(item, module, source); });
  return module;
}

DerivedPredicate read_derived(const Sexpr& s, const Source& source) {
  if (s.items().size() != 3) {
    source.fail(s.where, "':derived' needs a head and a body", "write (:derived (p ?x - TYPE …) CONDITION)");
  }
  return {read_signature(s.items()[1], "a derived predicate", source), read_condition(s.items()[2], source)};
}

// Sections of other languages than this one: nothing here plans by them.
void refuse_section(const Sexpr& s, const Source& source) {
  const std::string_view head = s.head();
  if (head == ":constraints")
    source.refuse(s.where, "trajectory constraints are not supported", "state them as conditions of actions");
  if (head == ":process" || head == ":event") {
    source.refuse(s.where, "processes and events (PDDL+) are not supported",
                  "model them with durative actions or TILs");
  }
  if (head == ":task" || head == ":method")
    source.refuse(s.where, "hierarchical tasks (HDDL) are not supported", "state goals instead of tasks");
}

void read_section(const Sexpr& s, Domain& domain, const Source& source, Unread& unread) {
  static constexpr std::array<std::string_view, 9> kKnown = {
      ":requirements", ":types",   ":constants", ":predicates",     ":functions",
      ":modules",      ":derived", ":action",    ":durative-action"};
  const std::string_view head = s.head();
  const auto mark = [&](bool& unknown, auto read) { unknown = !source.attempt(read) || unknown; };
  if (head == ":requirements") {
    append(read_requirements(s, source), domain.requirements);
  } else if (head == ":types") {
    mark(unread.types, [&] { append(read_typed_names(rest(s), "a type", source), domain.types); });
  } else if (head == ":constants") {
    mark(unread.objects, [&] { append(read_typed_names(rest(s), "a constant", source), domain.constants); });
  } else if (head == ":predicates") {
    for (const Sexpr& item : rest(s))
      mark(unread.predicates,
           [&] { domain.predicates.push_back(read_signature(item, "a predicate", source)); });
  } else if (head == ":functions") {
    mark(unread.functions, [&] { append(read_functions(rest(s), source), domain.functions); });
  } else if (head == ":modules") {
    for (const Sexpr& item : rest(s))
      mark(unread.functions, [&] { domain.modules.push_back(read_module(item, source)); });
  } else if (head == ":derived") {
    domain.derived.push_back(read_derived(s, source));
  } else if (head == ":action") {
    domain.actions.push_back(read_action(s, source));
  } else if (head == ":durative-action") {
    domain.durative_actions.push_back(read_durative_action(s, source));
  } else {
    refuse_section(s, source);
    source.fail(s.where, unknown_section(s, "domain"), remedy_for_section(s, kKnown));
  }
}

}  // namespace

Domain read_domain(std::string_view text, DiagnosticLog& log, Unread& unread) {
  const Source source(log);
  const SexprTree tree = read_sexpr(text, "domain", log);
  const Sexpr& s = tree.root();
  Domain domain;
  domain.file = source.file();
  domain.where = s.where;
  if (!source.attempt([&] { domain.name = read_define(s, "domain", source); })) log.throw_errors();
  for (const Sexpr& section : rest(s, 2))
    source.attempt([&] { read_section(section, domain, source, unread); });
  return domain;
}

Domain parse_domain(std::string_view text, std::string_view file, Strictness strictness) {
  DiagnosticLog log{std::string(file), strictness};
  Unread unread;
  Domain domain = read_domain(text, log, unread);
  log.throw_errors();
  domain.warnings = log.warnings();
  return domain;
}

}  // namespace roci::pddl
