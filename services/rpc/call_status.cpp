#include "services/rpc/call_status.hpp"

namespace roci::services::rpc {

const char* to_string(CallStatus status) {
  switch (status) {
    case CallStatus::ok:
      return "ok";
    case CallStatus::timeout:
      return "timeout";
    case CallStatus::no_owner:
      return "no_owner";
    case CallStatus::owner_lost:
      return "owner_lost";
    case CallStatus::remote_error:
      return "remote_error";
    case CallStatus::overloaded:
      return "overloaded";
    case CallStatus::cancelled:
      return "cancelled";
  }
  return "unknown";
}

}  // namespace roci::services::rpc
