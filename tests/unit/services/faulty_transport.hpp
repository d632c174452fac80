// A transport whose readers of some topics get samples not at all, or more than once, as a test says: what a bad
// network, or a peer that sends again, does to a service.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "services/transport/transport.hpp"

namespace roci::services {

// Returns how often the `number`th sample (from 1) that comes on this topic is delivered. Vendor threads call it.
using Deliveries = std::function<int(const std::string& topic, int number)>;

class FaultyTransport : public transport::Transport {
 public:
  FaultyTransport(std::unique_ptr<transport::Transport> sound, Deliveries deliveries)
      : sound_(std::move(sound)), deliveries_(std::move(deliveries)) {}

  std::string_view vendor() const override { return sound_->vendor(); }
  std::unique_ptr<transport::Writer> create_writer(const transport::EndpointDescription& endpoint,
                                                   transport::WriterEvents events) override {
    return sound_->create_writer(endpoint, std::move(events));
  }
  std::unique_ptr<transport::Reader> create_reader(const transport::EndpointDescription& endpoint,
                                                   transport::ReaderEvents events) override {
    const auto deliver = events.on_sample;
    events.on_sample = [this, deliver, topic = endpoint.topic,
                        number = 0](transport::Sample&& sample) mutable {
      if (sample.kind != transport::SampleKind::data) return deliver(std::move(sample));
      const int times = deliveries_(topic, ++number);
      for (int i = 0; i < times; ++i) deliver(transport::Sample(sample));
    };
    return sound_->create_reader(endpoint, std::move(events));
  }
  std::string announcement() const override { return sound_->announcement(); }
  std::optional<transport::Participant> participant_of(const transport::Guid& guid) override {
    return sound_->participant_of(guid);
  }
  bool speaks_as(const transport::Guid& writer, std::string_view sender) const override {
    return sound_->speaks_as(writer, sender);
  }

 private:
  std::unique_ptr<transport::Transport> sound_;
  Deliveries deliveries_;
};

}  // namespace roci::services
