// The guard stands between the network and a vendor's parser.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "services/transport/refused_datagrams.hpp"
#include "services/transport/transport.hpp"
#include "services/vendors/guard/ahead.hpp"
#include "services/vendors/guard/gaps.hpp"
#include "services/vendors/guard/identities.hpp"
#include "services/vendors/guard/message.hpp"
#include "services/vendors/guard/partings.hpp"

namespace roci::services::vendors::guard {

/// Says whose datagrams a guard takes, and what of them.
struct Policy {
  /// Lists whose datagrams are taken, as IPv4 addresses in host byte order; empty: anybody's (a vendor's own XML says
  /// whose).
  std::vector<std::uint32_t> peers;
  /// Says that plain text is refused but for what DDS Security cannot encrypt, and that GUID prefixes are those of
  /// certificates.
  bool secure = false;
  /// Says that no farewell of a participant is let through, so that each is given up when its lease is over.
  bool without_farewells = false;
  /// Says that samples which came before one that is missing are bounded (ahead.hpp), in a plain run.
  bool bounds_ahead = false;
};

/// Returns the policy that takes the peers of these options (peers_of), this host among them; with vendor_xml
/// it takes everybody.
Policy policy_of(const transport::TransportOptions&);

/// Lets the vendor see nothing that it refuses. There is one for each participant or, with Cyclone DDS, for
/// each domain of the process. Any thread may call it.
class Guard {
 public:
  explicit Guard(Policy);

  /// Returns how many bytes the vendor may read at the beginning of `datagram`, which may have been changed; 0: none.
  /// `source` is missing where it has no IPv4 address.
  std::size_t admit(std::span<std::uint8_t> datagram, const std::optional<Source>& source);

  bool is_secure() const { return policy_.secure; }
  /// Takes in what this process sends in a plain run.
  void sent(std::span<const std::uint8_t> datagram);
  /// Takes in, in a secure run, what this process sends, and returns whether nothing may be sent to this
  /// destination now (partings.hpp).
  bool keeps_back(std::span<const std::uint8_t> datagram, const Source& destination);
  /// Takes in that the vendor has given this participant up.
  void gave_up(const GuidPrefix&);

  /// How many datagrams had each admission.
  std::array<std::uint64_t, kAdmissions> counts() const;
  /// The same for operators, without those that passed and those that were left out as plain text.
  std::vector<transport::RefusedDatagrams> refused() const;

 private:
  DatagramAdmission judge(std::span<const std::uint8_t> datagram, const std::optional<Source>&, Contents&);
  std::size_t admit_secure(std::span<std::uint8_t> message);
  std::size_t admit_ahead(std::span<std::uint8_t> message, const std::optional<Source>&);
  void refuse(DatagramAdmission, std::size_t times, const std::optional<Source>&);
  void report(DatagramAdmission, const std::optional<Source>&);
  static void tell_of_parting();

  const Policy policy_;
  mutable std::mutex mutex_;
  Identities identities_;
  GapBudget gap_budget_;
  SamplesAhead ahead_;
  std::array<std::uint64_t, kAdmissions> counts_{};
  std::array<std::optional<Source>, kAdmissions> last_sources_{};
  std::array<std::uint64_t, kAdmissions> reported_{};
  std::optional<Identities::Time> last_report_;

  // Encrypted datagrams, both ways, bypass this lock as long as there is no silence.
  std::mutex partings_mutex_;
  Partings partings_;
  std::atomic<bool> silent_ = false;
};

}  // namespace roci::services::vendors::guard
