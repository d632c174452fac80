// Mutated RTPS messages: the guard reads nothing outside them (shown under AddressSanitizer, since each mutant lies in
// an allocation of its own size) and what it lets through is well-formed when it is read again.
#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "services/vendors/guard/ahead.hpp"
#include "services/vendors/guard/assembly.hpp"
#include "services/vendors/guard/endpoints.hpp"
#include "services/vendors/guard/message.hpp"
#include "tests/contract/hostile/rtps_message.hpp"
#include "tests/fuzz/rounds.hpp"

namespace roci::fuzz {
namespace {

using services::contract::hostile::Bytes;
using services::contract::hostile::kData;
using services::contract::hostile::kEprosima;
using services::contract::hostile::kInlineQos;
using services::contract::hostile::Message;
using services::contract::hostile::Parameters;
using services::contract::hostile::Prefix;
using services::vendors::guard::Assembly;
using services::vendors::guard::DatagramAdmission;
using services::vendors::guard::endpoints_in;
using services::vendors::guard::examine;
using services::vendors::guard::for_each_key_hash;
using services::vendors::guard::kAdmissions;
using services::vendors::guard::limit_leases;
using services::vendors::guard::SamplesAhead;
using services::vendors::guard::strip_farewells;
using services::vendors::guard::strip_vendor_submessages;

std::vector<Bytes> seeds() {
  constexpr Prefix kOwn{1, 15, 1};
  constexpr std::uint32_t kWriter = 0x00000102, kParticipants = 0x000100c2, kEndpoints = 0x000003c2;
  const auto message = [&] { return Message(kOwn, kEprosima); };
  Bytes nack(28);
  nack[12] = nack[16] = 1;
  const Bytes statistics(56, 1),
      guid_hash = Parameters().add_guid(0x70, kOwn, 0x1c1).add(0x71, {0, 0, 0, 1}).list();
  const Bytes participant = Parameters()
                                .add_guid(0x50, kOwn, 0x1c1)
                                .add(2, {0xff, 0xff, 0xff, 0x7f, 0, 0, 0, 0})
                                .add_locator(0x32, 0x7f000001, 7410)
                                .add(0x2c, {4, 0, 0, 0, 'r', 'o', 'c', 'i'})
                                .add(0x59, {1, 0, 0, 0, 2, 0, 0, 0, 'a', 0, 0, 0, 2, 0, 0, 0, 'b', 0})
                                .sample();
  const Bytes writer = Parameters()
                           .add_guid(0x5a, kOwn, kWriter)
                           .add_string(5, "roci/goal")
                           .add_string(7, "roci::v1::Goal")
                           .add_strings(0x29, {"roci.team"})
                           .sample();
  return {
      message().data(0, kParticipants, 1, kData, {}, participant).submessage(0x80, 0, statistics).bytes(),
      message().data(0, kEndpoints, 1, kData, {}, writer).heartbeat(0, kEndpoints, 1, 1, 1).bytes(),
      message().data(0, kParticipants, 2, kInlineQos, guid_hash, {}).bytes(),
      message().data(0, kParticipants, 3, kInlineQos | kData, guid_hash, participant).bytes(),
      message().data(0, kWriter, 1, kInlineQos | kData, guid_hash, Bytes(40, 1)).bytes(),
      message().fragment(0, kWriter, 2, 1, 2, 32, 64, Bytes(64)).gap(0, kWriter, 1, 4, 64).bytes(),
      message().fragment(0, kWriter, 3, 2, 1, 32, 96, Bytes(32)).bytes(),
      message().submessage(0x0e, 0, Bytes(kOwn.begin(), kOwn.end())).acknack(7, kWriter, 1, 1).bytes(),
      message().submessage(0x0e, 0, Bytes(12)).acknack(7, kWriter, 1, 40).submessage(0x12, 0, nack).bytes(),
      message()
          .submessage(0x33, 0, Bytes(24))
          .submessage(0x30, 0, Bytes(64))
          .submessage(0x34, 0, Bytes(20))
          .bytes()};
}

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  Bytes mutate(Bytes bytes) {
    if (below(4) == 0) bytes.resize(below(bytes.size() + 1));
    if (below(8) == 0) bytes.resize(bytes.size() + below(16));
    for (std::size_t flips = below(6); flips > 0 && bytes.size() > 20; --flips) {
      static constexpr std::array<std::uint8_t, 6> kValues{0x00, 0x01, 0x04, 0x7f, 0x80, 0xff};
      const std::size_t at = below(32) == 0 ? below(20) : 20 + below(bytes.size() - 20);
      bytes[at] = below(2) == 0 ? kValues[below(kValues.size())] : static_cast<std::uint8_t>(below(256));
    }
    return bytes;
  }
  std::size_t below(std::size_t bound) { return static_cast<std::size_t>(random_() % bound); }

 private:
  std::mt19937_64 random_;
};

TEST(FuzzGuard, MutatedMessagesAreJudgedWithinTheirBytes) {
  const auto corpus = seeds();
  for (const Bytes& seed : corpus) ASSERT_EQ(examine(seed), DatagramAdmission::pass);
  Mutator mutator(14);
  constexpr std::uint16_t kNobody = 0;  // so that all fragments are put together
  std::array<int, kAdmissions> seen{};
  Assembly assembly;
  SamplesAhead ahead;
  int completed = 0, requested = 0, hashes = 0, endpoints = 0;
  for (int i = 0; i < rounds(100'000); ++i) {
    const Bytes mutant = mutator.mutate(corpus[mutator.below(corpus.size())]);
    const auto exact = std::make_unique<std::uint8_t[]>(mutant.size());
    std::copy(mutant.begin(), mutant.end(), exact.get());
    const std::span<std::uint8_t> datagram(exact.get(), mutant.size());
    const DatagramAdmission admission = examine(datagram);
    ++seen[static_cast<std::size_t>(admission)];
    if (admission != DatagramAdmission::pass) continue;
    const std::size_t size = strip_vendor_submessages(datagram);
    ASSERT_LE(size, datagram.size());
    ASSERT_EQ(examine(datagram.first(size)), DatagramAdmission::pass) << "round " << i;
    const std::size_t left = strip_farewells(datagram.first(size));
    ASSERT_LE(left, size);
    ASSERT_EQ(examine(datagram.first(left)), DatagramAdmission::pass) << "round " << i;
    limit_leases(datagram.first(left));
    for_each_key_hash(datagram.first(left), [&hashes](std::span<std::uint8_t, 16> hash) {
      std::ranges::fill(hash, std::uint8_t{7});
      ++hashes;
    });
    endpoints += static_cast<int>(endpoints_in(datagram.first(left)).size());
    ASSERT_EQ(examine(datagram.first(left)), DatagramAdmission::pass) << "round " << i;
    ahead.acknowledge(datagram.first(left));
    Bytes in_turn(datagram.begin(), datagram.begin() + static_cast<std::ptrdiff_t>(left));
    std::size_t refused = 0;
    in_turn.resize(ahead.take(in_turn, refused));
    ASSERT_TRUE(in_turn.empty() || examine(in_turn) == DatagramAdmission::pass) << "round " << i;
    ASSERT_LE(ahead.bytes(), SamplesAhead::kMostBytes);
    const auto requests = assembly.with_requests(datagram.first(left));
    std::vector<std::vector<std::uint8_t>> whole;
    const std::size_t rest = assembly.take(datagram.first(left), kNobody, whole);
    ASSERT_LE(rest, left);
    if (rest > 0) {
      ASSERT_EQ(examine(datagram.first(rest)), DatagramAdmission::pass) << "round " << i;
    }
    for (const auto& one : whole) ASSERT_EQ(examine(one), DatagramAdmission::pass) << "round " << i;
    ASSERT_LE(assembly.kept_bytes(), Assembly::kMostBytes);
    completed += static_cast<int>(whole.size());
    requested += requests.empty() ? 0 : 1;
  }
  EXPECT_GT(completed, 0);
  EXPECT_GT(requested, 0);
  EXPECT_GT(hashes, 0);
  EXPECT_GT(endpoints, 0);
  EXPECT_GT(ahead.samples(), 0U);
  for (const DatagramAdmission admission :
       {DatagramAdmission::pass, DatagramAdmission::no_rtps, DatagramAdmission::cut,
        DatagramAdmission::unknown_submessage, DatagramAdmission::bad_numbers,
        DatagramAdmission::bad_fragment, DatagramAdmission::oversized, DatagramAdmission::bad_parameters,
        DatagramAdmission::speaks_for_another})
    EXPECT_GT(seen[static_cast<std::size_t>(admission)], 0) << static_cast<int>(admission);
}

}  // namespace
}  // namespace roci::fuzz
