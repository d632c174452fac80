#include "services/node/typed_endpoints.hpp"

#include "services/node/codec.hpp"
#include "services/node/node_impl.hpp"

namespace roci::services::node {

int matched_readers(const TopicWriter& stream) { return stream.matched_readers(); }
std::uint64_t written(const TopicWriter& stream) { return stream.total(); }

template <class T>
TopicWriter& TypedEndpoints<T>::advertise(NodeImpl& node, const topics::Topic<T>& topic) {
  return node.endpoints.out(spec_of(topic));
}

template <class T>
void TypedEndpoints<T>::subscribe(NodeImpl& node, const topics::Topic<T>& topic,
                                  std::function<void(const T&)> on_value) {
  TopicReader& input = node.subscribe(spec_of(topic));
  input.on_value.push_back(
      [on_value = std::move(on_value)](const void* value) { on_value(*static_cast<const T*>(value)); });
}

template <class T>
bool TypedEndpoints<T>::write(TopicWriter& stream, T&& value) {
  if constexpr (HasHeader<T>) stream.stamp(value.header());
  if constexpr (OfRun<T>) value.run(stream.run().name());
  return stream.write(transport::serialize(value));
}

template <class T>
bool TypedEndpoints<T>::dispose(TopicWriter& stream, const T& value) {
  return stream.finish(transport::serialize(value));
}

// Every type of topics/topics.hpp.
template struct TypedEndpoints<v1::ClockReady>;
template struct TypedEndpoints<v1::ClockStep>;
template struct TypedEndpoints<v1::ClockDone>;
template struct TypedEndpoints<v1::Heartbeat>;
template struct TypedEndpoints<v1::LeaseMessage>;
template struct TypedEndpoints<v1::LeaseRequest>;
template struct TypedEndpoints<v1::LeaseState>;
template struct TypedEndpoints<v1::GoalHandOver>;
template struct TypedEndpoints<v1::JournalChunk>;
template struct TypedEndpoints<v1::Event>;
template struct TypedEndpoints<v1::Goal>;
template struct TypedEndpoints<v1::GoalStatus>;
template struct TypedEndpoints<v1::Command>;
template struct TypedEndpoints<v1::CommandAck>;
template struct TypedEndpoints<v1::Observation>;
template struct TypedEndpoints<v1::DataProduct>;
template struct TypedEndpoints<v1::Hazard>;
template struct TypedEndpoints<v1::Plan>;
template struct TypedEndpoints<v1::StepStatus>;
template struct TypedEndpoints<v1::MissionStatus>;
template struct TypedEndpoints<v1::FunctionOffer>;
template struct TypedEndpoints<v1::Order>;
template struct TypedEndpoints<v1::OrderStatus>;
template struct TypedEndpoints<v1::Decision>;
template struct TypedEndpoints<v1::DecisionAnswer>;
template struct TypedEndpoints<v1::DecisionReceipt>;
template struct TypedEndpoints<v1::NetworkOrder>;
template struct TypedEndpoints<v1::NetworkStatus>;
template struct TypedEndpoints<v1::DownlinkSchedule>;
template struct TypedEndpoints<v1::MissionOutlook>;
template struct TypedEndpoints<v1::ExecutedPlan>;
template struct TypedEndpoints<v1::TerrainFinding>;
template struct TypedEndpoints<v1::MapPatch>;
template struct TypedEndpoints<v1::KnownMap>;
template struct TypedEndpoints<v1::TimeProbe>;
template struct TypedEndpoints<v1::PlanDelta>;
template struct TypedEndpoints<v1::PlanReceipt>;
template struct TypedEndpoints<v1::CallCancel>;
template struct TypedEndpoints<v1::PlanRequest>;
template struct TypedEndpoints<v1::PlanReply>;
template struct TypedEndpoints<v1::FunctionRequest>;
template struct TypedEndpoints<v1::FunctionReply>;
template struct TypedEndpoints<v1::PathRequest>;
template struct TypedEndpoints<v1::PathReply>;
template struct TypedEndpoints<v1::ArmMotionRequest>;
template struct TypedEndpoints<v1::ArmMotionReply>;

}  // namespace roci::services::node
