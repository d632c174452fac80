#include "core/pddl/settle.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "core/pddl/check_parts.hpp"
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
  std::map<std::string, Signature> seen;
  std::erase_if(signatures, [&](const Signature& signature) {
    const auto [first, is_new] = seen.emplace(signature.name, signature);
    if (is_new || !alike(first->second, signature)) return false;
    log.warn(Departure::signature_twice, signature.where,
             std::string(what) + " '" + signature.name + "' is declared twice alike, and counts once",
             "keep one");
    return true;
  });
}

void settle_objects(const std::vector<TypedName>& names,
                    std::map<std::string, std::vector<std::string>>& seen, std::string_view what,
                    DiagnosticLog& log) {
  for (const TypedName& name : names) {
    const auto [first, is_new] = seen.emplace(name.name, name.types);
    if (is_new || (first->second != name.types && !only_object(name))) continue;  // or of two types
    log.warn(Departure::object_twice, name.where,
             std::string(what) + " '" + name.name + "' is declared twice, and is one object", "keep one");
  }
}

void settle_object_types(Problem& problem, const Symbols& symbols, DiagnosticLog& log) {
  for (TypedName& object : problem.objects) {
    std::erase_if(object.types, [&](const std::string& type) {
      if (symbols.types().knows(type)) return false;
      log.warn(Departure::undeclared_type, object.where,
               "type '" + type + "' of '" + object.name +
                   "' is not declared; it counts as an object of no other type",
               symbols.remedy_for_type(type, "declare it in :types"));
      return true;
    });
    if (object.types.empty()) object.types = {"object"};
  }
}

void settle_values(Problem& problem, const Symbols& symbols, DiagnosticLog& log) {
  std::erase_if(problem.values, [&](const InitialValue& initial) {
    const std::string& function = initial.fluent.symbol;
    if (symbols.find_fluent(function) || symbols.find_external(function)) return false;
    log.warn(Departure::undeclared_function, initial.fluent.where,
             "function '" + function + "' is not declared; its initial value is passed over",
             symbols.remedy_for_function(function, "declare it in :functions"));
    return true;
  });
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
  std::map<std::string, std::vector<std::string>> constants;
  settle_objects(domain.constants, constants, "constant", log);
  if (log.errors() == 0) warn_of_requirements(lacking_requirements(domain), log);
}

void settle(Problem& problem, const Domain& domain, DiagnosticLog& log) {
  const Symbols symbols(domain);
  if (problem.domain_name != domain.name && !problem.domain_name.empty()) {
    log.warn(Departure::domain_name, problem.where,
             "the problem is for domain '" + problem.domain_name + "', and is read for '" + domain.name + "'",
             "write (:domain " + domain.name + "), or use the domain file that it was written for");
    problem.domain_name = domain.name;
  }
  std::map<std::string, std::vector<std::string>> objects;
  for (const TypedName& constant : domain.constants) objects.emplace(constant.name, constant.types);
  settle_objects(problem.objects, objects, "object", log);
  settle_object_types(problem, symbols, log);
  settle_values(problem, symbols, log);
  if (log.errors() == 0) warn_of_requirements(lacking_requirements(problem, domain), log);
}

}  // namespace roci::pddl
