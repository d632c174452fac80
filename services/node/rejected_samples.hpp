// Refusals count the samples that reached no handler because of what they are, or because there was no room for them.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "roci_idl/health.h"
#include "services/bounds/tally.hpp"
#include "services/clock/wall.hpp"
#include "services/transport/transport.hpp"

namespace roci::services::node {
/// Says why a sample reached no handler.
enum class SampleRejection {
  malformed,     ///< It does not decode, or says what no sample of its type can say.
  too_large,     ///< It is larger than its topic allows (topics/topics.hpp).
  queue_full,    ///< The loop has not yet taken as many as may wait (bounds/limits.hpp).
  no_room,       ///< The table that it would have entered is full.
  another_name,  ///< In a secure run: it names a sender whose certificate its writer has not.
};

/// "malformed", "too large", …
const char* to_string(SampleRejection);
/// Counts rejected samples by topic and reason, and reports them in the log and by the event sample.refused.
class RejectedSamples {
 public:
  using Lookup = std::function<std::optional<transport::Participant>(const transport::Guid&)>;

  /// `lookup` names participants. `prepare` opens the topic of events, `tell` writes one `tell_after_s` of wall time
  /// later; both are called by turn() alone.
  RejectedSamples(std::string node, Lookup lookup, std::function<void()> prepare,
                  std::function<void(const v1::Event&)> tell, double tell_after_s);

  /// Counts a sample of the writer; any thread may call it.
  void note(const std::string& topic, SampleRejection, const transport::Guid& writer);
  /// The same where it is no longer known who wrote it.
  void note(const std::string& topic, SampleRejection why) { note(topic, why, {}); }
  std::uint64_t count(const std::string& topic, SampleRejection) const;

  /// Reports what is new; it is called in each turn of the loop.
  void turn(clock::WallTime now);

  /// Delays the event, live, by so much wall time after the log's line: by then readers of events are found. Under
  /// the simulated clock readers that are found later hear it, too.
  static constexpr double kTellAfterS = 1.5;

 private:
  struct New {
    std::string topic;
    SampleRejection why;
    transport::Guid writer;
    std::uint64_t count;
  };
  struct Untold {
    clock::WallTime due;
    v1::Event event;
  };
  std::string name_of(const transport::Guid&) const;
  v1::Event event_of(const New&) const;

  const std::string node_;
  const Lookup lookup_;
  const std::function<void()> prepare_;
  const std::function<void(const v1::Event&)> tell_;
  const double tell_after_s_;
  mutable std::mutex mutex_;
  bounds::Tally tally_;
  std::vector<New> news_;
  std::deque<Untold> untold_;
};

}  // namespace roci::services::node
