#include "planner_svc/engine/function_words.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>

namespace roci::planner::engine {

namespace {

std::string asked_of(const Provenance& said) {
  if (said.owner.empty()) return "";
  std::string text = "; asked " + said.owner;
  if (!said.model_version.empty()) {
    text += ", model " + said.model_version + ", at " +
            std::to_string(std::chrono::duration<double>(said.time).count()) + " s";
  }
  return text;
}

struct Those {
  const FunctionUse* first = nullptr;
  std::ptrdiff_t others = 0;
};

Those those_of(std::span<const FunctionUse> uses, FunctionOutcome outcome) {
  const auto has_it = [&](const FunctionUse& use) { return use.answer.outcome == outcome; };
  const auto first = std::ranges::find_if(uses, has_it);
  if (first == uses.end()) return {};
  return {&*first, std::ranges::count_if(uses, has_it) - 1};
}

}  // namespace

bool is_usable(const FunctionValue& answer) {
  return answer.outcome == FunctionOutcome::value || answer.outcome == FunctionOutcome::unreachable ||
         answer.outcome == FunctionOutcome::unknown;
}

std::string fault_of(const FunctionUse& use) {
  if (is_usable(use.answer)) return {};
  std::string text = "external function " + application(use.call) + " of module " + use.call.module + ": " +
                     to_string(use.answer.outcome);
  if (!use.answer.reason.empty()) text += ", " + use.answer.reason;
  return text + asked_of(*use.answer.provenance);
}

std::string remedy_of(const FunctionUse& use) {
  switch (use.answer.outcome) {
    case FunctionOutcome::unavailable:
    case FunctionOutcome::owner_lost:
      return "start the service that offers module " + use.call.module + ", or give the values in a file";
    case FunctionOutcome::late:
      return "give the owner more time, or declare fewer objects";
    case FunctionOutcome::unknown_object:
    case FunctionOutcome::wrong_arity:
      return "declare the function as its owner offers it, with objects that the owner knows";
    case FunctionOutcome::not_a_number:
      return "the owner must answer with a finite number or with 'unreachable'";
    case FunctionOutcome::value:
    case FunctionOutcome::unreachable:
    case FunctionOutcome::unknown:
      break;
  }
  return {};
}

std::string doubt_of(std::span<const FunctionUse> uses) {
  const auto [first, others] = those_of(uses, FunctionOutcome::unknown);
  if (first == nullptr) return {};
  const std::string& owner = first->answer.provenance->owner;
  std::string text =
      "not known: " + (owner.empty() ? "the owner" : owner) + " found no way for " + application(first->call);
  if (others > 0) text += " and " + std::to_string(others) + " more";
  return text + " with the effort spent; ask again or give it more";
}

std::string denial_of(std::span<const FunctionUse> uses) {
  const auto [first, others] = those_of(uses, FunctionOutcome::unreachable);
  if (first == nullptr) return {};
  return first->answer.provenance->owner + " says that there is no " + application(first->call) +
         (first->answer.reason.empty() ? "" : ", " + first->answer.reason) +
         (others > 0 ? ", and " + std::to_string(others) + " more" : "");
}

temporal::FunctionValueUse recorded(const FunctionUse& use) {
  std::uint64_t version = 0;
  const std::string& text = use.answer.provenance->model_version;
  std::from_chars(text.data(), text.data() + text.size(), version);
  return {use.call.function, use.call.arguments,          use.answer.value,   use.answer.provenance->owner,
          version,           use.answer.provenance->time, use.answer.accuracy};
}

}  // namespace roci::planner::engine
