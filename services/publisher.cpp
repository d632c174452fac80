#include "services/publisher.hpp"

#include "services/node/codec.hpp"
#include "services/node/impl.hpp"

namespace roci::services::detail {

int matched_readers(const OutStream& stream) { return stream.matched_readers(); }
std::uint64_t written(const OutStream& stream) { return stream.total(); }

template <class T>
OutStream& Wire<T>::advertise(Node& node, const Topic<T>& topic) {
  return node.impl().endpoints.out(spec_of(topic));
}

template <class T>
void Wire<T>::subscribe(Node& node, const Topic<T>& topic, std::function<void(const T&)> on_value) {
  InTopic& input = node.impl().subscribe(spec_of(topic));
  input.on_value.push_back(
      [on_value = std::move(on_value)](const void* value) { on_value(*static_cast<const T*>(value)); });
}

template <class T>
bool Wire<T>::write(OutStream& stream, T&& value) {
  if constexpr (Headed<T>) stream.stamp(value.header());
  if constexpr (OfRun<T>) value.run(stream.run());
  return stream.write(serialize(value));
}

template <class T>
bool Wire<T>::dispose(OutStream& stream, const T& value) {
  return stream.dispose(serialize(value));
}

// Every type of topics.hpp.
template struct Wire<v1::ClockReady>;
template struct Wire<v1::ClockStep>;
template struct Wire<v1::ClockDone>;
template struct Wire<v1::Heartbeat>;
template struct Wire<v1::LeaseMessage>;
template struct Wire<v1::JournalChunk>;
template struct Wire<v1::Event>;
template struct Wire<v1::Goal>;
template struct Wire<v1::GoalStatus>;
template struct Wire<v1::Command>;
template struct Wire<v1::CommandAck>;
template struct Wire<v1::Observation>;
template struct Wire<v1::DataProduct>;
template struct Wire<v1::Hazard>;
template struct Wire<v1::Plan>;
template struct Wire<v1::StepStatus>;
template struct Wire<v1::MissionStatus>;
template struct Wire<v1::FunctionOffer>;
template struct Wire<v1::PlanDelta>;
template struct Wire<v1::PlanReceipt>;
template struct Wire<v1::CallCancel>;
template struct Wire<v1::PlanRequest>;
template struct Wire<v1::PlanReply>;
template struct Wire<v1::FunctionRequest>;
template struct Wire<v1::FunctionReply>;
template struct Wire<v1::PathRequest>;
template struct Wire<v1::PathReply>;
template struct Wire<v1::ArmMotionRequest>;
template struct Wire<v1::ArmMotionReply>;

}  // namespace roci::services::detail
