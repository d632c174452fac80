// The master of the simulated clock as a pure state machine: it says who acts next, and when.
//
// This is conservative parallel discrete-event simulation with a barrier (Fujimoto, Parallel and Distributed
// Simulation Systems, 2000, chapter 3). Time is superdense (Maler, Manna, Pnueli, 1992): at one time t the
// micro-steps k = 0, 1, … follow until no service has undelivered input or a wish that is due; then t jumps
// to the earliest wish.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/temporal/duration.hpp"
#include "roci_idl/clock.h"
#include "services/clock/clock_mode.hpp"
#include "services/clock/hold_back_queue.hpp"

namespace roci::services::clock {

inline constexpr std::uint32_t kMicroStepCap = 10'000;

/// Decides as a pure state machine which step comes next, from what the participants say of their inputs and
/// wishes.
class ClockMaster {
 public:
  ClockMaster(std::string name, std::vector<std::string> roster,
              std::uint32_t micro_step_cap = kMicroStepCap);

  /// Take what the participants say. Messages of older incarnations or steps change nothing. They return false for
  /// what finds no room (bounds/limits.hpp): a service that is new beside kPeers or after kRosterLosses deaths,
  /// which is not admitted; streams that are new beside kCountedStreams, which are not counted.
  bool ready(const v1::ClockReady&);
  bool done(const v1::ClockDone&);
  void lost(const std::string& service, std::uint32_t incarnation, const std::string& cause);
  /// Stops waiting for a service of the roster, which may still come.
  void excuse(const std::string& service) { std::erase(roster_, service); }

  /// Returns the services of the roster that are not there yet, or were lost.
  std::vector<std::string> missing() const;
  /// Returns the services that must still answer the open step.
  std::vector<std::string> awaited() const;
  bool member(const std::string& service) const { return members_.contains(service); }
  temporal::Time time() const { return time_; }

  /// Says when the next step may be issued: exactly at `earliest` or, if only input from outside asks for it,
  /// anywhere up to `latest`. There is no window while a step is open, the roster is incomplete or nobody
  /// wants to act.
  struct Window {
    temporal::Time earliest;
    temporal::Time latest;
  };
  std::optional<Window> window() const;

  /// Issues the next step, at a time in window(). Throws ClockError when a time has more micro-steps than the
  /// cap.
  v1::ClockStep issue(temporal::Time);
  /// Gives the open step again if a participant has died in it.
  std::optional<v1::ClockStep> take_revision();
  /// Ends the run; every member answers it.
  v1::ClockStep issue_last();

 private:
  struct Member {
    std::uint32_t incarnation = 0;
    std::set<std::string> subscriptions;
    bool input = false;    // samples that it has not been asked to deliver yet
    bool outside = false;  // it holds input from an observer
    bool owes = false;
    std::optional<temporal::Time> wish;
  };
  static bool hears(const Member&, const std::string& stream);
  void admit();
  void begin_step(temporal::Time);
  v1::ClockStep step() const;
  void forget_dead_streams();
  bool wants_to_act(const Member&, temporal::Time) const;
  std::string livelock() const;

  std::string name_;
  std::vector<std::string> roster_;
  std::uint32_t cap_;
  std::map<std::string, Member> members_;
  std::map<std::string, v1::ClockReady> waiting_;
  std::map<StreamKey, std::uint64_t> totals_;
  std::vector<v1::RosterLoss> losses_;
  std::size_t announced_ = 0;  // of losses_, in a step that all members act in
  std::size_t forgotten_ = 0;  // of losses_, with their streams
  std::vector<std::string> participants_;
  bool started_ = false;
  bool roster_changed_ = false;
  bool revise_ = false;
  bool last_ = false;
  temporal::Time time_{0};
  std::uint32_t micro_step_ = 0;
  std::uint32_t revision_ = 0;
};

}  // namespace roci::services::clock
