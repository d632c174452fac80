// This is a drive on wheels along way-points over the true ground, which the map does not show in full.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sim_svc/components/drive_motion.hpp"
#include "sim_svc/world/capabilities.hpp"
#include "sim_svc/world/component.hpp"

namespace roci::sim::components {

/// Holds the settings of a drive (README.md).
struct DriveSettings {
  DriveParameters motion;
  SoilSensorSettings soil_sensor;        ///< has no instruments by default
  double detours = 0;                    ///< rocks that one drive looks at and asks a way around
  double look_s = 20;                    ///< a look at such a rock takes this long
  bool own_map = false;                  ///< what it finds goes on its robot's own map alone
  std::string planner = "pathplan_svc";  ///< the service that is asked for paths
  /// Names where the body stands at the start and after a stop on the way.
  std::string stop_place = "here";
};

/// Bounds the points of a way that a command brings.
inline constexpr std::size_t kGivenPoints = 64;

/// Drives on wheels: drive (to, x, y) asks for a path and follows it; drive (to, way) drives over the points of that
/// text (core/terrain/way.hpp) instead, asks nobody, and makes no detours. A stop on the way leaves the body at
/// the stop place. Before a hidden rock it stands, looks, and asks for a path around (a repair of its own,
/// R146), as long as there are detours and time left. turn (x, y) turns in place until it heads for that point. In soil
/// that does not bear it the body digs itself in (`bogged-down`) and drives no more. With a soil sensor it ends `no-go`
/// where another vehicle must not follow, and marks a circle there.
class Drive final : public world::Component, public world::Mobility {
 public:
  /// Starts with the body at the stop place; it must have a pose, and the world a site.
  Drive(DriveSettings, world::RandomStream noise);

  std::vector<world::CommandForm> commands() const override {
    return {{"drive", {"to", "x", "y"}, "way", {"x", "y"}}, {"turn", {"x", "y"}}};
  }
  std::vector<world::StateForm> state_forms() const override { return {{"idle-at", 1}, {"going-to", 1}}; }
  /// Returns idle-at (place) or going-to (place): while it turns, the place where it stands.
  temporal::State state() const override;
  bool busy() const override { return target_.has_value(); }
  std::optional<std::string> place() const override;

  world::Ending begin(const world::Task&, temporal::Time now, world::Surroundings&) override;
  std::optional<temporal::Time> next_change() const override;
  world::Ending finish(world::Surroundings&) override;
  void halt(temporal::Time now, world::Surroundings&) override;
  bool waits_for_answer() const override { return busy() && !trace_ && !looks_until_; }
  world::Ending answer(const world::Answer&, temporal::Time now, world::Surroundings&) override;
  void settle(temporal::Time now, world::Body&) override;
  /// Computes the rest of a running drive anew.
  void ground_changed(temporal::Time now, world::Surroundings&) override;

  double energy_j(temporal::Time from, temporal::Time to) const override;
  double peak_power_w() const override { return trace_ ? trace_->peak_power_w : 0; }
  bool moves() const override { return next_change().has_value(); }
  /// Returns as `detours` how many rocks the drive went around; of a body with wheels also, since the last detour, the
  /// deepest `sinkage` in soil (m) and the largest `soil_slip`; with a soil sensor `soil_samples`,
  /// and the least `soil_margin`.
  std::map<std::string, temporal::Value> results() const override;
  world::Memory memory() const override;
  void restore(const world::Memory&) override;

 private:
  struct Target {
    world::TaskKey key;
    std::optional<temporal::Time> latest_end;
    std::string place;
    double x = 0;
    double y = 0;
    bool turns = false;  // in place, towards (x, y)
    bool given = false;  // the command brings its way
  };

  void stand(std::string place);
  void ask(world::Surroundings&) const;
  std::string see_rock(const DriveTrace&, world::Surroundings&);
  void simulate(temporal::Time now, const world::Pose& from, std::size_t first, const world::Ground&);
  world::Failure mark_soil(const DriveTrace&, world::Surroundings&);
  bool looks_around(const DriveTrace&, const std::string& rock, world::Surroundings&);

  DriveSettings settings_;
  std::string place_;
  std::optional<Target> target_;
  std::optional<DriveTrace> trace_;
  std::optional<temporal::Time> looks_until_;
  double detours_ = 0;  // of the running drive
  double last_detours_ = 0;
  bool bogged_ = false;   // for good
  double sinkage_m_ = 0;  // of the drive that ended last
  double soil_slip_ = 0;
  std::vector<terrain::Point> way_;
  std::set<std::size_t> seen_rocks_;  // indices into Ground::hidden_rocks
  std::vector<MarkedDisc> marked_;    // as No-Go, by this process
  SoilRecord soil_;                   // of the drive that ended last
  world::RandomStream noise_;
  world::RandomStream soil_noise_;
};

}  // namespace roci::sim::components
