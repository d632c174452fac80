// These are a node's topics with their types. T is a generated struct of idl/; typed_endpoints.cpp lists the
// types.
#pragma once

#include <cstdint>
#include <functional>
#include <type_traits>
#include <utility>

#include "services/topics/topics.hpp"

namespace roci::services::node {

class NodeImpl;
class TopicWriter;

/// Translates between values of T and a node's topics. It is defined and instantiated in typed_endpoints.cpp,
/// so that users of this header compile no serialization.
template <class T>
struct TypedEndpoints {
  static TopicWriter& advertise(NodeImpl&, const topics::Topic<T>&);
  static void subscribe(NodeImpl&, const topics::Topic<T>&, std::function<void(const T&)>);
  static bool write(TopicWriter&, T&&);
  static bool dispose(TopicWriter&, const T&);
};

int matched_readers(const TopicWriter&);

/// Returns how many samples the stream has written.
std::uint64_t written(const TopicWriter&);

/// Returns the node's writer of a topic.
template <class T>
TopicWriter& advertise(NodeImpl& node, const topics::Topic<T>& topic) {
  return TypedEndpoints<T>::advertise(node, topic);
}

/// Calls `on_value` with each sample of the topic.
template <class T>
void subscribe(NodeImpl& node, const topics::Topic<T>& topic,
               std::type_identity_t<std::function<void(const T&)>> on_value) {
  TypedEndpoints<T>::subscribe(node, topic, std::move(on_value));
}

/// Writes a sample. Returns false if the transport refused it, or a micro-step had no room for it.
template <class T>
bool write(TopicWriter& stream, T value) {
  return TypedEndpoints<T>::write(stream, std::move(value));
}

}  // namespace roci::services::node
