// Who has given a participant up of a secure run that has not given it up.
//
// A handshake is begun by one of two participants, and both vendors take its beginning from somebody unknown alone. One
// that has lost the other for a lease (a stretch of one-way silence, or no processor for so long) and hears it again
// waits for good: the other one has lost nothing. So it says nothing to the other one for longer than a lease, and that
// one gives it up, too; and hears nothing of it meanwhile. Pure: time comes from the caller.
#pragma once

#include <map>
#include <set>
#include <span>
#include <vector>

#include "services/vendors/guard/discovery.hpp"
#include "services/vendors/guard/identities.hpp"

namespace roci::services::vendors::guard {

/// Knows with whom this process is silent now (docs/dds.md, quirk 18).
class Partings {
 public:
  using Time = Identities::Time;
  /// A lease (peers.hpp) and some.
  static constexpr std::chrono::seconds kSilence{5};
  /// From giving up to silence: most that were given up are gone, are started anew, or have lost this process as well.
  static constexpr std::chrono::seconds kGrace{8};
  static constexpr std::size_t kParticipants = 1024;  ///< that are kept, and with whom handshakes have ended

  /// Takes in where a participant is spoken to. One that comes where another was takes its place. Returns whether a
  /// silence begins: this one was given up, is still there, and has not answered since.
  bool announced(Announcement, Time now);
  /// Takes in a message of this process: an answer says that the other one takes part in the handshake; a beginning, to
  /// somebody with whom one went further, that this process has given it up.
  void sent(std::span<const std::uint8_t> message, Time now);
  /// This process has given the participant up.
  void gave_up(const GuidPrefix&, Time now);

  bool any_silence(Time now) const;
  /// Returns whether nothing is heard of this participant now: what it says to the one that it knew would begin a
  /// handshake that the one that knows it anew cannot end.
  bool is_deaf_to(const GuidPrefix&, Time now) const;
  /// Returns whether nothing is to be sent there now.
  bool keeps_back(const Source& destination, Time now) const;

 private:
  std::map<GuidPrefix, std::vector<Source>> reached_at_;
  std::set<GuidPrefix> answered_;        // a handshake went so far that its beginning is no repetition
  std::map<GuidPrefix, Time> given_up_;  // and not answered since
  std::map<GuidPrefix, Time> silent_since_;
};

}  // namespace roci::services::vendors::guard
