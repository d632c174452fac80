#include <algorithm>
#include <array>

#include "core/pddl/grammar.hpp"

namespace roci::pddl::grammar {

void Source::fail(SourceLocation where, std::string message, std::string remedy) const {
  throw ParseError({file_, where, std::move(message), std::move(remedy)});
}

std::span<const Sexpr> rest(const Sexpr& list, std::size_t skip) {
  return std::span(list.items).subspan(std::min(skip, list.items.size()));
}

std::string read_name(const Sexpr& s, std::string_view what, const Source& source) {
  const std::string wanted(what);
  if (s.is_list) source.fail(s.where, wanted + " expected, found a list", "write a name");
  const char first = s.word.front();
  if (first == '?') source.fail(s.where, wanted + " expected, found the variable " + s.word, "write a name");
  if (first == ':') source.fail(s.where, wanted + " expected, found the keyword " + s.word, "write a name");
  if (s.word == "-") source.fail(s.where, wanted + " expected, found '-'", "write a name");
  return s.word;
}

double read_number(const Sexpr& s, std::string_view what, const Source& source) {
  if (!s.is_list) {
    if (const auto number = as_number(s.word)) return *number;
  }
  const std::string found = s.is_list ? "a list" : "'" + s.word + "'";
  source.fail(s.where, std::string(what) + " expected, found " + found, "write a finite decimal number");
}

const Sexpr& require_list(const Sexpr& s, std::string_view what, const Source& source) {
  if (!s.is_list) {
    source.fail(s.where, std::string(what) + " expected, found '" + s.word + "'", "write it in parentheses");
  }
  return s;
}

namespace {

// Reads `t` or `(either t u …)`.
std::vector<std::string> read_type(const Sexpr& s, const Source& source) {
  if (!s.is_list) return {read_name(s, "a type", source)};
  if (s.head() != "either" || s.items.size() < 2) {
    source.fail(s.where, "a type expected, found a list", "write a name or (either a b)");
  }
  std::vector<std::string> types;
  for (const Sexpr& item : rest(s)) types.push_back(read_name(item, "a type", source));
  return types;
}

Term read_term(const Sexpr& s, const Atom& owner, const Source& source) {
  static constexpr std::array<std::string_view, 10> kTrajectory = {
      "always",          "sometime",      "within",     "at-most-once", "sometime-after",
      "sometime-before", "always-within", "hold-after", "hold-during",  "preference"};
  if (s.is_list) {
    if (std::find(kTrajectory.begin(), kTrajectory.end(), owner.symbol) != kTrajectory.end()) {
      const bool preference = owner.symbol == "preference";
      source.fail(owner.where,
                  preference ? "preferences are not supported"
                             : "trajectory constraint '" + owner.symbol + "' is not supported",
                  "state it as a condition or a goal");
    }
    if (owner.symbol == "at" || owner.symbol == "over") {
      source.fail(owner.where, "'" + owner.symbol + " …' with a condition or effect is out of place here",
                  "times stand around the parts of a durative action, and in :init");
    }
    source.fail(s.where, "an argument of '" + owner.symbol + "' is a list: object fluents are not supported",
                "use a predicate and a parameter for the object");
  }
  if (s.word.front() == '?') {
    if (s.word.size() == 1) source.fail(s.where, "a variable without a name", "write ?x");
    return {s.word, s.where};
  }
  return {read_name(s, "an object or variable", source), s.where};
}

}  // namespace

std::vector<TypedName> read_typed_names(std::span<const Sexpr> items, std::string_view what,
                                        const Source& source) {
  std::vector<TypedName> names;
  std::size_t untyped = 0;  // names[untyped…] still wait for their type
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!items[i].is_word("-")) {
      TypedName name;
      name.name = read_name(items[i], what, source);
      name.where = items[i].where;
      names.push_back(std::move(name));
      continue;
    }
    if (untyped == names.size())
      source.fail(items[i].where, "'-' without a name before it", "write NAME - TYPE");
    if (++i == items.size())
      source.fail(items[i - 1].where, "'-' without a type after it", "write NAME - TYPE");
    const auto types = read_type(items[i], source);
    for (; untyped < names.size(); ++untyped) names[untyped].types = types;
  }
  return names;
}

std::vector<TypedName> read_variables(const Sexpr& list, const Source& source) {
  require_list(list, "a list of variables", source);
  std::vector<Sexpr> bare = list.items;  // without question marks, to be read as names
  bool type_next = false;
  for (Sexpr& item : bare) {
    if (!item.is_list && item.word != "-" && !type_next) {
      if (item.word.front() != '?' || item.word.size() == 1) {
        source.fail(item.where, "a variable expected, found '" + item.word + "'", "variables begin with '?'");
      }
      item.word.erase(0, 1);
    }
    type_next = item.is_word("-");
  }
  auto variables = read_typed_names(bare, "a variable", source);
  for (TypedName& variable : variables) variable.name.insert(0, 1, '?');
  return variables;
}

Atom read_atom(const Sexpr& s, std::string_view what, const Source& source) {
  require_list(s, what, source);
  if (s.items.empty())
    source.fail(s.where, std::string(what) + " expected, found ()", "write (NAME ARGUMENT …)");
  Atom atom;
  atom.where = s.where;
  atom.symbol = read_name(s.items.front(), what, source);
  for (const Sexpr& item : rest(s)) atom.arguments.push_back(read_term(item, atom, source));
  return atom;
}

Atom read_function(const Sexpr& s, const Source& source) {
  if (s.is_list) return read_atom(s, "a number or a function", source);
  return {read_name(s, "a number or a function", source), {}, s.where};
}

Signature read_signature(const Sexpr& s, std::string_view what, const Source& source) {
  require_list(s, what, source);
  if (s.items.empty())
    source.fail(s.where, std::string(what) + " expected, found ()", "write (NAME ?x - TYPE …)");
  Signature signature;
  signature.where = s.where;
  signature.name = read_name(s.items.front(), what, source);
  Sexpr parameters = s;
  parameters.items.erase(parameters.items.begin());
  signature.parameters = read_variables(parameters, source);
  return signature;
}

std::vector<Signature> read_functions(std::span<const Sexpr> items, const Source& source) {
  std::vector<Signature> functions;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!items[i].is_word("-")) {
      functions.push_back(read_signature(items[i], "a function", source));
      continue;
    }
    if (++i == items.size()) source.fail(items[i - 1].where, "'-' without a type after it", "write - number");
    if (!items[i].is_word("number")) {
      source.fail(items[i].where, "a function of another type than number: object fluents are not supported",
                  "use a predicate with a parameter for the value");
    }
  }
  return functions;
}

}  // namespace roci::pddl::grammar
