#include "core/pddl/settle.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/pddl/check_parts.hpp"
#include "core/pddl/hidden_variables.hpp"
#include "core/pddl/printer.hpp"
#include "core/pddl/requirements.hpp"

namespace roci::pddl {

namespace {

bool only_object(const TypedName& name) { return name.types.size() == 1 && name.types.front() == "object"; }

void settle_types(Domain& domain, DiagnosticLog& log) {
  std::map<std::string, const TypedName*> seen;
  for (TypedName& type : domain.types) {
    if (type.name != "object" && std::erase(type.types, type.name) > 0) {
      log.warn(Departure::type_under_itself, type.where,
               "type '" + type.name +
                   "' stands under itself, which is passed over; what stands before it in that list is a "
                   "kind of '" +
                   type.name + "'",
               "give it a list of its own: '" + type.name + " - object'");
      if (type.types.empty()) type.types = {"object"};
    }
    const auto [first, is_new] = seen.emplace(type.name, &type);
    if (is_new) continue;
    const TypedName& before = *first->second;
    if (before.types != type.types && !only_object(before) && !only_object(type)) continue;  // two supertypes
    log.warn(Departure::type_twice, type.where,
             "type '" + type.name + "' is declared twice, and stands under all that both say", "keep one");
  }
}

bool alike(const Signature& a, const Signature& b) {
  return std::ranges::equal(a.parameters, b.parameters, {}, &TypedName::types, &TypedName::types);
}

// Erases signatures that say again what one before them says.
void settle_signatures(std::vector<Signature>& signatures, std::string_view what, DiagnosticLog& log) {
  std::map<std::string_view, std::size_t> seen;
  std::vector<std::size_t> again;
  for (std::size_t i = 0; i < signatures.size(); ++i) {
    const auto [first, is_new] = seen.emplace(signatures[i].name, i);
    if (is_new || !alike(signatures[first->second], signatures[i])) continue;
    log.warn(Departure::signature_twice, signatures[i].where,
             std::string(what) + " '" + signatures[i].name + "' is declared twice alike, and counts once",
             "keep one");
    again.push_back(i);
  }
  if (again.empty()) return;
  std::vector<Signature> kept;
  for (std::size_t i = 0; i < signatures.size(); ++i)
    if (!std::ranges::binary_search(again, i)) kept.push_back(std::move(signatures[i]));
  signatures = std::move(kept);
}

using Declared = std::unordered_map<std::string_view, const TypedName*>;

// An object that is declared again with another type has both types; that is no departure.
void settle_objects(const std::vector<TypedName>& names, Declared& seen, std::string_view what,
                    DiagnosticLog& log) {
  for (const TypedName& name : names) {
    const auto [first, is_new] = seen.emplace(name.name, &name);
    if (is_new || (first->second->types != name.types && !only_object(name) && !only_object(*first->second)))
      continue;
    log.warn(Departure::object_twice, name.where,
             std::string(what) + " '" + name.name + "' is declared twice, and is one object", "keep one");
  }
}

// Names of what a domain declares. Nearest words, which take more, are looked for only where something is unknown.
class Known {
 public:
  explicit Known(const Domain& domain) : domain_(domain), types_{"object"} {
    for (const TypedName& type : domain.types) {
      types_.insert(type.name);
      types_.insert(type.types.begin(), type.types.end());
    }
    for (const Signature& function : domain.functions) functions_.insert(function.name);
    for (const Module& module : domain.modules)
      for (const Signature& function : module.functions) functions_.insert(function.name);
  }

  bool type(std::string_view name) const { return types_.contains(name); }
  bool function(std::string_view name) const { return functions_.contains(name); }
  const Symbols& symbols() {
    if (!symbols_) symbols_.emplace(domain_);
    return *symbols_;
  }

 private:
  const Domain& domain_;
  std::set<std::string_view> types_;
  std::set<std::string_view> functions_;
  std::optional<Symbols> symbols_;
};

void settle_object_types(Problem& problem, Known& known, DiagnosticLog& log) {
  for (TypedName& object : problem.objects) {
    std::erase_if(object.types, [&](const std::string& type) {
      if (known.type(type)) return false;
      log.warn(Departure::undeclared_type, object.where,
               "type '" + type + "' of '" + object.name +
                   "' is not declared; it counts as an object of no other type",
               known.symbols().remedy_for_type(type, "declare it in :types"));
      return true;
    });
    if (object.types.empty()) object.types = {"object"};
  }
}

void settle_values(Problem& problem, Known& known, DiagnosticLog& log) {
  std::erase_if(problem.values, [&](const InitialValue& initial) {
    const std::string& function = initial.fluent.symbol;
    if (known.function(function)) return false;
    log.warn(Departure::undeclared_function, initial.fluent.where,
             "function '" + function + "' is not declared; its initial value is passed over",
             known.symbols().remedy_for_function(function, "declare it in :functions"));
    return true;
  });
}

struct SameFluent {
  bool operator()(const InitialValue* a, const InitialValue* b) const {
    return a->fluent.symbol == b->fluent.symbol &&
           std::ranges::equal(a->fluent.arguments, b->fluent.arguments, {}, &Term::name, &Term::name);
  }
};
struct HashOfFluent {
  std::size_t operator()(const InitialValue* initial) const {
    std::size_t out = std::hash<std::string>()(initial->fluent.symbol);
    for (const Term& term : initial->fluent.arguments)
      out = out * 31 + std::hash<std::string>()(term.name);
    return out;
  }
};

void warn_of_values(const std::vector<InitialValue>& values, DiagnosticLog& log) {
  std::unordered_map<const InitialValue*, double, HashOfFluent, SameFluent> seen;
  seen.reserve(values.size());
  for (const InitialValue& initial : values) {
    const auto [first, is_new] = seen.emplace(&initial, initial.value);
    if (is_new || std::exchange(first->second, initial.value) == initial.value) continue;
    log.warn(Departure::value_twice, initial.fluent.where,
             print(initial.fluent) + " has another initial value since line " +
                 std::to_string(first->first->fluent.where.line) + "; this one holds",
             "keep one");
  }
}

void warn_of_requirements(const std::map<std::string, SourceLocation>& lacking, DiagnosticLog& log) {
  for (const auto& [flag, where] : lacking) {
    log.warn(Departure::missing_requirement, where,
             "this needs the requirement " + flag + ", and is read as if :requirements had it",
             "add " + flag + " to (:requirements …)");
  }
}

}  // namespace

void settle(Domain& domain, DiagnosticLog& log) {
  settle_types(domain, log);
  settle_signatures(domain.predicates, "predicate", log);
  settle_signatures(domain.functions, "function", log);
  Declared constants;
  settle_objects(domain.constants, constants, "constant", log);
  rename_hiding_variables(domain, log);
  if (log.errors() == 0) warn_of_requirements(lacking_requirements(domain), log);
}

void settle(Problem& problem, const Domain& domain, DiagnosticLog& log) {
  if (problem.domain_name != domain.name && !problem.domain_name.empty()) {
    log.warn(Departure::domain_name, problem.where,
             "the problem is for domain '" + problem.domain_name + "', and is read for '" + domain.name + "'",
             "write (:domain " + domain.name + "), or use the domain file that it was written for");
    problem.domain_name = domain.name;
  }
  Declared objects;
  for (const TypedName& constant : domain.constants) objects.emplace(constant.name, &constant);
  settle_objects(problem.objects, objects, "object", log);
  Known known(domain);
  settle_object_types(problem, known, log);
  settle_values(problem, known, log);
  warn_of_values(problem.values, log);
  rename_hiding_variables(problem, log);
  if (log.errors() == 0) warn_of_requirements(lacking_requirements(problem, domain), log);
}

}  // namespace roci::pddl
