// This is a camera on a lander that looks for places to dig and to sample, and takes panoramas.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim_svc/components/phased_component.hpp"
#include "sim_svc/components/products.hpp"
#include "sim_svc/world/random_stream.hpp"

namespace roci::sim::components {

/// Holds what one of the camera's commands takes.
struct Survey {
  double duration_s = 3600;
  double power_w = 60;
  double heat_w = 20;  ///< of it, left in the camera's zone
};

/// Holds the settings of a survey camera (README.md); noises are standard deviations, as shares.
struct SurveyCameraSettings {
  std::string zone;  ///< thermal zone of the robot in which it works; empty: it is always warm
  std::map<std::string, Survey> surveys{
      {"find_sites", {7200}}, {"find_targets", {}}, {"panorama", {3600, 40, 15}}};
  double duration_noise = 0.05;
  double duration_factor = 1;
  double power_noise = 0.05;
  std::map<std::string, double> values;  ///< <site> → what the place is truly worth by its looks
  std::map<std::string, double> visual;  ///< <site>_<target> → the same of a target
  std::map<std::string, std::vector<ProductForm>> products;  ///< by command
};

/// Simulates a survey camera. It takes find_sites, find_targets (site) and panorama; each warms the zone first, and
/// makes the products of its settings. Results of find_sites are value_<site> of all sites, of find_targets
/// visual_<site>_<target> of the site's; a site of which it knows no value is refused as `unknown-site`, if it knows
/// that of any.
class SurveyCamera final : public PhasedComponent {
 public:
  SurveyCamera(SurveyCameraSettings, world::RandomStream noise);

  std::vector<world::CommandForm> commands() const override { return forms(); }
  static std::vector<world::CommandForm> forms() {
    return {{"find_sites", {}}, {"find_targets", {"site"}}, {"panorama", {}}};
  }
  std::vector<world::StateForm> state_forms() const override { return {{"idle"}, {"surveying", 1}}; }
  /// Returns idle or surveying (command).
  temporal::State state() const override;

  world::Ending begin(const world::Task&, temporal::Time now, world::Surroundings&) override;
  world::Ending finish(world::Surroundings&) override;
  void halt(temporal::Time now, world::Surroundings&) override;
  std::map<std::string, temporal::Value> results() const override { return results_; }

 private:
  SurveyCameraSettings settings_;
  world::RandomStream noise_;
  std::optional<world::Task> run_;
  std::map<std::string, temporal::Value> results_;
};

}  // namespace roci::sim::components
