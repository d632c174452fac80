#include <algorithm>
#include <array>

#include "core/pddl/grammar.hpp"
#include "core/pddl/parser.hpp"

namespace roci::pddl {

namespace grammar {

std::string read_define(const Sexpr& s, std::string_view kind, const Source& source) {
  const std::string form = "(define (" + std::string(kind) + " NAME) …)";
  if (s.head() != "define") source.fail(s.where, "not a PDDL definition", "begin with " + form);
  if (s.items.size() < 2 || s.items[1].head() != kind || s.items[1].items.size() != 2) {
    source.fail(s.items.size() < 2 ? s.where : s.items[1].where, "not a " + std::string(kind),
                "begin with " + form);
  }
  return read_name(s.items[1].items[1], "the name of the " + std::string(kind), source);
}

std::vector<Requirement> read_requirements(const Sexpr& s, const Source& source) {
  static constexpr std::array<std::string_view, 20> kKnown = {":strips",
                                                              ":typing",
                                                              ":equality",
                                                              ":adl",
                                                              ":negative-preconditions",
                                                              ":disjunctive-preconditions",
                                                              ":existential-preconditions",
                                                              ":universal-preconditions",
                                                              ":quantified-preconditions",
                                                              ":conditional-effects",
                                                              ":fluents",
                                                              ":numeric-fluents",
                                                              ":durative-actions",
                                                              ":duration-inequalities",
                                                              ":continuous-effects",
                                                              ":timed-initial-literals",
                                                              ":timed-initial-fluents",
                                                              ":derived-predicates",
                                                              ":action-costs",
                                                              ":modules"};
  static constexpr std::array<std::string_view, 6> kRefused = {
      ":object-fluents", ":preferences", ":constraints", ":time", ":processes", ":events"};
  std::vector<Requirement> requirements;
  for (const Sexpr& item : rest(s)) {
    if (item.is_list)
      source.fail(item.where, "a requirement expected, found a list", "write :typing and the like");
    if (std::find(kRefused.begin(), kRefused.end(), item.word) != kRefused.end()) {
      source.fail(item.where, "requirement " + item.word + " is not supported",
                  "model the domain without it");
    }
    if (std::find(kKnown.begin(), kKnown.end(), item.word) == kKnown.end()) {
      source.fail(item.where, "unknown requirement " + item.word,
                  "known are those of PDDL 2.1 and 2.2, and :modules");
    }
    requirements.push_back({item.word, item.where});
  }
  return requirements;
}

}  // namespace grammar

namespace {

using namespace grammar;

template <typename T>
void append(std::vector<T> from, std::vector<T>& to) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

Module read_module(const Sexpr& s, const Source& source) {
  if (s.head() != ":module" || s.items.size() < 2) {
    source.fail(s.where, "a module expected", "write (:module NAME (:function (f ?x - TYPE …)) …)");
  }
  Module module;
  module.where = s.where;
  module.name = read_name(s.items[1], "the name of a module", source);
  for (const Sexpr& item : rest(s, 2)) {
    if (item.head() != ":function" || item.items.size() != 2) {
      source.fail(item.where, "an external function expected", "write (:function (f ?x - TYPE …))");
    }
    module.functions.push_back(read_signature(item.items[1], "an external function", source));
  }
  return module;
}

DerivedPredicate read_derived(const Sexpr& s, const Source& source) {
  if (s.items.size() != 3) {
    source.fail(s.where, "':derived' needs a head and a body", "write (:derived (p ?x - TYPE …) CONDITION)");
  }
  return {read_signature(s.items[1], "a derived predicate", source), read_condition(s.items[2], source)};
}

void read_section(const Sexpr& s, Domain& domain, const Source& source) {
  const std::string_view head = s.head();
  if (head == ":requirements") {
    append(read_requirements(s, source), domain.requirements);
  } else if (head == ":types") {
    append(read_typed_names(rest(s), "a type", source), domain.types);
  } else if (head == ":constants") {
    append(read_typed_names(rest(s), "a constant", source), domain.constants);
  } else if (head == ":predicates") {
    for (const Sexpr& item : rest(s))
      domain.predicates.push_back(read_signature(item, "a predicate", source));
  } else if (head == ":functions") {
    append(read_functions(rest(s), source), domain.functions);
  } else if (head == ":modules") {
    for (const Sexpr& item : rest(s)) domain.modules.push_back(read_module(item, source));
  } else if (head == ":derived") {
    domain.derived.push_back(read_derived(s, source));
  } else if (head == ":action") {
    domain.actions.push_back(read_action(s, source));
  } else if (head == ":durative-action") {
    domain.durative_actions.push_back(read_durative_action(s, source));
  } else if (head == ":constraints") {
    source.fail(s.where, "trajectory constraints are not supported", "state them as conditions of actions");
  } else if (head == ":process" || head == ":event") {
    source.fail(s.where, "processes and events (PDDL+) are not supported",
                "model them with durative actions or TILs");
  } else {
    source.fail(s.where, "unknown section of a domain",
                "known: :requirements :types :constants :predicates :functions :modules :derived :action "
                ":durative-action");
  }
}

}  // namespace

Domain parse_domain(std::string_view text, std::string_view file) {
  const Source source(file);
  const Sexpr s = read_sexpr(text, file);
  Domain domain;
  domain.file = source.file();
  domain.where = s.where;
  domain.name = read_define(s, "domain", source);
  for (const Sexpr& section : rest(s, 2)) read_section(section, domain, source);
  return domain;
}

}  // namespace roci::pddl
