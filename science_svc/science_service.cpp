#include "science_svc/science_service.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "core/mission/mission_file.hpp"
#include "core/mission/scenario.hpp"
#include "core/terrain/map_error.hpp"
#include "core/terrain/site_file.hpp"
#include "science_svc/detector_file.hpp"
#include "science_svc/limits.hpp"
#include "science_svc/picture.hpp"
#include "science_svc/watch/watch_service.hpp"
#include "services/log/log.hpp"
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
  ScienceService(services::Node& node, DetectorSettings settings, std::shared_ptr<const terrain::Site> site)
      : node_(node),
        started_(node.now()),
        enabled_(settings.enabled),
        goal_kind_(settings.goal_kind),
        detector_(std::move(settings), std::move(site)),
        goals_(services::advertise(node, topics::goal)),
        events_(services::advertise(node, topics::event)),
        crops_(services::advertise(node, topics::data_product)) {
    services::subscribe(node, topics::data_product,
                        [this](const v1::DataProduct& product) { look(product); });
    // What an earlier process raised stands in the executive's journal; the ids say the places.
    services::subscribe(node, topics::goal_status, [this](const v1::GoalStatus& status) {
      if (status.issuer() == node_.options().name) detector_.remember(status.id(), started_);
    });
  }

 private:
  void look(const v1::DataProduct& product) {
    const bool image = product.product_kind() == "image" || product.product_kind() == "panorama";
    if (!enabled_ || !image || product.fate() != v1::PRODUCT_STORED) return;
    if (detector_.full()) return tell_full();
    const auto photo = read(product);
    if (!photo) return;
    // An earlier process has looked at these already: they only show what ground looks like.
    if (product.created_us() < started_.count()) return detector_.learn(*photo);
    for (const Find& find : detector_.look(*photo, node_.now())) raise(find, product);
  }

  // Says so where there is nothing to look at.
  std::optional<Photo> read(const v1::DataProduct& product) {
    const auto& bytes = product.preview();
    const std::string name = product.id().substr(0, kNameBytesTold);
    try {
      const std::string_view file{reinterpret_cast<const char*>(bytes.data()), bytes.size()};
      return Photo{
          product.id(), {{product.x_m(), product.y_m()}, product.heading_rad()}, read_picture(file, name)};
    } catch (const terrain::MapError& error) {
      if (unreadable_told_ >= kUnreadableTold) return std::nullopt;
      ++unreadable_told_;
      events_.write(services::node::make_event(v1::SEVERITY_WARNING, "image.unreadable", error.what()));
    }
    return std::nullopt;
  }

  void raise(const Find& find, const v1::DataProduct& image) {
    v1::Goal goal;
    goal.issuer(node_.options().name);
    goal.id(find.id);
    goal.goal_kind(goal_kind_);
    goal.arguments({property("x", find.place.x), property("y", find.place.y)});
    goal.importance(v1::GOAL_OPPORTUNISTIC);
    goal.utility({find.score});
    goal.preferred_us(-1);
    goals_.write(goal);
    crops_.write(crop_of(find, image));
    events_.write(
        services::node::make_event(v1::SEVERITY_INFO, "science.find",
                                   fmt::format("{} shows something of interest (score {:.2f}) at ({}, {})",
                                               image.id(), find.score, find.place.x, find.place.y)));
  }

  v1::DataProduct crop_of(const Find& find, const v1::DataProduct& image) const {
    v1::DataProduct out;
    out.id("crop-" + find.id);
    out.product_kind("crop");
    out.source(image.id());
    out.bytes(find.crop.size());
    out.fate(v1::PRODUCT_STORED);
    out.tier(v1::TIER_DECISIONAL);
    out.created_us(node_.now().count());
    out.utility({find.score});
    out.x_m(find.place.x);
    out.y_m(find.place.y);
    out.heading_rad(image.heading_rad());
    out.preview({find.crop.begin(), find.crop.end()});
    return out;
  }

  // Told once.
  void tell_full() {
    if (std::exchange(full_told_, true)) return;
    events_.write(
        services::node::make_event(v1::SEVERITY_WARNING, "science.no_room",
                                   fmt::format("{} images were looked at, those to come are not", kPhotos)));
  }

  services::Node& node_;
  const temporal::Time started_;
  const bool enabled_;
  bool full_told_ = false;
  std::size_t unreadable_told_ = 0;
  std::string goal_kind_;
  Detector detector_;
  services::Publisher<v1::Goal> goals_;
  services::Publisher<v1::Event> events_;
  services::Publisher<v1::DataProduct> crops_;
};

// Either may be missing.
struct DetectorAndWatch final : services::Service {
  std::unique_ptr<services::Service> detector, watch;
};

// Returns the ground as the mission maps it, or nothing for a mission without a map.
std::shared_ptr<const terrain::Site> site_of(const mission::Entry& mission) {
  const auto site = mission.find("site");
  if (!site) return nullptr;
  try {
    return std::make_shared<terrain::Site>(terrain::load_site(site->resolve(site->text())));
  } catch (const terrain::MapError& error) {
    throw mission::FileError(error.what());
  }
}

}  // namespace

std::unique_ptr<services::Service> make_service(services::Node& node, const services::RunSettings& settings) {
  const mission::Entry mission = mission::load_mission_file(settings.mission_file());
  const mission::Entry scenario = mission::load_scenario(settings.mission, settings.scenario);
  auto out = std::make_unique<DetectorAndWatch>();
  if (mission.find("science")) {  // without its section there is no detector, and no map is needed
    DetectorSettings detector = read_detector(mission, scenario);
    for (const std::string& warning : detector.warnings) services::log::warning(warning);
    out->detector = std::make_unique<ScienceService>(node, std::move(detector), site_of(mission));
  }
  out->watch = watch::make_watch(node, mission);
  return out;
}

}  // namespace roci::science
