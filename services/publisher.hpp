// Typed publishing and subscribing on a Node. T is a generated struct of idl/; publisher.cpp lists the types.
#pragma once

#include <cstdint>
#include <functional>
#include <type_traits>
#include <utility>

#include "services/node.hpp"
#include "services/topics.hpp"

namespace roci::services {

class OutStream;

namespace detail {

// Defined and instantiated in publisher.cpp, so that users of this header compile no serialization.
template <class T>
struct Wire {
  static OutStream& advertise(Node&, const Topic<T>&);
  static void subscribe(Node&, const Topic<T>&, std::function<void(const T&)>);
  static bool write(OutStream&, T&&);
  static bool dispose(OutStream&, const T&);
};

int matched_readers(const OutStream&);
std::uint64_t written(const OutStream&);

}  // namespace detail

// Copyable; lives no longer than its node.
template <class T>
class Publisher {
 public:
  Publisher() = default;
  explicit Publisher(OutStream& stream) : stream_(&stream) {}

  // Fills in the header of clocked types. False: the transport refused the sample (see Writer::write), or
  // more than kMicroStepLimit samples of the instance were written in one micro-step.
  bool write(T value) const { return detail::Wire<T>::write(*stream_, std::move(value)); }
  // Late joiners no longer see the instance; nobody is told.
  bool dispose(const T& value) const { return detail::Wire<T>::dispose(*stream_, value); }
  // How many were written so far: for clocked types the `seq` of the newest one.
  std::uint64_t written() const { return detail::written(*stream_); }
  int matched_readers() const { return detail::matched_readers(*stream_); }

 private:
  OutStream* stream_ = nullptr;
};

template <class T>
Publisher<T> advertise(Node& node, const Topic<T>& topic) {
  return Publisher<T>(detail::Wire<T>::advertise(node, topic));
}

template <class T>
void subscribe(Node& node, const Topic<T>& topic,
               std::type_identity_t<std::function<void(const T&)>> on_value) {
  detail::Wire<T>::subscribe(node, topic, std::move(on_value));
}

}  // namespace roci::services
