#include "exec_svc/executive/messages.hpp"

namespace roci::exec::executive {

const char* to_string(RecoveryAction action) {
  switch (action) {
    case RecoveryAction::push:
      return "push";
    case RecoveryAction::retry:
      return "retry";
    case RecoveryAction::contingency:
      return "contingency";
  }
  return "unknown";
}

}  // namespace roci::exec::executive
