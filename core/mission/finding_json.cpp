#include "core/mission/finding_json.hpp"

#include <nlohmann/json.hpp>

#include "core/mission/finding_report.hpp"

namespace roci::mission {

nlohmann::ordered_json to_json(const Findings& findings) {
  auto out = nlohmann::ordered_json::array();
  for (const Finding& finding : findings.sorted())
    out.push_back({{"file", finding.file},
                   {"line", finding.line},
                   {"column", finding.column},
                   {"severity", to_string(finding.severity)},
                   {"what", finding.what},
                   {"remedy", finding.remedy}});
  return out;
}

}  // namespace roci::mission
