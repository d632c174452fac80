#include "services/node/link_gate.hpp"

#include <algorithm>

#include "services/node/endpoints.hpp"
#include "services/topics/topics.hpp"

namespace roci::services::node {
namespace {

// What a scenario sends up is published by a service of no robot, in the ground's place.
bool sent_up(std::string_view topic) {
  return topic == topics::goal.name || topic == topics::order.name || topic == topics::decision_answer.name ||
         topic == topics::network_order.name;
}

link::LinkSample link_sample_of(const TopicSpec& topic, const link::Link& link,
                                const std::shared_ptr<const void>& value) {
  const v1::SampleHeader& header = topic.codec.header(value.get());
  link::LinkSample out{topic.name, header.sender(), header.incarnation(), header.seq()};
  if (link.rate_bit_s > 0) out.bytes = topic.codec.size(value.get());
  if (topic.qos == transport::Qos::state) {
    const transport::Payload key = topic.codec.key(value.get());
    out.lifetime = link::Lifetime::newest;
    out.instance.assign(key.begin(), key.end());
  }
  out.value = value;
  return out;
}

}  // namespace

link::Party LinkGate::self() const {
  return {options_->name, options_->robot, options_->clock == clock::ClockMode::observer};
}

bool LinkGate::admit(TopicReader& reader, const std::shared_ptr<const void>& value, temporal::Time now) {
  const link::LinkTable& links = options_->links;
  if (links.empty()) return true;
  // Whoever reads what is for another service passes over it.
  const std::string addressee = reader.topic.codec.addressee(value.get());
  if (!addressee.empty() && addressee != options_->name) return true;
  const auto passage = links.passage(sender_of(reader, value.get()), self());
  if (!passage) return true;
  const auto [direction, fresh] =
      directions_.try_emplace({passage->index, passage->sender_end},
                              Direction{link::Channel(*passage->link, links.seed()), passage->link->name});
  direction->second.readers[reader.topic.name] = &reader;
  const bool arrived =
      direction->second.channel.offer(link_sample_of(reader.topic, *passage->link, value), now);
  note_losses(direction->second);
  return arrived;
}

link::Party LinkGate::sender_of(const TopicReader& reader, const void* value) const {
  const v1::SampleHeader& header = reader.topic.codec.header(value);
  link::Party out{header.sender(), header.robot()};
  if (!out.robot.empty()) return out;
  out.ground = header.incarnation() == 0 || sent_up(reader.topic.name);
  if (reader.topic.name == topics::goal.name && header.incarnation() != 0) {
    const std::string& issuer = static_cast<const v1::Goal*>(value)->issuer();
    if (options_->links.has_robot(issuer)) return {header.sender(), issuer};
  }
  if (reader.topic.name == topics::observation.name) {
    const std::string& timeline = static_cast<const v1::Observation*>(value)->timeline();
    const std::string robot = timeline.substr(0, timeline.find('.'));
    if (options_->links.has_robot(robot)) out.robot = robot;
  }
  return out;
}

void LinkGate::note_losses(Direction& direction) {
  for (const link::Loss& loss : direction.channel.take_losses()) {
    if (lost_.size() >= kNamedLosses) return;
    const link::LinkSample& sample = loss.sample;
    const Codec& codec = direction.readers.at(sample.topic)->topic.codec;
    lost_.push_back({loss.at, direction.name, sample.topic, codec.key_words(sample.value.get()),
                     sample.sender, sample.incarnation, sample.number, loss.attempt, loss.fate});
  }
}

std::vector<LinkGate::Due> LinkGate::take(temporal::Time now) {
  std::vector<std::pair<temporal::Time, Due>> arrived;
  for (auto& [key, direction] : directions_) {
    for (link::Channel::Arrival& arrival : direction.channel.take(now))
      arrived.push_back(
          {arrival.at, {direction.readers.at(arrival.sample.topic), std::move(arrival.sample.value)}});
    note_losses(direction);
  }
  std::ranges::stable_sort(arrived, {}, &std::pair<temporal::Time, Due>::first);
  std::vector<Due> out;
  for (auto& [at, due] : arrived) out.push_back(std::move(due));
  return out;
}

std::optional<temporal::Time> LinkGate::next() const {
  std::optional<temporal::Time> next;
  for (const auto& [key, direction] : directions_) {
    const auto own = direction.channel.next();
    if (own && (!next || *own < *next)) next = own;
  }
  return next;
}

std::optional<temporal::Duration> LinkGate::round_trip(const std::string& service) const {
  const link::LinkTable& links = options_->links;
  if (!service.empty()) return links.round_trip(self(), links.party(service));
  std::optional<temporal::Duration> longest;
  for (const auto& [name, time] : round_trips()) longest = std::max(longest.value_or(time), time);
  return longest;
}

std::map<std::string, temporal::Duration> LinkGate::round_trips() const {
  return options_->links.round_trips(self());
}

std::map<std::string, link::Counts> LinkGate::counts() const {
  std::map<std::string, link::Counts> out;
  for (const auto& [key, direction] : directions_) out[direction.name] += direction.channel.counts();
  return out;
}

}  // namespace roci::services::node
