// This is a radio that sends images to the other side as long as the window to it is open.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim_svc/world/component.hpp"
#include "sim_svc/world/random_stream.hpp"

namespace roci::sim::components {

/// Holds the settings of a radio (README.md); the noise is a standard deviation, as a share.
struct RadioSettings {
  double rate_bit_s = 98000;
  double rate_noise = 0.02;
  double power_w = 25;
  std::string window = "comm.window";  ///< timeline that says when the other side is in view
};

/// Simulates a radio: send (image) sends an image on board at the radio's rate, only while the window is
/// open; when the window closes before the end, the send fails and the image stays stored.
class Radio final : public world::Component {
 public:
  Radio(RadioSettings, world::RandomStream noise);

  std::vector<world::CommandForm> commands() const override { return {{"send", {"image"}}}; }
  std::vector<world::StateForm> state_forms() const override { return {{"idle"}, {"sending"}}; }
  std::vector<std::string> awaited_windows() const override { return {settings_.window}; }
  /// Returns idle or sending.
  temporal::State state() const override;
  bool busy() const override { return transfer_.has_value(); }

  world::Ending begin(const world::Task&, temporal::Time now, world::Surroundings&) override;
  std::optional<temporal::Time> next_change() const override;
  world::Ending finish(world::Surroundings&) override;
  void halt(temporal::Time, world::Surroundings&) override { transfer_.reset(); }

  void surroundings_changed(temporal::Time now, world::Surroundings&) override;

  double energy_j(temporal::Time from, temporal::Time to) const override;
  double peak_power_w() const override { return busy() ? settings_.power_w : 0; }

 private:
  struct Transfer {
    std::string image;
    temporal::Time end{};
    bool cut_off = false;  // the window closes first
  };

  RadioSettings settings_;
  std::optional<Transfer> transfer_;
  world::RandomStream noise_;
};

}  // namespace roci::sim::components
