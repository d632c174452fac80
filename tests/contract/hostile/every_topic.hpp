// All topics of the table, for tests that attack each of them.
#pragma once

#include "services/topics/topics.hpp"

namespace roci::services::contract::hostile {

/// Calls `use` with each topics::Topic<T> of services/topics/topics.hpp.
template <class Use>
void for_each_topic(Use use) {
  const auto both = [&use](const auto& procedure) {
    use(procedure.request);
    use(procedure.reply);
  };
  use(topics::clock_ready);
  use(topics::clock_step);
  use(topics::clock_done);
  use(topics::heartbeat);
  use(topics::time_probe);
  use(topics::exec_member);
  use(topics::exec_journal);
  use(topics::lease_request);
  use(topics::lease_state);
  use(topics::goal_hand_over);
  use(topics::event);
  use(topics::goal);
  use(topics::goal_status);
  use(topics::command);
  use(topics::command_ack);
  use(topics::observation);
  use(topics::data_product);
  use(topics::hazard);
  use(topics::plan);
  use(topics::step_status);
  use(topics::mission_status);
  use(topics::function_offer);
  use(topics::order);
  use(topics::order_status);
  use(topics::decision);
  use(topics::decision_answer);
  use(topics::decision_receipt);
  use(topics::network_order);
  use(topics::network_status);
  use(topics::downlink_schedule);
  use(topics::mission_outlook);
  use(topics::executed_plan);
  use(topics::terrain_finding);
  use(topics::map_patch);
  use(topics::known_map);
  use(topics::plan_delta);
  use(topics::plan_receipt);
  use(topics::call_cancel);
  both(topics::plan_request);
  both(topics::function_call);
  both(topics::path_request);
  both(topics::arm_motion);
}

}  // namespace roci::services::contract::hostile
