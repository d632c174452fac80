// This file says how the simulated clock names the topic of a stream. Samples of a topic that is inner to one robot
// never reach the services of another, so the clock counts them apart, and services that cannot hear a stream do not
// wait for it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace roci::services::clock {

/// Stands for every robot in the name of a subscription.
inline constexpr char kEveryRobot[] = "*";

/// Returns e.g. "roci/command@rover" for the samples of rover's services on their inner topic, and the topic alone
/// for a sender without a robot.
inline std::string stream_topic(const std::string& topic, std::string_view robot) {
  return robot.empty() ? topic : topic + "@" + std::string(robot);
}

/// Returns the topic of a stream: "roci/command" of "roci/command@rover".
inline std::string_view topic_of(std::string_view stream) { return stream.substr(0, stream.find('@')); }

/// Returns what a service of `robot` subscribes to on an inner topic: the streams of its own robot (those of every
/// robot if it has none) and of services that belong to none.
inline std::vector<std::string> inner_subscriptions(const std::string& topic, const std::string& robot) {
  return {topic, stream_topic(topic, robot.empty() ? kEveryRobot : robot)};
}

/// Finds the subscription to a stream in a set or map by name; end() if there is none.
template <class Subscriptions>
auto find_subscription(Subscriptions& subscriptions, const std::string& stream) {
  const auto found = subscriptions.find(stream);
  if (found != subscriptions.end() || stream.find('@') == std::string::npos) return found;
  return subscriptions.find(stream_topic(std::string(topic_of(stream)), kEveryRobot));
}

}  // namespace roci::services::clock
