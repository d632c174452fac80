#include "planner_svc/engine/function_words.hpp"

#include <algorithm>
#include <charconv>

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
  return text + asked_of(use.answer.provenance);
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
  const auto is_unknown = [](const FunctionUse& use) {
    return use.answer.outcome == FunctionOutcome::unknown;
  };
  const auto first = std::ranges::find_if(uses, is_unknown);
  if (first == uses.end()) return {};
  const auto count = std::ranges::count_if(uses, is_unknown);
  const std::string& owner = first->answer.provenance.owner;
  std::string text =
      "not known: " + (owner.empty() ? "the owner" : owner) + " found no way for " + application(first->call);
  if (count > 1) text += " and " + std::to_string(count - 1) + " more";
  return text + " with the effort spent; ask again or give it more";
}

temporal::FunctionValueUse recorded(const FunctionUse& use) {
  std::uint64_t version = 0;
  const std::string& text = use.answer.provenance.model_version;
  std::from_chars(text.data(), text.data() + text.size(), version);
  return {use.call.function, use.call.arguments,         use.answer.value,   use.answer.provenance.owner,
          version,           use.answer.provenance.time, use.answer.accuracy};
}

}  // namespace roci::planner::engine
