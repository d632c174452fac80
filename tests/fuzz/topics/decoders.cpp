#include "tests/fuzz/topics/decoders.hpp"

#include "services/node/codec.hpp"
#include "services/topics/topics.hpp"

namespace roci::fuzz {
namespace {

namespace topics = services::topics;

template <class T>
Decoder decoder(const services::topics::Topic<T>& topic) {
  const std::string type = topic.type_name;
  return {type.substr(type.rfind(':') + 1), services::node::spec_of(topic),
          [](const void* value) { return services::transport::serialize(*static_cast<const T*>(value)); }};
}

}  // namespace

const std::vector<Decoder>& decoders() {
  static const std::vector<Decoder> all{decoder(topics::clock_ready),
                                        decoder(topics::clock_step),
                                        decoder(topics::clock_done),
                                        decoder(topics::heartbeat),
                                        decoder(topics::time_probe),
                                        decoder(topics::exec_member),
                                        decoder(topics::exec_journal),
                                        decoder(topics::lease_request),
                                        decoder(topics::lease_state),
                                        decoder(topics::goal_hand_over),
                                        decoder(topics::event),
                                        decoder(topics::goal),
                                        decoder(topics::goal_status),
                                        decoder(topics::command),
                                        decoder(topics::command_ack),
                                        decoder(topics::observation),
                                        decoder(topics::data_product),
                                        decoder(topics::hazard),
                                        decoder(topics::plan),
                                        decoder(topics::step_status),
                                        decoder(topics::mission_status),
                                        decoder(topics::function_offer),
                                        decoder(topics::order),
                                        decoder(topics::order_status),
                                        decoder(topics::decision),
                                        decoder(topics::decision_answer),
                                        decoder(topics::decision_receipt),
                                        decoder(topics::network_order),
                                        decoder(topics::network_status),
                                        decoder(topics::downlink_schedule),
                                        decoder(topics::mission_outlook),
                                        decoder(topics::executed_plan),
                                        decoder(topics::terrain_finding),
                                        decoder(topics::map_patch),
                                        decoder(topics::known_map),
                                        decoder(topics::plan_delta),
                                        decoder(topics::plan_receipt),
                                        decoder(topics::call_cancel),
                                        decoder(topics::plan_request.request),
                                        decoder(topics::plan_request.reply),
                                        decoder(topics::function_call.request),
                                        decoder(topics::function_call.reply),
                                        decoder(topics::path_request.request),
                                        decoder(topics::path_request.reply),
                                        decoder(topics::arm_motion.request),
                                        decoder(topics::arm_motion.reply)};
  return all;
}

}  // namespace roci::fuzz
