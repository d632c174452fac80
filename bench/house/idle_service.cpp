#include "bench/house/idle_service.hpp"

#include "services/publisher.hpp"

namespace roci::bench::house {
namespace {

using namespace std::chrono_literals;

class IdleService final : public services::Service {
 public:
  explicit IdleService(services::Node& node) : node_(node) {
    services::subscribe(node, services::topics::observation, [](const v1::Observation&) {});
    services::subscribe(node, services::topics::mission_status, [](const v1::MissionStatus&) {});
    services::subscribe(node, services::topics::event, [](const v1::Event&) {});
    tick();
  }

 private:
  void tick() {
    node_.after(10s, [this] { tick(); });
  }

  services::Node& node_;
};

}  // namespace

std::unique_ptr<services::Service> make_idle_service(services::Node& node, const services::RunSettings&) {
  return std::make_unique<IdleService>(node);
}

}  // namespace roci::bench::house
