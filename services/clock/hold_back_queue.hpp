// The hold-back queue has the samples that one participant of the simulated clock has received, until a
// micro-step delivers them in the order that all participants share (the hold-back queue of totally ordered
// multicast; Coulouris et al., Distributed Systems, 2011, section 15.4). Pure.
//
// A stream is (topic, sender, incarnation), where the topic may name the sender's robot (stream_topic.hpp); its samples
// are numbered without gaps from 1. A step announces
// the total of every stream; the participant acts once it holds them all, and then sees each exactly once, in
// the order (topic, sender, incarnation, number). In its first step it is new: of the samples announced then
// it gets the newest of each key of state topics, as a late joiner does, and nothing of the others.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "roci_idl/basic.h"
#include "roci_idl/clock.h"

namespace roci::services::clock {

/// Names a stream of samples, numbered without gaps from 1.
struct StreamKey {
  std::string topic;
  std::string sender;
  std::uint32_t incarnation = 0;
  auto operator<=>(const StreamKey&) const = default;
};

/// Holds a sample that a micro-step delivers.
struct Delivery {
  std::string topic;                  ///< without the robot of the stream
  std::shared_ptr<const void> value;  ///< null for a sample that was counted and could not be read
};

/// Says what a participant that joins late is given of a topic's past (the durability QoS of DDS).
enum class Durability {
  volatile_,        ///< nothing
  transient_local,  ///< the newest sample of each key
};

/// Delivers each sample of one participant exactly once, in the order that all participants share.
class HoldBackQueue {
 public:
  using Key = std::vector<std::uint8_t>;  ///< the serialized key of an instance
  using KeyOf = std::function<Key(const void* value)>;

  /// Subscribes to a topic, whose instances `key_of` tells apart. `topic` may name a robot, or kEveryRobot.
  void subscribe(const std::string& topic, Durability, KeyOf key_of);
  /// Adds a sample. Returns false, and drops the sample, when kHeldBackStreams are known or kHeldBackSamples
  /// of its stream wait (bounds/limits.hpp): no clock announces so many.
  bool add(const std::string& topic, const v1::SampleHeader&, std::shared_ptr<const void> value);

  /// Returns whether all samples that the step announces are there. Senders outside its roster are not waited
  /// for.
  bool complete(const v1::ClockStep&) const;
  /// Names the streams that complete() misses, for people: "topic sender#incarnation 3/5".
  std::vector<std::string> missing(const v1::ClockStep&) const;
  /// Removes and returns what the step delivers. Call it once for each micro-step in which this participant
  /// acts.
  std::vector<Delivery> take(const v1::ClockStep&);

 private:
  struct Input {
    Durability durability = Durability::transient_local;
    KeyOf key_of;
  };
  struct Stream {
    std::uint64_t delivered = 0;
    std::uint64_t received = 0;  // without gaps up to here
    std::map<std::uint64_t, std::shared_ptr<const void>> held;
    void close_gaps();
  };
  /// Returns the streams with samples to deliver, in the order of delivery.
  std::vector<const v1::StreamCount*> grown(const v1::ClockStep&) const;
  bool has_all(const v1::StreamCount&) const;
  bool awaited(const v1::ClockStep&, const v1::StreamCount&) const;
  void deliver(const StreamKey&, Stream&, std::uint64_t total, std::vector<Delivery>&) const;
  void deliver_history(const StreamKey&, Stream&, std::uint64_t total, std::vector<Delivery>&) const;

  bool joined_ = false;
  std::map<std::string, Input> inputs_;
  std::map<StreamKey, Stream> streams_;
};

}  // namespace roci::services::clock
