// The time watch compares the clock of a live service's host with the mission clock, by questions and answers
// over DDS.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "services/clock/clock_offset.hpp"
#include "services/node.hpp"
#include "services/publisher.hpp"

namespace roci::services {

/// Says with whose clock a host's clock is compared, how often, and by how much it may differ.
struct TimeWatchSettings {
  std::string reference{};      ///< service whose clock is the mission clock; empty: nothing is compared
  clock::ClockBounds bounds{};  ///< in mission time
  double period_s = 1;          ///< seconds between questions
};

/// Answers in the reference's own process, and asks in every other. A service whose clock is beyond a bound goes
/// on as degraded: its heartbeats say SERVICE_DEGRADED, and an event (`clock.offset`, `clock.drift`) names figure
/// and bound; another one tells when it is back within. Under the simulated clock, and in observers, it does
/// nothing. It must live as long as the node's loop runs.
class TimeWatch {
 public:
  TimeWatch(Node&, TimeWatchSettings);
  TimeWatch(const TimeWatch&) = delete;
  TimeWatch& operator=(const TimeWatch&) = delete;

 private:
  void ask();
  void answer(const v1::TimeProbe& question);
  void hear(const v1::TimeProbe& answer);
  void report(const clock::ClockJudge::Change&, const clock::ClockOffset&);

  Node& node_;
  TimeWatchSettings settings_;
  Publisher<v1::TimeProbe> probes_;
  Publisher<v1::Event> events_;
  clock::OffsetEstimator estimator_;
  clock::ClockJudge judge_;
  std::vector<clock::ClockJudge::Change> changes_;  // changes that nobody could have heard of yet
  std::uint64_t asked_ = 0;
  std::uint64_t heard_ = 0;  // the newest question that was answered
};

}  // namespace roci::services
