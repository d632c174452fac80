// This file has typed publishing and subscribing on a Node. T is a generated struct of idl/;
// node/typed_endpoints.cpp lists the types.
#pragma once

#include <cstdint>
#include <functional>
#include <type_traits>
#include <utility>

#include "services/node.hpp"
#include "services/node/typed_endpoints.hpp"
#include "services/topics/topics.hpp"

namespace roci::services {

/// Writes the samples of one node on one topic. It can be copied, and lives no longer than its node.
template <class T>
class Publisher {
 public:
  Publisher() = default;
  explicit Publisher(node::TopicWriter& stream) : stream_(&stream) {}

  /// Fills in the header of clocked types. Returns false if the transport refused the sample (see
  /// Writer::write), or more than micro_step_limit() samples of the instance were written in one micro-step.
  bool write(T value) const { return node::TypedEndpoints<T>::write(*stream_, std::move(value)); }
  /// Finishes the instance, which is forgotten silently once there are enough newer finished ones
  /// (TopicWriter).
  bool dispose(const T& value) const { return node::TypedEndpoints<T>::dispose(*stream_, value); }
  /// Returns how many were written so far: for clocked types the `seq` of the newest one.
  std::uint64_t written() const { return node::written(*stream_); }
  int matched_readers() const { return node::matched_readers(*stream_); }

 private:
  node::TopicWriter* stream_ = nullptr;
};

/// Returns the node's publisher on a topic.
template <class T>
Publisher<T> advertise(Node& node, const topics::Topic<T>& topic) {
  return Publisher<T>(node::TypedEndpoints<T>::advertise(node.impl(), topic));
}

/// Calls `on_value` on the node's loop with each sample of the topic.
template <class T>
void subscribe(Node& node, const topics::Topic<T>& topic,
               std::type_identity_t<std::function<void(const T&)>> on_value) {
  node::TypedEndpoints<T>::subscribe(node.impl(), topic, std::move(on_value));
}

}  // namespace roci::services
