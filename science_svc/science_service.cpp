#include "science_svc/science_service.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/mission/mission_file.hpp"
#include "core/mission/scenario.hpp"
#include "core/terrain/map_error.hpp"
#include "core/terrain/site_file.hpp"
#include "science_svc/detector_file.hpp"
#include "science_svc/limits.hpp"
#include "science_svc/watch/watch_service.hpp"
#include "services/node/make_event.hpp"
#include "services/publisher.hpp"

namespace roci::science {
namespace {

namespace topics = services::topics;

v1::Property property(const std::string& name, double value) {
  v1::Property out;
  out.name(name);
  out.value(fmt::format("{}", value));
  return out;
}

class ScienceService final : public services::Service {
 public:
  ScienceService(services::Node& node, DetectorSettings settings, const terrain::Grid& map,
                 std::uint64_t seed)
      : node_(node),
        goal_kind_(settings.goal_kind),
        detector_(std::move(settings), map, seed),
        goals_(services::advertise(node, topics::goal)),
        events_(services::advertise(node, topics::event)) {
    services::subscribe(node, topics::data_product,
                        [this](const v1::DataProduct& product) { look(product); });
  }

 private:
  void look(const v1::DataProduct& product) {
    if (product.product_kind() != "image" || product.fate() != v1::PRODUCT_STORED) return;
    if (detector_.full()) return tell_full();
    const auto find = detector_.look({product.id(), {product.x_m(), product.y_m()}}, node_.now());
    if (!find) return;
    v1::Goal goal;
    goal.issuer(node_.options().name);
    goal.id(find->id);
    goal.goal_kind(goal_kind_);
    goal.arguments({property("x", find->place.x), property("y", find->place.y)});
    goal.importance(v1::GOAL_OPPORTUNISTIC);
    goal.utility({find->score});
    goal.preferred_us(-1);
    goals_.write(goal);
    events_.write(
        services::node::make_event(v1::SEVERITY_INFO, "science.find",
                                   fmt::format("{} shows something of interest (score {:.2f}) at ({}, {})",
                                               product.id(), find->score, find->place.x, find->place.y)));
  }

  // Told once.
  void tell_full() {
    if (std::exchange(full_told_, true)) return;
    events_.write(
        services::node::make_event(v1::SEVERITY_WARNING, "science.no_room",
                                   fmt::format("{} images were looked at, those to come are not", kPhotos)));
  }

  services::Node& node_;
  bool full_told_ = false;
  std::string goal_kind_;
  Detector detector_;
  services::Publisher<v1::Goal> goals_;
  services::Publisher<v1::Event> events_;
};

// Either may be missing.
struct DetectorAndWatch final : services::Service {
  std::unique_ptr<services::Service> detector, watch;
};

terrain::Grid map_of(const mission::Entry& site) {
  try {
    return terrain::load_site(site.resolve(site.text())).grid();
  } catch (const terrain::MapError& error) {
    throw mission::FileError(error.what());
  }
}

}  // namespace

std::unique_ptr<services::Service> make_service(services::Node& node, const services::RunSettings& settings) {
  const mission::Entry mission = mission::load_mission_file(settings.mission_file());
  const mission::Entry scenario = mission::load_scenario(settings.mission, settings.scenario);
  auto out = std::make_unique<DetectorAndWatch>();
  // Without its section there is no detector, and no map is needed.
  if (mission.find("science"))
    out->detector = std::make_unique<ScienceService>(node, read_detector(mission, scenario),
                                                     map_of(mission.at("site")), settings.seed);
  out->watch = watch::make_watch(node, mission);
  return out;
}

}  // namespace roci::science
