#include <algorithm>
#include <array>

#include "core/pddl/grammar.hpp"
#include "core/words/nearest_word.hpp"

namespace roci::pddl::grammar {

namespace {

constexpr std::array<std::string_view, 20> kKnown = {":strips",
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
// They announce what is refused where it is used; announcing it is harmless.
constexpr std::array<std::string_view, 15> kRefused = {
    ":object-fluents", ":preferences", ":constraints",      ":time",
    ":processes",      ":events",      ":hierarchy",        ":probabilistic-effects",
    ":rewards",        ":multi-agent", ":factored-privacy", ":unfactored-privacy",
    ":goal-utilities", ":contingent",  ":non-deterministic"};

bool is_one_of(const auto& words, std::string_view word) { return std::ranges::count(words, word) > 0; }

}  // namespace

std::string read_define(const Sexpr& s, std::string_view kind, const Source& source) {
  const std::string form = "(define (" + std::string(kind) + " NAME) …)";
  if (s.head() != "define") source.fail(s.where, "not a PDDL definition", "begin with " + form);
  if (s.items().size() < 2 || s.items()[1].head() != kind || s.items()[1].items().size() != 2) {
    source.fail(s.items().size() < 2 ? s.where : s.items()[1].where, "not a " + std::string(kind),
                "begin with " + form);
  }
  return read_name(s.items()[1].items()[1], "the name of the " + std::string(kind), source);
}

std::vector<Requirement> read_requirements(const Sexpr& s, const Source& source) {
  std::vector<Requirement> requirements;
  for (const Sexpr& item : rest(s)) {
    if (item.is_list()) {
      source.report(item.where, "a requirement expected, found a list", "write :typing and the like");
    } else if (is_one_of(kKnown, item.word())) {
      requirements.push_back({text(item), item.where});
    } else if (is_one_of(kKnown, ":" + text(item))) {
      source.warn(Departure::requirement_flag, item.where,
                  "'" + text(item) + "' is read as ':" + text(item) + "'", "requirements begin with ':'");
      requirements.push_back({":" + text(item), item.where});
    } else if (is_one_of(kRefused, item.word())) {
      source.warn(Departure::requirement_flag, item.where,
                  "requirement " + text(item) + " is not supported, and passed over until something needs it",
                  "take it away if nothing does");
    } else {
      source.warn(
          Departure::requirement_flag, item.where, "unknown requirement " + text(item) + " is passed over",
          words::nearest(item.word(), kKnown).remedy("known are those of PDDL 2.1 and 2.2, and :modules"));
    }
  }
  return requirements;
}

std::string unknown_section(const Sexpr& s, std::string_view kind) {
  const std::string found = std::string(s.is_list() ? s.head() : s.word());
  return "unknown section " + (found.empty() ? "" : "'" + found + "' ") + "of a " + std::string(kind);
}

std::string remedy_for_section(const Sexpr& s, std::span<const std::string_view> known) {
  std::string all;
  for (const std::string_view name : known) all += (all.empty() ? "" : " ") + std::string(name);
  return words::nearest(s.is_list() ? s.head() : s.word(), known).remedy("known: " + all);
}

}  // namespace roci::pddl::grammar
