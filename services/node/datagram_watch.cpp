#include "services/node/datagram_watch.hpp"

#include "services/node/make_event.hpp"

namespace roci::services::node {

std::vector<v1::Event> DatagramWatch::turn(clock::WallTime now) {
  std::vector<v1::Event> news;
  if (transport_ == nullptr || (asked_ && now - *asked_ < clock::wall_seconds(kPeriodS))) return news;
  asked_ = now;
  for (const transport::RefusedDatagrams& refused : transport_->refused_datagrams()) {
    std::uint64_t& due = due_.try_emplace(refused.reason, 1).first->second;
    if (refused.count < due) continue;
    while (due <= refused.count) due *= 10;
    news.push_back(event_of(refused));
  }
  return news;
}

v1::Event DatagramWatch::event_of(const transport::RefusedDatagrams& refused) const {
  const std::string count = std::to_string(refused.count);
  const std::string source = refused.last_source.empty() ? "unknown" : refused.last_source;
  return make_event(v1::SEVERITY_WARNING, "datagram.refused",
                    node_ + " has refused " + count + " datagrams before DDS read them (" + refused.reason +
                        "), the last one from " + source,
                    {{"service", node_}, {"reason", refused.reason}, {"count", count}, {"source", source}});
}

}  // namespace roci::services::node
