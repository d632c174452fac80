// The authority of the executive is what it may do without the ground.
#pragma once

#include <set>
#include <string>

#include "exec_svc/executive/permissions.hpp"
#include "exec_svc/mission/autonomy_level.hpp"
#include "exec_svc/orders/order.hpp"

namespace roci::exec::orders {

/// Holds the level of autonomy, and what the ground has held and approved.
class Authority {
 public:
  explicit Authority(mission::AutonomyLevel level) : level_(level) {}

  mission::AutonomyLevel level() const { return level_; }
  void set_level(mission::AutonomyLevel level) { level_ = level; }

  /// Returns whether all is held: nothing new starts, and nothing is replanned.
  bool held() const { return held_; }
  void hold_all(bool hold) { held_ = hold; }
  void hold(const std::string& activity) { held_activities_.insert(activity); }
  /// Returns false if the activity was not held.
  bool release(const std::string& activity) { return held_activities_.erase(activity) > 0; }
  void approve(const std::string& activity) { approved_.insert(activity); }
  /// Ends an approval, which serves one start. Returns false if there was none.
  bool withdraw_approval(const std::string& activity) { return approved_.erase(activity) > 0; }

  /// Whether a plan may take the place of one that runs or broke.
  bool may_replan() const { return level_ == mission::AutonomyLevel::e4 && !held_; }
  /// What this comes to for the activities of a plan.
  executive::Permissions permissions() const;

  template <class Archive, class Self>
  static void fields(Archive& archive, Self& self) {
    archive(self.level_, self.held_, self.held_activities_, self.approved_);
  }

 private:
  mission::AutonomyLevel level_;
  bool held_ = false;
  std::set<std::string> held_activities_;
  std::set<std::string> approved_;
};

}  // namespace roci::exec::orders
