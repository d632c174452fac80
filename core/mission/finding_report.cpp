#include "core/mission/finding_report.hpp"

namespace roci::mission {

const char* to_string(Severity severity) { return severity == Severity::error ? "error" : "warning"; }

std::string report(const Finding& finding) {
  Finding line = finding;
  line.what = std::string(to_string(finding.severity)) + ": " + finding.what;
  return line.text() + "\n" + (finding.remedy.empty() ? "" : "    " + finding.remedy + "\n");
}

std::string report(const Findings& findings) {
  std::string out;
  for (const Finding& finding : findings.sorted()) out += report(finding);
  return out;
}

}  // namespace roci::mission
