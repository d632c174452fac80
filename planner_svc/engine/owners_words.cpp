#include "planner_svc/engine/owners_words.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace roci::planner::engine {

namespace {

std::string described(const std::string& name, const std::vector<Object>& objects) {
  const auto object = std::ranges::find(objects, name, &Object::name);
  if (object == objects.end() || object->properties.empty()) return name;
  std::string properties;
  for (const temporal::Property& property : object->properties) {
    std::string value = property.value;
    if (value.find('.') != std::string::npos) value.erase(value.find_last_not_of('0') + 1);
    if (value.ends_with('.')) value.pop_back();
    properties += (properties.empty() ? "" : " ") + property.name + "=" + value;
  }
  return name + " (" + properties + ")";
}

// What speaks against an object as the goal of a way.
struct Against {
  const FunctionUse* use =
      nullptr;         // null: each function has a value for some tuple with it, or nobody was asked
  bool proved = true;  // for every tuple with it the owner knows that there is no value
};

struct OneFunction {
  std::string name;
  std::optional<Against> against;  // none: some tuple has a value
};

// One function may have no value where another has: an arm that cannot carry a load there, and can go there without.
Against against(const std::string& object, std::span<const FunctionUse> uses) {
  std::vector<OneFunction> functions;  // as they were asked
  for (const FunctionUse& use : uses) {
    const auto& arguments = use.call.arguments;
    const bool of_others =
        std::ranges::any_of(arguments, [&](const std::string& one) { return one != object; });
    if (arguments.empty() || arguments.back() != object || !of_others) continue;
    auto function = std::ranges::find(functions, use.call.function, &OneFunction::name);
    if (function == functions.end())
      function = functions.insert(functions.end(), {use.call.function, Against{}});
    std::optional<Against>& out = function->against;
    if (use.answer.outcome == FunctionOutcome::value) out.reset();
    if (!out) continue;
    const bool proved = use.answer.outcome == FunctionOutcome::unreachable;
    if (out->use == nullptr || (out->proved && !proved)) out->use = &use;
    out->proved = out->proved && proved;
  }
  for (const OneFunction& function : functions)
    if (function.against) return *function.against;
  return {};
}

}  // namespace

OwnersWords words_against(const std::set<std::string>& named, const std::vector<Object>& objects,
                          std::span<const FunctionUse> uses) {
  for (const std::string& object : named) {
    const auto [use, proved] = against(object, uses);
    if (use == nullptr) continue;
    const Provenance& said = *use->answer.provenance;
    if (!proved)
      return {"no way to " + described(object, objects) + " is known: " + said.owner +
                  " found none with the effort spent (" + use->call.function + ", model " +
                  said.model_version + "), which proves nothing; ask again, or let it search longer",
              false};
    const std::string about = object + ": ";
    if (use->answer.reason.starts_with(about))
      return {described(object, objects) + ": " + use->answer.reason.substr(about.size()) + " (says " +
              said.owner + ", model " + said.model_version + ")"};
    return {described(object, objects) + " is unreachable (says " + said.owner + ", " + use->call.function +
            ", model " + said.model_version + ")"};
  }
  return {};
}

}  // namespace roci::planner::engine
