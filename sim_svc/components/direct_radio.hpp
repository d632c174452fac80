// This is a radio that speaks to Earth without a relay: it is warmed and pointed, waits for contact, and
// sends the data on board.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sim_svc/components/hollow_commands.hpp"
#include "sim_svc/world/component.hpp"
#include "sim_svc/world/random_stream.hpp"

namespace roci::sim::components {

/// Holds the settings of a direct radio (README.md); noises are standard deviations, as shares.
struct DirectRadioSettings {
  std::string zone;  ///< thermal zone of the robot in which it works; empty: it is always warm
  std::string window = "earth.window";  ///< timeline that says when Earth is in view
  double prepare_s = 900;               ///< to point the antenna, once it is warm
  double prepare_w = 60;
  double rate_byte_s = 6250;
  double rate_noise = 0.03;  ///< drawn for each product
  double send_w = 120;
  double receive_s = 1800;  ///< in contact
  double receive_w = 40;
  double wait_w = 10;        ///< while it warms up, or waits for contact
  double waste_share = 0.3;  ///< of what it draws, left as heat in its zone
  double duration_noise = 0.05;
  double duration_factor = 1;
  /// Bounds a downlink that no schedule names; 0: until its step must end.
  double session_s = 0;
  double light_time_s = 0;  ///< after which the last byte of a product is received
};

/// Simulates a radio to Earth. prepare warms and points it. send waits for contact and then sends stored products,
/// each once and whole: the critical ones first, then those that the newest schedule names for this downlink, in its
/// order, and then it ends. Without a schedule products go by tier, then by age. receive needs contact for receive_s.
/// A task fails `too-cold` if its zone never becomes warm, `no-contact` if it has no contact until its step must end,
/// `contact-lost` if its window closes too early, and `out-of-time` if its step ends before all was sent. What was
/// sent by then stays sent.
class DirectRadio final : public world::Component {
 public:
  DirectRadio(DirectRadioSettings, world::RandomStream noise);

  std::vector<world::CommandForm> commands() const override {
    return {{"prepare", {}}, {"send", {}}, {"receive", {}}};
  }
  std::vector<world::StateForm> state_forms() const override {
    return {{"idle"}, {"preparing"}, {"waiting"}, {"sending"}, {"receiving"}};
  }
  std::vector<std::string> awaited_windows() const override { return {settings_.window}; }
  std::vector<std::string> zones() const override;
  std::string held_zone() const override { return run_ ? settings_.zone : ""; }
  temporal::State state() const override;
  bool busy() const override { return run_.has_value(); }

  world::Ending begin(const world::Task&, temporal::Time now, world::Surroundings&) override;
  std::optional<temporal::Time> next_change() const override;
  world::Ending finish(world::Surroundings&) override;
  void halt(temporal::Time now, world::Surroundings&) override;
  void hollow_next(const std::string& command) override { hollow_.add(command); }
  void heed(const world::DownlinkSchedule& schedule) override { schedule_ = schedule; }
  void change_rate(double factor, temporal::Time now) override;
  void surroundings_changed(temporal::Time now, world::Surroundings&) override;
  void settle(temporal::Time now, world::Body&) override;

  /// Lets data arrive, whatever the radio does meanwhile.
  std::optional<temporal::Time> next_routine() const override;
  void run_routine(temporal::Time now, bool able, world::Surroundings&) override;

  double energy_j(temporal::Time from, temporal::Time to) const override;
  double peak_power_w() const override;
  /// Returns the products and bytes of the downlink that has ended.
  std::map<std::string, temporal::Value> results() const override { return results_; }
  /// Returns what is on its way.
  world::Memory memory() const override;
  void restore(const world::Memory&) override;

 private:
  // A product to be sent, and under which name the schedule means it, if it does.
  struct Choice {
    const world::Product* product = nullptr;
    std::string name{};
  };
  struct Transfer {
    std::string product;
    std::string name;
    double bytes = 0;  // left at `since`
    double rate_noise = 1;
    temporal::Time since{};
  };
  struct Run {
    world::TaskKey key;
    std::string command;
    temporal::Time latest_end = temporal::Time::max();
    temporal::Time session_end = temporal::Time::max();  // of a downlink without a schedule
    double work_s = 0;                                   // of prepare and receive
    bool working = false;                                // it is warm, and in contact where it must be
    std::optional<temporal::Time> warm{};                // when its zone will be; nothing: never
    std::optional<temporal::Time> turn{};                // when contact begins or ends; nothing: never
    temporal::Time work_end{};                           // of prepare and receive, while it works
    std::optional<Transfer> transfer{};
    std::optional<temporal::Time> look_at{};  // then what it waits for is looked at again
    bool hollow = false;                      // nothing of what it sends arrives
    std::set<std::string> hollow_sent{};      // what it believes to have sent
    std::set<std::string> names_sent{};       // of the schedule
    std::size_t products = 0;
    double bytes = 0;
    temporal::Time at{};  // of the newest step
  };

  world::Ending go_on(temporal::Time now, world::Surroundings&);
  world::Ending go_on_sending(temporal::Time now, world::Surroundings&);
  world::Ending end(world::Ending, temporal::Time now, world::Surroundings&);
  bool needs_contact() const { return run_->command != "prepare"; }
  void look_around(temporal::Time now, const world::Surroundings&);
  void set_waste(temporal::Time now, world::Body&) const;
  void note_sent(temporal::Time now, world::Surroundings&);
  // The products that the schedule names for this downlink, in order; null: it names none.
  const std::vector<std::string>* named() const;
  Choice next_product(const world::Body&) const;
  Choice next_named(const world::DataStore&) const;
  bool open(const world::Product&) const;
  double rate_byte_s(const Transfer&) const;
  temporal::Time end_of(const Transfer&) const;
  double power_w() const;

  DirectRadioSettings settings_;
  world::RandomStream noise_;
  std::optional<Run> run_;
  bool in_contact_ = false;  // at the newest look
  HollowCommands hollow_;
  world::DownlinkSchedule schedule_;
  double rate_factor_ = 1;
  std::map<std::string, temporal::Time> arriving_;  // product → when its last byte is received
  std::map<std::string, temporal::Value> results_;
};

}  // namespace roci::sim::components
