#include "logbook_service.hpp"

#include <fstream>
#include <string>

#include "services/publisher.hpp"
#include "services/topics/topics.hpp"

namespace borehole {
namespace {

namespace services = roci::services;
namespace topics = roci::services::topics;
namespace v1 = roci::v1;

class Logbook final : public services::Service {
 public:
  Logbook(services::Node& node, const services::RunSettings& settings) : node_(node) {
    if (!settings.run_folder.empty()) file_.open(settings.run_folder / "logbook.txt", std::ios::app);
    services::subscribe(node, topics::event,
                        [this](const v1::Event& event) { write(event.code() + ": " + event.text()); });
    services::subscribe(node, topics::command_ack, [this](const v1::CommandAck& ack) {
      static constexpr const char* kStages[] = {"accepted",  "rejected",      "completed", "failed",
                                                "cancelled", "cancel_failed", "unknown"};
      write(ack.owner() + " says " + kStages[ack.stage()] + " " + ack.code() + " to " + ack.activity());
    });
  }

 private:
  void write(const std::string& line) {
    file_ << static_cast<double>(node_.now().count()) / 1e6 << " s  " << line << std::endl;
  }

  services::Node& node_;
  std::ofstream file_;
};

}  // namespace

std::unique_ptr<services::Service> make_logbook(services::Node& node, const services::RunSettings& settings) {
  return std::make_unique<Logbook>(node, settings);
}

}  // namespace borehole
