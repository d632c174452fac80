#include "exec_svc/orders/authority.hpp"

namespace roci::exec::orders {

executive::Permissions Authority::permissions() const {
  return {held_, level_ == mission::AutonomyLevel::e1, level_ >= mission::AutonomyLevel::e3, held_activities_,
          approved_};
}

}  // namespace roci::exec::orders
