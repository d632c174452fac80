#include "sim_svc/run_events_service.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "services/service.hpp"
#include "services/topics/topics.hpp"
#include "sim_svc/wire_service.hpp"

namespace roci::sim {

RunEvents::RunEvents(services::Node& node, const std::vector<scenario::ExpectedEvent>& expected)
    : order_(expected), events_(services::advertise(node, services::topics::event)) {}

void RunEvents::tell(v1::Severity severity, const std::string& code, const std::string& text) {
  events_.write(wire::event(severity, code, text));
  order_.note(code, text);
}

void RunEvents::report(const std::filesystem::path& run_folder) {
  if (order_.expected() == 0) return;
  const std::string fault = order_.final_fault();
  events_.write(fault.empty()
                    ? wire::event(v1::SEVERITY_INFO, "scenario.as_expected", "every event came as expected")
                    : wire::event(v1::SEVERITY_WARNING, "scenario.unexpected", fault));
  const nlohmann::json report{{"events", order_.expected()}, {"met", fault.empty()}, {"fault", fault}};
  std::ofstream(run_folder / services::kExpectedFile)
      << report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
}

}  // namespace roci::sim
