#include "arm_svc/motion_status.hpp"

namespace roci::arm {

std::string_view name_of(MotionStatus status) {
  switch (status) {
    case MotionStatus::found:
      return "found";
    case MotionStatus::unknown_pose:
      return "unknown_pose";
    case MotionStatus::unreachable:
      return "unreachable";
    case MotionStatus::unsolved:
      return "unsolved";
    case MotionStatus::in_collision:
      return "in_collision";
    case MotionStatus::no_path:
      return "no_path";
    case MotionStatus::overloaded:
      return "overloaded";
    case MotionStatus::faulty:
      return "faulty";
    case MotionStatus::cancelled:
      return "cancelled";
  }
  return "invalid";
}

}  // namespace roci::arm
