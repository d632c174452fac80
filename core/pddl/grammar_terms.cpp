#include <algorithm>
#include <array>
#include <utility>

#include "core/pddl/grammar.hpp"
#include "core/words/nearest_word.hpp"

namespace roci::pddl::grammar {

void Source::fail(SourceLocation where, std::string message, std::string remedy) const {
  throw ParseError({file(), where, std::move(message), std::move(remedy)});
}

void Source::refuse(SourceLocation where, std::string message, std::string remedy) const {
  throw ParseError({file(), where, std::move(message), std::move(remedy), Severity::unsupported});
}

void Source::report(SourceLocation where, std::string message, std::string remedy) const {
  log_.error(where, std::move(message), std::move(remedy));
}

void Source::warn(Departure departure, SourceLocation where, std::string message, std::string remedy) const {
  log_.warn(departure, where, std::move(message), std::move(remedy));
}

std::span<const Sexpr> rest(const Sexpr& list, std::size_t skip) {
  return list.items().subspan(std::min(skip, list.items().size()));
}

std::string read_name(const Sexpr& s, std::string_view what, const Source& source) {
  const auto fail = [&](const std::string& found) {
    source.fail(s.where, std::string(what) + " expected, found " + found, "write a name");
  };
  if (s.is_list()) fail("a list");
  const char first = s.word().front();
  if (first == '?') fail("the variable " + text(s));
  if (first == ':') fail("the keyword " + text(s));
  if (s.word() == "-") fail("'-'");
  return text(s);
}

double read_number(const Sexpr& s, std::string_view what, const Source& source) {
  if (!s.is_list()) {
    if (const auto number = as_number(s.word())) return *number;
  }
  const std::string found = s.is_list() ? "a list" : "'" + text(s) + "'";
  source.fail(s.where, std::string(what) + " expected, found " + found, "write a finite decimal number");
}

const Sexpr& require_list(const Sexpr& s, std::string_view what, const Source& source) {
  if (!s.is_list()) {
    source.fail(s.where, std::string(what) + " expected, found '" + text(s) + "'", "write it in parentheses");
  }
  return s;
}

namespace {

// More types than these would be compared with one another for ever.
constexpr std::size_t kMostAlternatives = 200;

// Reads `t` or `(either t u …)`.
std::vector<std::string> read_type(const Sexpr& s, const Source& source) {
  if (!s.is_list()) return {read_name(s, "a type", source)};
  if (s.head() != "either" || s.items().size() < 2) {
    source.fail(s.where, "a type expected, found a list", "write a name or (either a b)");
  }
  if (s.items().size() > kMostAlternatives + 1) {
    source.fail(s.where, "'either' with more than " + std::to_string(kMostAlternatives) + " types",
                "declare a type above them");
  }
  std::vector<std::string> types;
  for (const Sexpr& item : rest(s)) types.push_back(read_name(item, "a type", source));
  return types;
}

// What is wrong with an atom that has a list for an argument.
[[noreturn]] void fail_for_list(const Sexpr& s, const Atom& owner, const Source& source) {
  static constexpr std::array<std::string_view, 10> kTrajectory = {
      "always",          "sometime",      "within",     "at-most-once", "sometime-after",
      "sometime-before", "always-within", "hold-after", "hold-during",  "preference"};
  static constexpr std::array<std::string_view, 2> kUncertain = {"probabilistic", "oneof"};
  static constexpr std::array<std::string_view, 14> kConnectives = {
      "and",    "or",       "not",      "imply",    "forall",     "exists", "when",
      "assign", "increase", "decrease", "scale-up", "scale-down", "over",   "preference"};
  const auto is_one_of = [&](const auto& words) { return std::ranges::count(words, owner.symbol) > 0; };
  if (is_one_of(kTrajectory)) {
    const bool preference = owner.symbol == "preference";
    source.refuse(owner.where,
                  preference ? "preferences are not supported"
                             : "trajectory constraint '" + owner.symbol + "' is not supported",
                  "state it as a condition or a goal");
  }
  if (is_one_of(kUncertain)) {
    source.refuse(owner.where, "uncertain effects ('" + owner.symbol + "') are not supported",
                  "state what the action is expected to do");
  }
  if (owner.symbol == "at" || owner.symbol == "over") {
    source.fail(owner.where, "'" + owner.symbol + " …' with a condition or effect is out of place here",
                "times stand around the parts of a durative action, and in :init");
  }
  if (is_one_of(kConnectives)) {
    source.fail(s.where,
                "an argument of '" + owner.symbol +
                    "' is a list where a fact is wanted, and object fluents are not supported",
                "a fact is a predicate and its objects: (NAME OBJECT …)");
  }
  const words::NearestWord near = words::nearest(owner.symbol, kConnectives);
  if (!near.found().empty()) {
    source.fail(owner.where, "unknown '" + owner.symbol + "' around other lists",
                near.remedy("a predicate takes objects and variables, no lists"));
  }
  source.fail(s.where, "an argument of '" + owner.symbol + "' is a list: object fluents are not supported",
              "close '(" + owner.symbol +
                  " …' before it if a ')' is missing; else use a predicate with a parameter for the object");
}

Term read_term(const Sexpr& s, const Atom& owner, const Source& source) {
  if (s.is_list()) fail_for_list(s, owner, source);
  if (s.word().front() == '?') {
    if (s.word().size() == 1) source.fail(s.where, "a variable without a name", "write ?x");
    return {text(s), s.where};
  }
  return {read_name(s, "an object or variable", source), s.where};
}

// Whether items[i] is "a-" with a type behind it, as it stands in typed lists.
bool has_glued_hyphen(std::span<const Sexpr> items, std::size_t i) {
  return !items[i].is_list() && items[i].word().size() > 1 && items[i].word().back() == '-' &&
         i + 1 < items.size() && !items[i + 1].is_word("-") &&
         (items[i + 1].is_list() || items[i + 1].word().front() != '?');
}

// Takes "a- t" apart into a, - and t.
std::vector<Sexpr> with_hyphens_apart(std::span<const Sexpr> items, const Source& source) {
  std::vector<Sexpr> apart;
  apart.reserve(items.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    apart.push_back(items[i]);
    if (!has_glued_hyphen(items, i)) continue;
    const std::string_view name = items[i].word().substr(0, items[i].word().size() - 1);
    SourceLocation where = items[i].where;
    where.column += static_cast<int>(name.size());
    source.warn(Departure::hyphen, where, "'-' without a blank before it is read as if there were one",
                "write NAME - TYPE");
    apart.back() = Sexpr::word_at(name, items[i].where);
    apart.push_back(Sexpr::word_at("-", where));
  }
  return apart;
}

std::vector<TypedName> read_names(std::span<const Sexpr> items, std::string_view what, const Source& source) {
  std::vector<TypedName> names;
  std::size_t untyped = 0;  // names[untyped…] still wait for their type
  for (std::size_t i = 0; i < items.size(); ++i) {
    source.attempt([&] {
      if (!items[i].is_word("-")) {
        names.push_back({read_name(items[i], what, source), {}, items[i].where});
        return;
      }
      if (i + 1 == items.size())
        source.fail(items[i].where, "'-' without a type after it", "write NAME - TYPE");
      const Sexpr& type = items[++i];
      if (untyped == names.size())
        source.fail(items[i - 1].where, "'-' without a name before it", "write NAME - TYPE");
      const std::size_t first = std::exchange(untyped, names.size());
      const auto types = read_type(type, source);
      for (std::size_t name = first; name < names.size(); ++name) names[name].types = types;
    });
  }
  for (; untyped < names.size(); ++untyped) names[untyped].types = {"object"};
  return names;
}

}  // namespace

std::vector<TypedName> read_typed_names(std::span<const Sexpr> items, std::string_view what,
                                        const Source& source) {
  for (std::size_t i = 0; i < items.size(); ++i)
    if (has_glued_hyphen(items, i)) return read_names(with_hyphens_apart(items, source), what, source);
  return read_names(items, what, source);
}

std::vector<TypedName> read_variables(std::span<const Sexpr> items, const Source& source) {
  std::vector<Sexpr> bare = with_hyphens_apart(items, source);  // without question marks, to be read as names
  bool type_next = false;
  for (Sexpr& item : bare) {
    if (!item.is_list() && item.word() != "-" && !type_next) {
      if (item.word().front() == '?' && item.word().size() > 1) {
        item = Sexpr::word_at(item.word().substr(1), item.where);
      } else {
        source.report(item.where, "a variable expected, found '" + text(item) + "'",
                      item.word() == "?" ? "write ?x" : "variables begin with '?': write ?" + text(item));
        if (item.word() == "?") item = Sexpr::word_at("x", item.where);  // is not used: there is an error
      }
    }
    type_next = item.is_word("-");
  }
  auto variables = read_names(bare, "a variable", source);
  for (TypedName& variable : variables) variable.name.insert(0, 1, '?');
  return variables;
}

std::vector<TypedName> read_variables(const Sexpr& list, const Source& source) {
  return read_variables(require_list(list, "a list of variables", source).items(), source);
}

Atom read_atom(const Sexpr& s, std::string_view what, const Source& source) {
  require_list(s, what, source);
  if (s.items().empty())
    source.fail(s.where, std::string(what) + " expected, found ()", "write (NAME ARGUMENT …)");
  Atom atom;
  atom.where = s.where;
  atom.symbol = read_name(s.items().front(), what, source);
  atom.arguments.reserve(rest(s).size());
  for (const Sexpr& item : rest(s)) atom.arguments.push_back(read_term(item, atom, source));
  return atom;
}

Atom read_function(const Sexpr& s, const Source& source) {
  if (s.is_list()) return read_atom(s, "a number or a function", source);
  return {read_name(s, "a number or a function", source), {}, s.where};
}

Signature read_signature(const Sexpr& s, std::string_view what, const Source& source) {
  require_list(s, what, source);
  if (s.items().empty())
    source.fail(s.where, std::string(what) + " expected, found ()", "write (NAME ?x - TYPE …)");
  Signature signature;
  signature.where = s.where;
  signature.name = read_name(s.items().front(), what, source);
  signature.parameters = read_variables(rest(s), source);
  return signature;
}

std::vector<Signature> read_functions(std::span<const Sexpr> items, const Source& source) {
  static constexpr std::array<std::string_view, 5> kNumbers = {"real", "float", "double", "int", "integer"};
  std::vector<Signature> functions;
  for (std::size_t i = 0; i < items.size(); ++i) {
    source.attempt([&] {
      if (!items[i].is_word("-")) {
        functions.push_back(read_signature(items[i], "a function", source));
        return;
      }
      if (i + 1 == items.size()) source.fail(items[i].where, "'-' without a type after it", "write - number");
      const Sexpr& type = items[++i];
      if (type.is_word("number")) return;
      if (!type.is_list() && std::ranges::count(kNumbers, type.word()) > 0) {
        source.warn(Departure::number_type, type.where, "'" + text(type) + "' is read as 'number'",
                    "write - number, or nothing");
        return;
      }
      source.refuse(type.where, "a function of another type than number: object fluents are not supported",
                    "use a predicate with a parameter for the value");
    });
  }
  return functions;
}

}  // namespace roci::pddl::grammar
