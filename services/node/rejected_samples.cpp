#include "services/node/rejected_samples.hpp"

#include <algorithm>
#include <utility>

#include "services/log/log.hpp"
#include "services/node/make_event.hpp"

namespace roci::services::node {
namespace {

std::string key_of(const std::string& topic, SampleRejection why) { return topic + " " + to_string(why); }

const char* remedy_of(SampleRejection why) {
  switch (why) {
    case SampleRejection::malformed:
      return "it is no sample of the topic's type";
    case SampleRejection::too_large:
      return "it is larger than the topic allows";
    case SampleRejection::queue_full:
      return "too many wait already: its writer is too fast, or this service too slow";
    case SampleRejection::no_room:
      return "the table that it would have entered is full";
    case SampleRejection::another_name:
      return "its writer has not the certificate of the service that it names as its sender";
  }
  return "";
}

}  // namespace

const char* to_string(SampleRejection why) {
  switch (why) {
    case SampleRejection::malformed:
      return "malformed";
    case SampleRejection::too_large:
      return "too large";
    case SampleRejection::queue_full:
      return "queue full";
    case SampleRejection::no_room:
      return "no room";
    case SampleRejection::another_name:
      return "another's name";
  }
  return "unknown";
}

RejectedSamples::RejectedSamples(std::string node, Lookup lookup, std::function<void()> prepare,
                                 std::function<void(const v1::Event&)> tell, double tell_after_s)
    : node_(std::move(node)),
      lookup_(std::move(lookup)),
      prepare_(std::move(prepare)),
      tell_(std::move(tell)),
      tell_after_s_(tell_after_s) {}

void RejectedSamples::note(const std::string& topic, SampleRejection why, const transport::Guid& writer) {
  const std::scoped_lock lock(mutex_);
  if (const std::uint64_t count = tally_.note(key_of(topic, why)))
    news_.push_back({topic, why, writer, count});
}

std::uint64_t RejectedSamples::count(const std::string& topic, SampleRejection why) const {
  const std::scoped_lock lock(mutex_);
  return tally_.count(key_of(topic, why));
}

std::string RejectedSamples::name_of(const transport::Guid& writer) const {
  const bool known = std::ranges::any_of(writer, [](std::uint8_t byte) { return byte != 0; });
  const auto participant = known ? lookup_(writer) : std::nullopt;
  return participant && !participant->name.empty() ? participant->name : "unknown";
}

v1::Event RejectedSamples::event_of(const New& one) const {
  return make_event(v1::SEVERITY_WARNING, "sample.refused",
                    node_ + " refuses a sample of " + one.topic + ": " + remedy_of(one.why) + " (" +
                        std::to_string(one.count) + " so far)",
                    {{"service", node_},
                     {"topic", one.topic},
                     {"reason", to_string(one.why)},
                     {"count", std::to_string(one.count)},
                     {"participant", name_of(one.writer)}});
}

void RejectedSamples::turn(clock::WallTime now) {
  std::vector<New> news;
  {
    const std::scoped_lock lock(mutex_);
    news = std::exchange(news_, {});
  }
  for (const New& one : news) {
    v1::Event event = event_of(one);
    log::warning(event.text() + ", from participant " + name_of(one.writer));
    prepare_();
    untold_.push_back({now + clock::wall_seconds(tell_after_s_), std::move(event)});
  }
  while (!untold_.empty() && untold_.front().due <= now) {
    tell_(untold_.front().event);
    untold_.pop_front();
  }
}

}  // namespace roci::services::node
