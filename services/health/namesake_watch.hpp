// The namesake watch notices that another process of the run goes by this service's name: a second simulator, a second
// lone executive, a second owner of a subsystem. It says which of the two goes on. It is pure; its time is wall time.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "roci_idl/health.h"
#include "services/clock/wall.hpp"
#include "services/health/failure_detector.hpp"

namespace roci::services::health {

/// Ends this process, since another one has its name. A new start, as a later incarnation, may prevail.
class Superseded : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Decides which of two processes of one name goes on, the same in both: the later incarnation; of equal ones the one
/// on the host that comes first by name, and there the one with the lower process id. A namesake counts only when it
/// has been heard kBeats times over kHeardFor, so that a forged heartbeat ends nobody.
class NamesakeWatch {
 public:
  static constexpr int kBeats = 4;
  static constexpr clock::WallDuration kHeardFor = std::chrono::milliseconds(700);
  /// Bounds the believable difference of incarnations.
  static constexpr std::uint32_t kIncarnationJump = FailureDetector::kIncarnationJump;
  /// Bounds the namesakes that are watched at a time.
  static constexpr std::size_t kMost = 8;

  enum class Precedence {
    nothing,  ///< it is this process, or not heard for long enough, or told before
    goes_on,  ///< the namesake ends; operators are to be told of it
    yields,   ///< this process must end
  };

  /// Watches for namesakes of `self`: its service, incarnation, host and process id.
  explicit NamesakeWatch(v1::Heartbeat self) : self_(std::move(self)) {}

  /// Takes a heartbeat of this run.
  Precedence hear(const v1::Heartbeat& beat, clock::WallTime now);

 private:
  struct Namesake {
    clock::WallTime first;
    clock::WallTime last;
    int beats = 0;
    bool told = false;
  };
  bool wins(const v1::Heartbeat& other) const;

  v1::Heartbeat self_;
  std::map<std::pair<std::string, std::int32_t>, Namesake> namesakes_;  // by host and process id
};

/// Returns "arm_svc on rover, process 17".
std::string process_text(const v1::Heartbeat& beat);

}  // namespace roci::services::health
