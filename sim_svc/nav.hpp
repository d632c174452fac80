#pragma once
#include <map>
#include <string>
#include <vector>

#include "sim_svc/surroundings.hpp"

namespace roci::sim {

/// Drives: drive (to, x, y) asks for a path and follows it; a stop on the way leaves the rover at `here`.
/// Before a hidden rock it stands, looks, and asks for a path around.
class Nav {
 public:
  Nav(const Pose& start, const RobotNames&, std::uint64_t seed);

  static std::string_view name() { return "nav"; }
  static std::vector<CommandForm> commands() { return {{"drive", {"to", "x", "y"}}}; }

  const Pose& pose() const { return pose_; }
  State state() const;
  bool busy() const { return target_.has_value(); }
  bool waits_for_path() const { return busy() && !trace_ && !looks_until_; }

  Ending begin(const Task&, Time now, Surroundings&);
  /// Starts the wheels.
  Ending follow(std::vector<terrain::Point> way, Time now, Surroundings&);
  /// The ground changed: the rest of a running drive is worked out anew.
  void look_again(Time now, Surroundings&);
  std::optional<Time> next_change() const;
  /// At next_change(): the drive ends, or goes on another way (it is still busy() then).
  Ending finish(Surroundings&);
  /// Breaks off; the rover stands still at once.
  void halt(Time now);
  /// Brings pose() up to `now`.
  void settle(Time now);

  double energy_j(Time from, Time to) const;
  double peak_power_w() const { return trace_ ? trace_->peak_power_w : 0; }

 private:
  struct Target {
    ActivityKey key;
    std::string place;
    double x = 0;
    double y = 0;
  };

  void stand(std::string place);
  Output wish() const { return PathWanted{target_->key, pose_, target_->x, target_->y}; }
  std::string see_rock(const DriveTrace&, Surroundings&);

  Pose pose_;
  std::string place_;
  std::string stop_place_;
  std::optional<Target> target_;
  std::optional<DriveTrace> trace_;
  std::optional<Time> looks_until_;
  double detours_ = 0;  // of the running drive
  std::vector<terrain::Point> way_;
  std::map<std::size_t, std::string> seen_rocks_;  // index into Ground::hidden_rocks -> published id
  RandomStream noise_;
};

}  // namespace roci::sim
