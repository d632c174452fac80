// Orders from the ground are plain values here: what is ordered, and where an order stands.
#pragma once

#include <cstdint>
#include <string>

#include "core/temporal/value.hpp"
#include "exec_svc/goals/goal_set.hpp"
#include "exec_svc/mission/autonomy_level.hpp"
#include "exec_svc/orders/issued_key.hpp"

namespace roci::exec::orders {

/// Names what an order asks for, in the order of OrderKind in idl/order.idl, and one more: a command goes
/// over the wire as an approval with content.
enum class OrderKind {
  hold,       ///< nothing new starts; with a target: this activity does not
  release,    ///< ends the hold of the same target
  approve,    ///< the target, an activity, may start
  set_value,  ///< of a timeline that the ground owns
  autonomy,   ///< the level from now on
  upload,     ///< the target gets a new content, whole or not at all
  answer,     ///< to a decision
  drop,       ///< the target, an activity that has not begun, is left out
  relaunch,   ///< the plan that was stopped goes on with what is left of it (R149)
  safe,       ///< the robot is made safe, and held
  command,    ///< the target, a component, carries out the content: its name, and arguments as "name=value"
};
/// Returns "hold", "release", …, and "set" for set_value.
const char* to_string(OrderKind kind);

/// Holds an order as it came in; which of the members count depends on its kind.
struct Order {
  IssuedKey key;
  goals::SampleId sample;
  OrderKind kind = OrderKind::hold;
  std::string target;
  temporal::Value content;
  std::string choice;
  mission::AutonomyLevel level = mission::AutonomyLevel::e4;
  std::string upload;
  std::uint32_t checksum = 0;  ///< CRC-32 of the upload
};

/// Says how far an order has come, in the order of OrderStage in idl/order.idl.
enum class OrderStage { received, accepted, refused, applied };
/// Returns "received", …: the name above.
const char* to_string(OrderStage stage);

/// Says where an order stands.
struct OrderStatus {
  IssuedKey key;
  goals::SampleId answers;  ///< the newest sample that brought it
  OrderStage stage = OrderStage::received;
  std::string reason{};            ///< of a refusal; else what was done, in plain words
  std::uint32_t plan_version = 0;  ///< with applied: the plan in which it takes effect
};

}  // namespace roci::exec::orders
