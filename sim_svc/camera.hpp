#pragma once
#include <string>
#include <vector>

#include "sim_svc/surroundings.hpp"

namespace roci::sim {

/// image (image): a picture of what lies ahead, stored on board when done.
class Camera {
 public:
  explicit Camera(std::uint64_t seed);

  static std::string_view name() { return "camera"; }
  static std::vector<CommandForm> commands() { return {{"image", {"image"}}}; }

  State state() const { return busy() ? State{"imaging", {}} : State{"idle", {}}; }
  bool busy() const { return shot_.has_value(); }

  Ending begin(const Task&, Time now, Surroundings&);
  std::optional<Time> next_change() const;
  Ending finish(Surroundings&);
  void halt(Time) { shot_.reset(); }

  double energy_j(Time from, Time to) const { return busy() ? power_w_ * to_seconds(to - from) : 0; }
  double peak_power_w() const { return busy() ? power_w_ : 0; }

 private:
  struct Shot {
    std::string image;
    std::string source;
    Time end{};
  };
  std::optional<Shot> shot_;
  double power_w_ = 0;
  RandomStream noise_;
};

}  // namespace roci::sim
