// Every topic of services/topics/topics.hpp as what reads its samples.
#pragma once

#include <string>
#include <vector>

#include "services/node/endpoints.hpp"

namespace roci::fuzz {

struct Decoder {
  std::string type;  ///< "Goal"
  services::node::TopicSpec topic;
  /// Writes the decoded value again.
  services::transport::Payload (*encode)(const void* value) = nullptr;
};

/// One for each topic; a test fails when a topic type of the IDL has none.
const std::vector<Decoder>& decoders();

}  // namespace roci::fuzz
