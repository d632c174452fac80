// Partings happen in a secure run where one participant has given the other up, which has not given it up.
//
// One of two participants begins a handshake, and both vendors accept its beginning only from an unknown participant.
// One that has lost the other for a lease (by one-way silence, or for want of a processor) and hears it again would
// wait for ever, since the other has lost nothing. It therefore keeps silent towards the other for longer than a
// lease, so that the other gives it up, too, and hears nothing of it meanwhile. This is pure: time comes from the
// caller.
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
  /// Lasts a little longer than a lease (peers.hpp).
  static constexpr std::chrono::seconds kSilence{5};
  /// Delays the silence after giving up: most participants that were given up are gone, are restarted, or have lost
  /// this process as well.
  static constexpr std::chrono::seconds kGrace{8};
  static constexpr std::size_t kParticipants = 1024;  ///< that are kept, and with whom handshakes have ended

  /// Takes in where a participant is reached. One that is reached where another was replaces it. Returns whether a
  /// silence begins: this one was given up, is still there, and has not answered since.
  bool announced(Announcement, Time now);
  /// Takes in a message of this process: an answer says that the other takes part in the handshake; a beginning, to a
  /// participant with whom a handshake went further, says that this process has given it up.
  void sent(std::span<const std::uint8_t> message, Time now);
  /// Takes in that this process has given the participant up.
  void gave_up(const GuidPrefix&, Time now);

  bool any_silence(Time now) const;
  /// Returns whether nothing is heard of this participant now: what it still says to its old acquaintance would
  /// begin a handshake that this process, which knows it anew, cannot end.
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
