// Typed publishing and subscribing on a Node. T is a generated struct of idl/.
#pragma once

#include <functional>
#include <memory>

#include "services/node.hpp"

namespace roci::services {

template <class T>
class Publisher {
 public:
  Publisher() = default;
  // Fills in the header of clocked types. False: the transport refused the sample (see Writer::write).
  bool write(T value);
  bool dispose(const T& value);
  int matched_readers() const;
};

template <class T>
Publisher<T> advertise(Node&, const Topic<T>&);

template <class T>
void subscribe(Node&, const Topic<T>&, std::function<void(const T&)> on_value);

}  // namespace roci::services
