// The status of a call says how a call to another service ends.
#pragma once

#include <cstddef>
#include <cstdint>

namespace roci::services::rpc {

/// Says how a call ended.
enum class CallStatus {
  ok,
  timeout,       ///< no answer came before the deadline
  no_owner,      ///< the service that should answer is not there, or nobody serves the procedure
  owner_lost,    ///< the service that should answer died while the call was under way
  remote_error,  ///< it answered with an exception
  overloaded,    ///< kMaxPendingCalls of this procedure are under way already
  cancelled,     ///< the caller cancelled the call before it was sent to anybody
};

/// Returns the name above.
const char* to_string(CallStatus);

/// Bounds the calls of one procedure that a client may have under way.
inline constexpr std::size_t kMaxPendingCalls = 256;

/// Numbers a call among those of one client.
using CallId = std::int64_t;

/// Counts what went over one procedure.
struct CallStatistics {
  std::uint64_t sent = 0;     ///< requests, repetitions included
  std::uint64_t late = 0;     ///< replies to calls that had ended
  std::uint64_t foreign = 0;  ///< replies to calls of other clients
};

}  // namespace roci::services::rpc
