// This is the codec of a generated type. It includes Fast CDR: only the few files that instantiate templates
// include it.
#pragma once

#include <concepts>
#include <memory>
#include <utility>

#include "services/node/endpoints.hpp"
#include "services/node/key_words.hpp"
#include "services/topics/topics.hpp"
#include "services/transport/type_support.hpp"

namespace roci::services::node {

template <class T>
concept HasHeader = requires(T value) {
  { value.header() } -> std::same_as<v1::SampleHeader&>;
};

/// Holds for types that name their run themselves.
template <class T>
concept OfRun = requires(T value, std::string run) {
  { std::as_const(value).run() } -> std::same_as<const std::string&>;
  value.run(run);
};

/// Returns the service that a sample says it is from.
template <class T>
const std::string& sender_as(const void* value) {
  const T& sample = *static_cast<const T*>(value);
  if constexpr (HasHeader<T>) {
    return std::as_const(sample.header()).sender();
  } else if constexpr (std::same_as<T, v1::ClockStep>) {
    return sample.master();
  } else if constexpr (std::same_as<T, v1::TimeProbe>) {
    return sample.answerer().empty() ? sample.asker() : sample.answerer();
  } else if constexpr (std::same_as<T, v1::LeaseMessage> || std::same_as<T, v1::JournalChunk> ||
                       std::same_as<T, v1::GoalHandOver>) {
    return sample.executive();
  } else if constexpr (std::same_as<T, v1::LeaseRequest>) {
    return sample.commander();
  } else if constexpr (std::same_as<T, v1::LeaseState>) {
    return sample.owner();
  } else {
    return sample.service();
  }
}

/// Returns the service that a command or a request is for, or an empty text if it is for everyone who reads
/// the topic.
template <class T>
std::string addressee_as(const void* value) {
  const T& sample = *static_cast<const T*>(value);
  if constexpr (std::same_as<T, v1::Command>) {
    return sample.owner();
  } else if constexpr (requires { sample.request().instance_name(); }) {
    return sample.request().instance_name();
  } else {
    return {};
  }
}

/// Decodes a payload as a T.
template <class T>
Decoded decode_as(std::span<const std::uint8_t> payload) {
  auto value = std::make_shared<T>();
  const bool whole = transport::deserialize(payload, *value);
  return {std::move(value), whole};
}

/// Returns the serialized key of a sample, empty for types without one.
template <class T>
transport::Payload key_as(const void* value) {
  transport::Payload key;
  if (T::isKeyDefined())
    transport::detail::serialized_key<T>(transport::serialize(*static_cast<const T*>(value)), false, key);
  return key;
}

/// Returns the bytes of a sample on the wire, without its run's name.
template <class T>
std::size_t size_as(const void* value) {
  T without_run = *static_cast<const T*>(value);
  without_run.header().run("");
  return transport::serialize(without_run).size();
}

/// Describes a topic for the loop, with the codec of its type.
template <class T>
TopicSpec spec_of(const topics::Topic<T>& topic) {
  Codec codec;
  codec.type = transport::describe_type<T>(topic.type_name);
  codec.decode = &decode_as<T>;
  codec.key = &key_as<T>;
  codec.addressee = &addressee_as<T>;
  codec.key_words = [](const void* value) { return key_words(*static_cast<const T*>(value)); };
  codec.sender = &sender_as<T>;
  if constexpr (HasHeader<T>) {
    codec.size = &size_as<T>;
    codec.header = [](const void* value) -> const v1::SampleHeader& {
      return static_cast<const T*>(value)->header();
    };
  }
  if constexpr (OfRun<T>)
    codec.run = [](const void* value) -> const std::string& { return static_cast<const T*>(value)->run(); };
  if constexpr (HasHeader<T>) {
    codec.run = [](const void* value) -> const std::string& {
      return std::as_const(static_cast<const T*>(value)->header()).run();
    };
  }
  return {topic.name, topic.qos, topic.clocking, topic.scope, std::move(codec), topic.limit};
}

}  // namespace roci::services::node
