#include "services/vendors/guard/guard.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <chrono>
#include <iostream>

#include "services/vendors/guard/endpoints.hpp"
#include "services/vendors/guard/rtps_ids.hpp"
#include "services/vendors/peers.hpp"

namespace roci::services::vendors::guard {
namespace {

constexpr std::chrono::seconds kBetweenReports{10};

std::string to_text(const std::optional<Source>& source) {
  if (!source) return "an unknown address";
  const in_addr address{htonl(source->address)};
  char text[INET_ADDRSTRLEN] = "";
  inet_ntop(AF_INET, &address, text, sizeof text);
  return std::string(text) + ":" + std::to_string(source->port);
}

}  // namespace

Policy policy_of(const transport::TransportOptions& options) {
  Policy policy;
  policy.secure = options.credentials.has_value();
  if (!options.vendor_xml.empty()) return policy;
  for (const std::string& peer : peers_of(options)) {
    in_addr address{};
    if (inet_pton(AF_INET, peer.c_str(), &address) == 1) policy.peers.push_back(ntohl(address.s_addr));
  }
  return policy;
}

Guard::Guard(Policy policy) : policy_(std::move(policy)), identities_(policy_.secure) {}

std::size_t Guard::admit(std::span<std::uint8_t> datagram, const std::optional<Source>& source) {
  const std::lock_guard lock(mutex_);
  Contents contents;
  const DatagramAdmission admission = judge(datagram, source, contents);
  if (admission == DatagramAdmission::pass) {
    std::size_t left = contents.vendors_own ? strip_vendor_submessages(datagram) : datagram.size();
    if (contents.discovery) limit_leases(datagram.first(left));
    if (contents.discovery && policy_.without_farewells) left = strip_farewells(datagram.first(left));
    if (contents.data && policy_.bounds_ahead && !policy_.secure) left = admit_ahead(datagram.first(left), source);
    if (policy_.secure) left = admit_secure(datagram.first(left));
    if (left > 0) ++counts_[static_cast<std::size_t>(DatagramAdmission::pass)];
    if (left == 0 && policy_.secure) ++counts_[static_cast<std::size_t>(DatagramAdmission::plain)];
    return left;
  }
  refuse(admission, 1, source);
  return 0;
}

void Guard::refuse(DatagramAdmission why, std::size_t times, const std::optional<Source>& source) {
  counts_[static_cast<std::size_t>(why)] += times;
  last_sources_[static_cast<std::size_t>(why)] = source;
  report(why, source);
}

std::size_t Guard::admit_ahead(std::span<std::uint8_t> message, const std::optional<Source>& source) {
  std::size_t refused = 0;
  const std::size_t left = ahead_.take(message, refused);
  if (refused > 0) refuse(DatagramAdmission::too_far_ahead, refused, source);
  return left;
}

// What is left of a message of a secure run.
std::size_t Guard::admit_secure(std::span<std::uint8_t> message) {
  const auto now = std::chrono::steady_clock::now();
  const std::size_t left = strip_plain_submessages(message);
  if (left == 0) return 0;
  put_plain_submessages_first(message.first(left));
  auto news = announcement_in(message.first(left));
  if (!news && !silent_) return left;
  const std::lock_guard lock(partings_mutex_);
  if (news && partings_.announced(*std::move(news), now)) tell_of_parting();
  silent_ = partings_.any_silence(now);
  return partings_.is_deaf_to(sender_of(message), now) ? 0 : left;
}

void Guard::sent(std::span<const std::uint8_t> datagram) {
  if (!policy_.bounds_ahead) return;
  const std::lock_guard lock(mutex_);
  ahead_.acknowledge(datagram);
}

bool Guard::keeps_back(std::span<const std::uint8_t> datagram, const Source& destination) {
  if (!policy_.secure || datagram.size() <= kHeaderSize) return false;
  const bool encrypted = datagram[kHeaderSize] == kSrtpsPrefix;
  if (encrypted && !silent_) return false;
  const auto now = std::chrono::steady_clock::now();
  const std::lock_guard lock(partings_mutex_);
  if (!encrypted) partings_.sent(datagram, now);
  return partings_.keeps_back(destination, now);
}

void Guard::gave_up(const GuidPrefix& other) {
  if (!policy_.secure) {
    const std::lock_guard lock(mutex_);
    return ahead_.gave_up(other);
  }
  const std::lock_guard lock(partings_mutex_);
  partings_.gave_up(other, std::chrono::steady_clock::now());
}

void Guard::tell_of_parting() {
  std::cerr
      << "a participant of this secure run was given up and is still there; nothing is said to it for " +
             std::to_string(Partings::kSilence.count()) + " s, so that both shake hands anew\n"
      << std::flush;
}

// The sender comes first: of a stranger nothing is read.
DatagramAdmission Guard::judge(std::span<const std::uint8_t> datagram, const std::optional<Source>& source,
                               Contents& contents) {
  const auto& peers = policy_.peers;
  if (!peers.empty() && (!source || std::find(peers.begin(), peers.end(), source->address) == peers.end()))
    return DatagramAdmission::stranger;
  const DatagramAdmission admission = examine(datagram, contents);
  if (admission != DatagramAdmission::pass || !source) return admission;
  const auto now = std::chrono::steady_clock::now();
  const DatagramAdmission claimed = identities_.claim(sender_of(datagram), *source, now);
  if (claimed != DatagramAdmission::pass) return claimed;
  if (contents.discovery && !identities_.announce(sender_of(datagram), endpoints_in(datagram), now))
    return DatagramAdmission::crowd;
  const bool may_skip = gap_budget_.take(*source, sender_of(datagram), contents.skipped, now);
  return may_skip ? DatagramAdmission::pass : DatagramAdmission::bad_numbers;
}

// The first at once, then one line for all of ten seconds.
void Guard::report(DatagramAdmission admission, const std::optional<Source>& source) {
  const auto now = std::chrono::steady_clock::now();
  if (last_report_ && now - *last_report_ < kBetweenReports) return;
  last_report_ = now;
  std::string text;
  for (std::size_t i = 1; i < kAdmissions; ++i) {
    if (counts_[i] == reported_[i]) continue;
    text += (text.empty() ? "" : ", ") + std::to_string(counts_[i] - reported_[i]) + " " +
            std::string(kAdmissionNames[i]);
  }
  reported_ = counts_;
  // Plug-ins log by themselves: the log of services belongs to the program.
  text = "datagrams refused before DDS reads them: " + text + "; the last one, " +
         std::string(kAdmissionNames[static_cast<std::size_t>(admission)]) + ", from " + to_text(source) +
         "\n";
  std::cerr << text << std::flush;
}

std::array<std::uint64_t, kAdmissions> Guard::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

std::vector<transport::RefusedDatagrams> Guard::refused() const {
  const std::lock_guard lock(mutex_);
  std::vector<transport::RefusedDatagrams> out;
  for (std::size_t i = 1; i < kAdmissions; ++i) {
    // What a secure run leaves out as plain text is everyday.
    if (counts_[i] == 0 || i == static_cast<std::size_t>(DatagramAdmission::plain)) continue;
    const auto& source = last_sources_[i];
    out.push_back({std::string(kAdmissionNames[i]), counts_[i], source ? to_text(source) : ""});
  }
  return out;
}

}  // namespace roci::services::vendors::guard
