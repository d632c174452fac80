#include "core/pddl/source.hpp"

#include <algorithm>
#include <utility>

namespace roci::pddl {

namespace {

std::vector<Diagnostic> in_order(std::vector<Diagnostic> diagnostics) {
  std::ranges::stable_sort(diagnostics, {}, &Diagnostic::where);
  if (diagnostics.size() > ParseError::kMostTold) diagnostics.resize(ParseError::kMostTold);
  return diagnostics;
}

std::string text_of(const std::vector<Diagnostic>& diagnostics, std::size_t untold) {
  std::string text = to_text(diagnostics);
  if (untold > 0) text += "\nand " + std::to_string(untold) + " more";
  return text;
}

}  // namespace

const char* to_string(Departure departure) {
  switch (departure) {
    case Departure::none:
      break;
    case Departure::byte_order_mark:
      return "byte-order-mark";
    case Departure::odd_character:
      return "odd-character";
    case Departure::comma:
      return "comma";
    case Departure::question_mark:
      return "question-mark";
    case Departure::hyphen:
      return "hyphen";
    case Departure::outside_text:
      return "outside-text";
    case Departure::requirement_flag:
      return "requirement-flag";
    case Departure::missing_requirement:
      return "missing-requirement";
    case Departure::old_section:
      return "old-section";
    case Departure::number_type:
      return "number-type";
    case Departure::type_twice:
      return "type-twice";
    case Departure::type_under_itself:
      return "type-under-itself";
    case Departure::undeclared_type:
      return "undeclared-type";
    case Departure::undeclared_function:
      return "undeclared-function";
    case Departure::signature_twice:
      return "signature-twice";
    case Departure::object_twice:
      return "object-twice";
    case Departure::value_twice:
      return "value-twice";
    case Departure::hidden_variable:
      return "hidden-variable";
    case Departure::missing_goal:
      return "missing-goal";
    case Departure::domain_name:
      return "domain-name";
  }
  return "none";
}

std::string to_string(const Diagnostic& diagnostic) {
  std::string text = diagnostic.file;
  if (diagnostic.where.line > 0)
    text += ":" + std::to_string(diagnostic.where.line) + ":" + std::to_string(diagnostic.where.column);
  text += diagnostic.severity == Severity::warning ? ": warning: " : ": error: ";
  text += diagnostic.message;
  if (!diagnostic.remedy.empty()) text += " (" + diagnostic.remedy + ")";
  if (diagnostic.departure != Departure::none)
    text += std::string(" [") + to_string(diagnostic.departure) + "]";
  return text;
}

std::string to_text(std::span<const Diagnostic> diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics) text += (text.empty() ? "" : "\n") + to_string(diagnostic);
  return text;
}

ParseError::ParseError(Diagnostic diagnostic)
    : std::runtime_error(to_string(diagnostic)), diagnostics_{std::move(diagnostic)} {}

ParseError::ParseError(std::vector<Diagnostic> diagnostics, std::size_t untold)
    : std::runtime_error(text_of(in_order(diagnostics),
                                 untold + diagnostics.size() - std::min(diagnostics.size(), kMostTold))),
      diagnostics_(in_order(diagnostics)),
      untold_(untold + diagnostics.size() - diagnostics_.size()) {}

bool ParseError::unsupported() const {
  return std::ranges::count(diagnostics_, Severity::unsupported, &Diagnostic::severity) > 0;
}

}  // namespace roci::pddl
