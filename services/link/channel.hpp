// A channel is one direction of a link as one receiver sees it: which samples arrive, and when. It is pure:
// the time is an argument, and chance is a function of the sample.
//
// Samples are sent one after the other, each for (bits / rate), and arrive one light time after their last
// bit. Whether an attempt is lost depends on (seed, link, topic, sender, incarnation, number, attempt) alone,
// so it is the same on every transport and in every replay. A sample of a state topic (Lifetime::newest)
// waits while the link is closed and is sent again until it arrives or a newer one of its instance comes;
// every other sample is lost when the link closes before its last bit is sent.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "services/link/link.hpp"
#include "services/link/lost_sample.hpp"

namespace roci::services::link {

/// Begins the next attempt so long, and one round trip, after the end of the first lost one. The pause doubles
/// with each further one, up to the longest.
inline constexpr temporal::Duration kRepetitionPause = std::chrono::milliseconds(200);
inline constexpr temporal::Duration kLongestRepetitionPause = std::chrono::seconds(10);

/// Bounds the samples without repetition that may wait for a narrow link; more are lost.
inline constexpr std::size_t kLongestQueue = 4096;

/// Bounds the samples of a direction that are under way, and the known instances of state topics; what comes beyond is
/// lost. At a light time of twenty minutes that is fifty samples a second.
inline constexpr std::size_t kLongestFlight = 65'536;

/// Returns the light time there and back.
constexpr temporal::Duration round_trip(const Link& link) { return 2 * link.light_time; }

/// Says what becomes of a sample that was lost.
enum class Lifetime {
  once,    ///< it stays lost
  newest,  ///< the newest sample of an instance arrives in the end
};

/// Holds what the model knows of a sample on its way over a link.
struct LinkSample {
  std::string topic;
  std::string sender;
  std::uint32_t incarnation = 0;
  std::uint64_t number = 0;  ///< place among the sender's samples on the topic, from 1
  std::size_t bytes = 0;
  Lifetime lifetime = Lifetime::once;
  std::string instance{};  ///< the key, with Lifetime::newest
  std::shared_ptr<const void> value{};
};

/// Counts what has become of the samples of a channel, or of several.
struct Counts {
  std::uint64_t offered = 0;     ///< samples that were sent
  std::uint64_t arrived = 0;     ///< of these, at once or later
  std::uint64_t lost = 0;        ///< of these, for good: by chance, or because the link was closed
  std::uint64_t superseded = 0;  ///< of these: a newer one of the instance was sent instead
  std::uint64_t under_way = 0;   ///< of these, at the time of asking
  std::uint64_t repeated = 0;    ///< attempts that were made again
  Counts& operator+=(const Counts&);
  bool operator==(const Counts&) const = default;
};

/// Describes a failed attempt to send a sample.
struct Loss {
  temporal::Time at{};
  LinkSample sample;
  std::uint32_t attempt = 1;
  Fate fate = Fate::lost;
};

/// Bounds the losses that wait to be taken; further ones are only counted.
inline constexpr std::size_t kMostLosses = 65'536;

/// Decides which samples arrive and when, by the link's windows, light time, rate and loss.
class Channel {
 public:
  /// The link must outlive the channel.
  Channel(const Link& link, std::uint64_t seed) : link_(&link), seed_(seed) {}

  /// Takes a sample that is sent now. Returns true if it arrives now; else take() returns it when it arrives,
  /// if it does. Times never go back, in calls of offer() and take() together.
  bool offer(LinkSample, temporal::Time now);

  struct Arrival {
    temporal::Time at{};
    LinkSample sample;
  };
  /// Removes and returns what has arrived by now, in the order of arrival, then of sending.
  std::vector<Arrival> take(temporal::Time now);
  /// Removes and returns what was lost since the last call, in the order of losing.
  std::vector<Loss> take_losses();
  /// Returns when take() or the channel itself has something to do next, or nothing if not before another
  /// offer().
  std::optional<temporal::Time> next() const;

  Counts counts() const;

 private:
  struct Waiting {
    LinkSample sample;
    std::uint32_t attempt = 1;
  };
  using Order = std::pair<temporal::Time, std::uint64_t>;  // ready since, number of the offer
  using Instance = std::pair<std::string, std::pair<std::string, std::string>>;

  void run(temporal::Time now);
  std::optional<temporal::Time> next_start() const;
  void send(Order, Waiting, temporal::Time start);
  void repeat(Order, Waiting, temporal::Time ended);
  void supersede(const LinkSample&, std::uint64_t offer, temporal::Time now);
  void note(temporal::Time at, const LinkSample&, std::uint32_t attempt, Fate);
  bool refuses(const LinkSample&, temporal::Time now) const;
  bool chance_loses(const Waiting&) const;
  temporal::Duration sending_time(const LinkSample&) const;

  const Link* link_;
  std::uint64_t seed_;
  std::uint64_t offers_ = 0;
  temporal::Time free_at_ = -temporal::no_bound;
  std::map<Order, Waiting> waiting_;
  std::map<Order, LinkSample> flying_;        // by arrival
  std::map<Instance, std::uint64_t> newest_;  // the newest offer of each instance
  Counts counts_;
  std::vector<Loss> losses_;
};

/// Returns a number in [0, 1) that depends on these arguments alone.
double chance(std::uint64_t seed, const std::string& link, const LinkSample&, std::uint32_t attempt);

}  // namespace roci::services::link
