// The events of a run, as the simulator tells them and as the scenario expects them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "roci_idl/health.h"
#include "services/node.hpp"
#include "services/publisher.hpp"
#include "sim_svc/scenario/event_order.hpp"

namespace roci::sim {

/// Tells events, and compares those of all processes with the order that the scenario expects.
class RunEvents {
 public:
  RunEvents(services::Node& node, const std::vector<scenario::ExpectedEvent>& expected);

  void tell(v1::Severity severity, const std::string& code, const std::string& text);
  /// Takes in an event that another process told.
  void hear(const v1::Event& event) { order_.note(event.code(), event.text()); }
  /// Tells whether all came as expected, and writes it to the run folder for whoever started the run; the summary takes
  /// it up as `expected`. Where nothing is expected, it does nothing.
  void report(const std::filesystem::path& run_folder);

 private:
  scenario::EventOrder order_;
  services::Publisher<v1::Event> events_;
};

}  // namespace roci::sim
