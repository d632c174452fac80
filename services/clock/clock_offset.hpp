// How far a host's clock is from the mission clock's, from exchanges of timestamps, and whether that is too
// far. Pure.
//
// Offset and delay of an exchange are those of the Network Time Protocol (Mills, RFC 5905, section 8); of the
// newest eight the one with the least error counts (its clock filter, section 10). The drift is the slope of a
// least-squares line through the best exchanges of the past. Every figure comes with a bound of its error that
// holds for any delays: half of the delay, and for the slope the same errors with the weights of the line.
#pragma once

#include <cstddef>
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/temporal/duration.hpp"

namespace roci::services::clock {

/// Holds the four times of one question and its answer, each by the clock of who noted it.
struct ClockExchange {
  temporal::Time asked{};     ///< own
  temporal::Time received{};  ///< of the mission clock
  temporal::Time answered{};  ///< of the mission clock
  temporal::Time heard{};     ///< own
};

/// Holds the own clock minus the mission clock, now.
struct ClockOffset {
  temporal::Duration offset{0};
  temporal::Duration error{0};  ///< the true offset is at most this far away
  double drift_ppm = 0;         ///< growth of the offset, microseconds per second
  double drift_error_ppm = std::numeric_limits<double>::infinity();  ///< infinite while nothing is known
};

/// Estimates offset and drift from exchanges, each with a bound of its error.
class OffsetEstimator {
 public:
  /// Bounds the assumed drift of a clock; a larger difference means that a clock was set.
  static constexpr double kFastestDriftPpm = 500;

  /// Takes an exchange; an impossible one (an answer before the question) changes nothing. After a step of
  /// either clock all earlier exchanges are forgotten.
  void add(const ClockExchange&);
  /// Returns the estimate, or nothing before the first exchange.
  std::optional<ClockOffset> estimate() const;

 private:
  struct Sample {
    temporal::Time at{};  // by the own clock, in the middle of the exchange
    double offset_us = 0;
    double error_us = 0;
  };
  static double error_at(const Sample&, temporal::Time);
  const Sample& best(temporal::Time now) const;
  void fit(ClockOffset&) const;

  static constexpr std::size_t kFilter = 8;    // exchanges
  static constexpr std::size_t kHistory = 64;  // best ones of kFilter each
  std::deque<Sample> newest_;
  std::deque<Sample> history_;
  std::size_t since_history_ = 0;
};

/// Bounds how far a host's clock may differ.
struct ClockBounds {
  temporal::Duration offset = std::chrono::milliseconds(250);
  double drift_ppm = 200;
};

/// Says when a clock goes beyond a bound and when it is back. Only what no error explains is beyond it, so
/// that a slow network alone raises nothing.
class ClockJudge {
 public:
  explicit ClockJudge(const ClockBounds& bounds) : bounds_(bounds) {}

  struct Change {
    std::string code;  ///< "clock.offset" or "clock.drift"
    bool beyond = false;
    std::string text;  ///< for people: figure, error and bound
  };
  std::vector<Change> judge(const ClockOffset&);
  bool beyond() const { return offset_beyond_ || drift_beyond_; }

 private:
  ClockBounds bounds_;
  bool offset_beyond_ = false;
  bool drift_beyond_ = false;
};

}  // namespace roci::services::clock
