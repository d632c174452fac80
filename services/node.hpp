// A service's one door to the others: publishers, subscriptions, timers and calls, all on one event loop.
//
// Handlers run on the thread that calls run(), one at a time. Live, samples are handled as they come; under
// the simulated clock a handler sees the samples of one micro-step in the order (topic, sender, incarnation,
// sequence), so the same handlers give the same run on every transport. Handlers never block and never ask
// the system for time.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "services/time.hpp"

namespace roci::services {

enum class ClockMode {
  live,       // system clock, times `live_scale`
  simulated,  // follows the ClockStep of the run's master
  master,     // simulated, and this node is the master (sim_svc)
  observer,   // takes part in no barrier: consoles; now() is the newest stamp seen, timers run in wall time
};

struct MasterOptions {
  std::vector<std::string> roster;  // services that must be ready before time 0, this one included
  double pace = 0;                  // simulated seconds per wall second; 0: as fast as possible
  double hang_limit_s = 60;         // wall time after which a participant without progress counts as dead
  double restart_hold_s = 0;  // wall time for which mission time stands still so that a killed one may return
};

struct NodeOptions {
  std::string run;      // identity of the run; observers may leave it empty: they join the first that they hear
  std::string mission;  // its name
  std::string robot;    // that the service belongs to; empty: the team, the ground or the world
  std::string name;     // logical sender, unique in the run, e.g. "arm_svc"
  std::uint32_t incarnation = 1;  // how often this service was started in this run, from 1
  ClockMode clock = ClockMode::live;
  double live_scale = 1;
  std::int64_t epoch_unix_us = 0;  // live: mission time 0, the same for all services of a run
  double live_hang_limit_s = 5;    // live: a service without a heartbeat for this long counts as hung
  MasterOptions master;
  std::string vendor = "fastdds";  // reported in the heartbeat
};

// What a roster change looks like to a service; delivered in mission-time order like a sample.
struct PeerChange {
  std::string service;
  std::uint32_t incarnation = 0;
  bool alive = false;
  std::string cause;  // of a death: "killed", "hung", "left" or "restarted"
};

// Thrown by Node::run(): the clock's master died, it dropped this service, or it met a livelock.
class ClockError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The master is gone, and with it the run.
class ClockGone : public ClockError {
 public:
  using ClockError::ClockError;
};

class Transport;

// The untyped half that typed wrappers stand on; see publisher.hpp for Publisher<T> and subscribe<T>().
class Node {
 public:
  Node(NodeOptions, std::unique_ptr<Transport>);
  ~Node();
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  const NodeOptions& options() const;
  Time now() const;

  using TimerId = std::uint64_t;
  TimerId at(Time, std::function<void()>);  // at a past time: in the next turn of the loop
  TimerId after(Duration, std::function<void()>);
  void cancel(TimerId);

  // Called in each turn of the loop, before timers fire: four times a second at least, in wall time, also
  // while the simulated clock stands still.
  void on_turn(std::function<void()>);

  void on_peer_change(std::function<void(const PeerChange&)>);
  bool peer_alive(std::string_view service) const;

  // Lets a worker thread hand a result to the loop. Under the simulated clock the loop does not answer its
  // barrier between begin_work() and the end of the posted function, and results run in the order in which
  // their works began, so that a worker's result has one place in mission time. post_work_result may be
  // called from any thread.
  using WorkId = std::uint64_t;
  WorkId begin_work();
  void post_work_result(WorkId, std::function<void()>);

  // The master ends the run for every participant; elsewhere only this node's loop. Any thread may call it.
  void stop();
  // Until stop() or the master's last step. Under the simulated clock all subscriptions are made before
  // run(). Throws ClockError; an exception of a handler passes through.
  void run();
  // Live and observer nodes: handles what is pending, waits at most `wait` of wall time for something to
  // handle.
  void spin_once(std::chrono::milliseconds wait);

  class Impl;
  Impl& impl() { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace roci::services
