#pragma once
#include <map>
#include <string>
#include <vector>

#include "sim_svc/surroundings.hpp"

namespace roci::sim {

/// pick (sample, place) and drop (sample, place). A sample that nobody touched lies where the first pick
/// looks for it.
class Gripper {
 public:
  explicit Gripper(std::uint64_t seed);

  static std::string_view name() { return "gripper"; }
  static std::vector<CommandForm> commands() {
    return {{"pick", {"sample", "place"}}, {"drop", {"sample", "place"}}};
  }

  State state() const;
  bool busy() const { return work_.has_value(); }
  /// in-place (place), held, dropped (place); by sample, once touched.
  const std::map<std::string, State>& samples() const { return samples_; }

  Ending begin(const Task&, Time now, Surroundings&);
  std::optional<Time> next_change() const;
  Ending finish(Surroundings&);
  /// Opens (pick) or keeps hold (drop): as before the work.
  void halt(Time) { work_.reset(); }

  double energy_j(Time from, Time to) const { return busy() ? power_w_ * to_seconds(to - from) : 0; }
  double peak_power_w() const { return busy() ? power_w_ : 0; }

 private:
  struct Work {
    bool pick = true;
    std::string sample;
    std::string place;
    Time end{};
  };
  Ending begin_pick(const Task&);
  Ending begin_drop(const Task&) const;

  std::optional<std::string> held_;
  std::optional<Work> work_;
  std::map<std::string, State> samples_;
  double power_w_ = 0;
  RandomStream noise_;
};

}  // namespace roci::sim
