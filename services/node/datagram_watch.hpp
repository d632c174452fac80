// The datagram watch reports the datagrams that a node's transport refuses.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "roci_idl/health.h"
#include "services/clock/wall.hpp"
#include "services/transport/refused_datagrams.hpp"

namespace roci::services::node {

/// Reports refused datagrams by the event datagram.refused, for each reason the first time and each time that
/// the count has grown tenfold: a million bad datagrams cause about seven events.
class DatagramWatch {
 public:
  /// Watches a `transport`, which must outlive this object; if it is null there is no guard, and nothing is
  /// reported.
  DatagramWatch(std::string node, const transport::RefusesDatagrams* transport)
      : node_(std::move(node)), transport_(transport) {}

  /// Asks the transport once in kPeriodS of wall time, and returns what is new; it is called in each turn of the
  /// loop.
  std::vector<v1::Event> turn(clock::WallTime now);

  static constexpr double kPeriodS = 1;

 private:
  v1::Event event_of(const transport::RefusedDatagrams&) const;

  const std::string node_;
  const transport::RefusesDatagrams* const transport_;
  std::optional<clock::WallTime> asked_;
  std::map<std::string, std::uint64_t>
      due_;  // the count that is told next, by reason; there are as many as a guard has
};

}  // namespace roci::services::node
