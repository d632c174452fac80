// This is a grapple at the tool of an arm, and what it works on: a structure of slots that hold modules. It knows the
// truth (masses, blocked slots, latches that need a second try) and reports what the robot can know of it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim_svc/world/capabilities.hpp"
#include "sim_svc/world/component.hpp"
#include "sim_svc/world/random_stream.hpp"

namespace roci::sim::components {

/// Describes a place of the structure for one module.
struct SlotSettings {
  std::string pose;      ///< of the arm, from which the tool works on it
  bool blocked = false;  ///< nothing can be placed there; nobody knows before it is localized
};

/// Describes a module of the structure.
struct ModuleSettings {
  std::string slot;         ///< in which it is latched at the start
  double mass_kg = 0;       ///< as the robot is told
  double true_mass_kg = 0;  ///< as it is
  /// Holds the edges of its box along x, y and z of the tool that holds it; empty: a point.
  std::vector<double> size_m{};
  bool works = true;
  std::int64_t latch_tries = 1;  ///< that its latch needs when it is placed next
};

/// Holds the settings of a grapple (README.md); the noise is a standard deviation, as a share.
struct GrappleSettings {
  double localize_s = 40;
  double grasp_s = 60;
  double place_s = 60;
  double latch_s = 30;  ///< a further try of a latch
  double duration_noise = 0.03;
  double power_w = 20;
  std::string light;  ///< timeline of the window in which it can localize; empty: always
  std::map<std::string, SlotSettings> slots;
  std::map<std::string, ModuleSettings> modules;  ///< each in a slot of its own
};

/// Simulates a grapple: localize (slot) gives it a fix on a slot, which is lost when the arm moves; grasp (module,
/// slot) takes a module out, and place (module, slot) puts it in and latches it; both need a fix on the slot. The arm,
/// if there is one, rests at the slot's pose meanwhile. A latch that does not close is tried again (R146) as long as
/// there is time left.
class Grapple final : public world::Component,
                      public world::PayloadHolder,
                      public world::BodyInterlock,
                      public world::ManipulatorInterlock {
 public:
  Grapple(GrappleSettings, world::RandomStream noise);

  void meet(const world::ComponentSet&) override;
  std::vector<world::CommandForm> commands() const override {
    return {{"localize", {"slot"}}, {"grasp", {"module", "slot"}}, {"place", {"module", "slot"}}};
  }
  std::vector<world::StateForm> state_forms() const override {
    return {{"empty"}, {"holding", 1}, {"working"}};
  }
  std::vector<world::ThingForm> thing_forms() const override;
  std::vector<world::NamedForm> named_forms() const override { return {{"fix", {{"none"}, {"on", 1}}}}; }
  std::vector<std::string> awaited_windows() const override;
  /// Returns empty, holding (module) or working.
  temporal::State state() const override;
  bool busy() const override { return work_.has_value(); }
  std::optional<world::Payload> payload() const override;
  world::Ending forbids_driving() const override { return at_work(); }
  world::Ending forbids_reaching() const override { return at_work(); }

  world::Ending begin(const world::Task&, temporal::Time now, world::Surroundings&) override;
  std::optional<temporal::Time> next_change() const override;
  world::Ending finish(world::Surroundings&) override;
  /// Stops the work and leaves all as it was before.
  void halt(temporal::Time, world::Surroundings&) override { work_.reset(); }
  void settle(temporal::Time now, world::Body&) override;
  std::optional<std::string> spared_from(const world::Mishap&) const override;
  void suffer(const world::Mishap&, temporal::Time now, world::Surroundings&) override;

  double energy_j(temporal::Time from, temporal::Time to) const override;
  double peak_power_w() const override { return busy() ? settings_.power_w : 0; }
  /// Returns fix, module.<m>, health.<m> and slot.<s> as they are reported.
  std::vector<world::NamedState> states() const override;
  std::optional<std::uint64_t> states_version() const override;
  /// Returns, after a place, as `tries` how often the latch was tried.
  std::map<std::string, temporal::Value> results() const override { return results_; }
  world::Memory memory() const override;
  void restore(const world::Memory&) override;

 private:
  enum class Kind { localize, grasp, place };
  struct Work {
    Kind kind = Kind::localize;
    world::TaskKey key;
    std::optional<temporal::Time> latest_end;
    std::string module;
    std::string slot;
    temporal::Time end{};
    bool gets_dark = false;  // before it is done
    int tries = 0;           // of the latch that failed
  };
  struct Slot {
    SlotSettings settings;
    bool seen_blocked = false;
  };
  struct Module {
    ModuleSettings settings;
    temporal::State where;  // latched (slot), resting (slot) or held
  };

  world::Ending at_work() const;
  world::Ending refusal(const Work&) const;
  bool has_fix() const;
  bool at_pose_of(const std::string& slot) const;
  std::optional<std::string> module_in(const std::string& slot) const;
  void put(const std::string& module, temporal::State where);
  world::Ending see_blocked(const std::string& slot);
  world::Ending end_localize(const Work&, world::Surroundings&);
  world::Ending end_grasp(const Work&, world::Surroundings&);
  world::Ending end_place(Work, world::Surroundings&);

  GrappleSettings settings_;  // its slots and modules moved on to those below
  std::map<std::string, Slot> slots_;
  std::map<std::string, Module> modules_;
  const world::Manipulator* arm_ = nullptr;  // of the same robot; null: it has none
  std::optional<std::string> held_;
  std::optional<std::string> fix_;  // slot
  std::optional<Work> work_;
  std::map<std::string, temporal::Value> results_;
  std::uint64_t changes_ = 0;
  world::RandomStream noise_;
};

}  // namespace roci::sim::components
