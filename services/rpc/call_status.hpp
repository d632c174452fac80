// How a call to another service ends.
#pragma once

#include <cstddef>
#include <cstdint>

namespace roci::services::rpc {

enum class CallStatus {
  ok,
  timeout,       ///< No answer came before the deadline.
  no_owner,      ///< The service that should answer is not there, or nobody serves the procedure.
  owner_lost,    ///< The service that should answer died while the call was under way.
  remote_error,  ///< It answered with an exception.
  overloaded,    ///< kMaxPendingCalls of this procedure are under way already.
  cancelled,     ///< The caller cancelled the call before it was sent to anybody.
};

/// The name above.
const char* to_string(CallStatus);

/// How many calls of one procedure a client may have under way.
inline constexpr std::size_t kMaxPendingCalls = 256;

/// The number of a call among those of one client.
using CallId = std::int64_t;

struct CallStatistics {
  std::uint64_t sent = 0;     ///< Requests, repetitions included.
  std::uint64_t late = 0;     ///< Replies to calls that had ended.
  std::uint64_t foreign = 0;  ///< Replies to calls of other clients.
};

}  // namespace roci::services::rpc
