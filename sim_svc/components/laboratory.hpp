// This is a laboratory on board, whose instruments analyse a sample one after the other and say whether it
// has a signature of life.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim_svc/components/phased_component.hpp"
#include "sim_svc/components/products.hpp"
#include "sim_svc/world/capabilities.hpp"
#include "sim_svc/world/random_stream.hpp"

namespace roci::sim::components {

/// Holds what one instrument takes for a sample.
struct Instrument {
  std::string name;
  double duration_s = 0;
  double power_w = 0;
  double heat_w = 0;  ///< of it, left in the laboratory's zone
};

/// Says what is truly in a sample.
enum class Signature { negative, positive, drawn };

/// Holds the settings of a laboratory (README.md); noise is a standard deviation, as a share.
struct LaboratorySettings {
  std::string zone;  ///< thermal zone of the robot in which it works; empty: it is always warm
  std::vector<Instrument> instruments{{"mass-spectrometer", 5400, 120, 40},
                                      {"microscope", 1800, 30, 15},
                                      {"raman-spectrometer", 2700, 60, 20}};
  double duration_noise = 0.05;
  double duration_factor = 1;
  double power_noise = 0.05;
  std::map<std::string, Signature> signatures;  ///< <site>_<target> → the truth
  double positive_share = 0.5;                  ///< of those that are drawn by the seed
  /// Lists the products of an analysis, by its form; empty: none, in any form.
  std::map<std::string, std::vector<ProductForm>> products;
  double positive_content = 1.2;  ///< bytes of what holds a signature, as against what holds none
};

/// Simulates a laboratory. It takes analyze (site, target, form) of the sample that a SampleCarrier has brought to its
/// inlet; another sample, or none, is refused as `no-sample`, and one that it has no truth of as `unknown-sample`; so
/// is an `unknown-form`. When it ends, the signature is known and the form's products are on board; it fails
/// `data-full` for those without room there.
class Laboratory final : public PhasedComponent {
 public:
  Laboratory(LaboratorySettings, world::RandomStream noise);

  std::vector<world::CommandForm> commands() const override {
    return {{"analyze", {"site", "target", "form"}}};
  }
  std::vector<world::StateForm> state_forms() const override { return {{"idle"}, {"analyzing", 3}}; }
  std::vector<world::ThingForm> thing_forms() const override {
    return {{"signature", {{"unknown"}, {"negative"}, {"positive"}}}};
  }
  /// Returns idle or analyzing (site, target, instrument).
  temporal::State state() const override;

  world::Ending begin(const world::Task&, temporal::Time now, world::Surroundings&) override;
  world::Ending finish(world::Surroundings&) override;
  void halt(temporal::Time now, world::Surroundings&) override;

  /// Returns signature.<site>_<target> (unknown, negative, positive) of all samples of which it has the truth.
  std::vector<world::NamedState> states() const override;
  std::optional<std::uint64_t> states_version() const override { return found_.size(); }
  world::Memory memory() const override;
  void restore(const world::Memory&) override;

 private:
  struct Run {
    world::Task task;
    world::SampleOrigin sample;
  };

  LaboratorySettings settings_;
  world::RandomStream noise_;
  std::optional<Run> run_;
  std::map<std::string, bool> positive_;  // the truth, by <site>_<target>
  std::map<std::string, bool> found_;     // what is known of it
};

}  // namespace roci::sim::components
