#include "core/pddl/diagnostic_log.hpp"

#include <algorithm>

namespace roci::pddl {

void DiagnosticLog::error(SourceLocation where, std::string message, std::string remedy) {
  add({file_, where, std::move(message), std::move(remedy)});
}

void DiagnosticLog::unsupported(SourceLocation where, std::string message, std::string remedy) {
  add({file_, where, std::move(message), std::move(remedy), Severity::unsupported});
}

void DiagnosticLog::warn(Departure departure, SourceLocation where, std::string message, std::string remedy) {
  add({file_, where, std::move(message), std::move(remedy), Severity::warning, departure});
}

void DiagnosticLog::add(Diagnostic diagnostic) {
  if (strictness_ == Strictness::strict && diagnostic.severity == Severity::warning)
    diagnostic.severity = Severity::error;
  if (diagnostic.severity != Severity::warning) ++errors_;
  Alike& alike = alike_[diagnostic.message];
  if (++alike.count <= kMostAlike) {
    alike.last = kept_.size();
    kept_.push_back(std::move(diagnostic));
  }
  if (full()) throw_errors();
}

std::vector<Diagnostic> DiagnosticLog::told(bool warnings) const {
  std::vector<Diagnostic> out;
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    if ((kept_[i].severity == Severity::warning) != warnings) continue;
    out.push_back(kept_[i]);
    const Alike& alike = alike_.at(kept_[i].message);
    if (alike.last == i && alike.count > kMostAlike)
      out.back().message += ", and so in " + std::to_string(alike.count - kMostAlike) + " more places";
  }
  std::ranges::stable_sort(out, {}, &Diagnostic::where);
  return out;
}

void DiagnosticLog::throw_errors() const {
  if (errors_ > 0) throw ParseError(told(false));
}

std::vector<Diagnostic> DiagnosticLog::warnings() const { return told(true); }

}  // namespace roci::pddl
