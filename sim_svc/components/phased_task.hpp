// The parts of a phased task come one after another, in a thermal zone that is warmed first.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim_svc/components/paced_work.hpp"
#include "sim_svc/world/body.hpp"
#include "sim_svc/world/values.hpp"

namespace roci::sim::components {

/// Describes one part of a task.
struct Phase {
  enum class Until { over, warm };
  Until until = Until::over;  ///< until so much work is done, or until the zone is warm enough to work
  double work_s = 0;          ///< at the usual pace
  double power_w = 0;         ///< drawn while it lasts, slowed or not
  double heat_w = 0;          ///< of it, left in the zone
  /// Returns the phase in which a task waits for its zone.
  static Phase warming() { return {Until::warm}; }
};

/// Runs the phases of one task after another. It keeps its zone warm for work from the beginning to the end of a task;
/// without a zone, or on a robot without heat, everything is warm.
class PhasedTask {
 public:
  /// `zone` is the name of a zone of the robot's body; empty: none.
  explicit PhasedTask(std::string zone) : zone_(std::move(zone)) {}
  // The zone knows it by its address.
  PhasedTask(const PhasedTask&) = delete;
  PhasedTask& operator=(const PhasedTask&) = delete;

  bool busy() const { return !phases_.empty(); }
  const std::string& zone() const { return zone_; }
  /// Begins with the first of the phases, of which there is at least one. Fails `too-cold`, and nothing runs, where the
  /// zone would never be warm enough.
  world::Ending begin(std::vector<Phase>, temporal::Time now, world::Body&);
  /// Replaces the running phase and those after it.
  void change_rest(std::vector<Phase>, temporal::Time now, world::Body&);
  /// Returns the index of the running phase.
  std::size_t phase() const { return at_; }
  /// Returns how much of the running phase is done, in s at the usual pace, and as a share.
  double done_s(temporal::Time now) const { return temporal::to_seconds(work_.done_by(now)); }
  double share(temporal::Time now) const { return work_.share_by(now); }
  /// Returns when the running phase ends, as things stand; nothing if it never does.
  std::optional<temporal::Time> next_change() const;
  /// Goes on to the next phase at next_change(). Returns false when there is none, and the task is over.
  bool go_on(world::Body&);
  void halt(temporal::Time now, world::Body&);
  void slow_down(double pace, temporal::Time until, temporal::Time now) { work_.slow_down(pace, until, now); }
  /// Computes anew when the zone will be warm.
  void settle(temporal::Time now, world::Body&);

  double energy_j(temporal::Time from, temporal::Time to) const;
  /// Returns the highest power of the running phase and of those after it.
  double peak_power_w() const;

 private:
  world::Thermal* heat(world::Body& body) const {
    return zone_.empty() || !body.thermal ? nullptr : &*body.thermal;
  }
  void enter(temporal::Time now, world::Body&);
  void leave(temporal::Time now, world::Body&);

  std::string zone_;
  std::vector<Phase> phases_;  // empty: nothing runs
  std::size_t at_ = 0;
  PacedWork work_;                      // of the running phase
  std::optional<temporal::Time> warm_;  // when the zone will be, while a phase waits for that
};

}  // namespace roci::sim::components
