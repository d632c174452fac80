#pragma once
#include <string>
#include <vector>

#include "sim_svc/surroundings.hpp"

namespace roci::sim {

/// send (image): an image on board goes out at the radio's rate, only while the window is open; when the
/// window closes before the end, the send fails and the image stays stored.
class Radio {
 public:
  explicit Radio(std::uint64_t seed);

  static std::string_view name() { return "radio"; }
  static std::vector<CommandForm> commands() { return {{"send", {"image"}}}; }

  State state() const { return busy() ? State{"sending", {}} : State{"idle", {}}; }
  bool busy() const { return transfer_.has_value(); }

  Ending begin(const Task&, Time now, Surroundings&);
  std::optional<Time> next_change() const;
  Ending finish(Surroundings&);
  void halt(Time) { transfer_.reset(); }

  double energy_j(Time from, Time to) const { return busy() ? power_w_ * to_seconds(to - from) : 0; }
  double peak_power_w() const { return busy() ? power_w_ : 0; }

 private:
  struct Transfer {
    std::string image;
    Time end{};
    bool cut_off = false;  // the window closes first
  };
  std::optional<Transfer> transfer_;
  double power_w_ = 0;
  RandomStream noise_;
};

}  // namespace roci::sim
