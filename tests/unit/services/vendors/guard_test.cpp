// What the guard lets through to a vendor's parser, and what it does not.
#include "services/vendors/guard/guard.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "tests/contract/hostile/rtps_message.hpp"

namespace roci::services::vendors::guard {
namespace {

using contract::hostile::Bytes;
using contract::hostile::kData;
using contract::hostile::kEclipse;
using contract::hostile::kEprosima;
using contract::hostile::kInlineQos;
using contract::hostile::kKey;
using contract::hostile::Message;
using contract::hostile::Parameters;
using contract::hostile::Prefix;

constexpr Prefix kOwn{1, 15, 1}, kOther{1, 15, 2};
constexpr std::uint32_t kUserWriter = 0x00000102, kParticipants = 0x000100c2, kLiveliness = 0x000200c2;
const Bytes kPayload{0, 1, 0, 0, 1, 2, 3, 4};
const Bytes kLease{3, 0, 0, 0, 0, 0, 0, 0};  // of 3 s

Message own() { return {kOwn, kEprosima}; }
DatagramAdmission judge(const Message& message) { return examine(message.bytes()); }

TEST(Guard, WhatVendorsSendPasses) {
  EXPECT_EQ(judge(own().data(0, kUserWriter, 1, kData, {}, kPayload)), DatagramAdmission::pass);
  EXPECT_EQ(judge(own().data(0, kUserWriter, 1, kInlineQos, Parameters().add(0x70, Bytes(16)).list(), {})),
            DatagramAdmission::pass);
  EXPECT_EQ(judge(own().heartbeat(0, kUserWriter, 1, 0, 1)), DatagramAdmission::pass)
      << "nothing written yet";
  EXPECT_EQ(judge(own().gap(0, kUserWriter, 1, 200, 32)), DatagramAdmission::pass);
  EXPECT_EQ(judge(own().acknack(7, kUserWriter, 0, 0)), DatagramAdmission::pass)
      << "Fast DDS, before it knows the writer";
  EXPECT_EQ(judge(own().fragment(0, kUserWriter, 1, 2, 1, 8, 12, Bytes(4))), DatagramAdmission::pass)
      << "the last one is short";
  EXPECT_EQ(
      judge(
          own().submessage(0x33, 0, Bytes(24)).submessage(0x30, 0, Bytes(64)).submessage(0x34, 0, Bytes(20))),
      DatagramAdmission::pass)
      << "encrypted";
}

// SEC_BODY says its length itself, high byte first.
Bytes encrypted(std::uint8_t length) {
  Bytes body(4 + length);
  body[3] = length;
  return body;
}

TEST(Guard, InASecureRunNothingButTheHandshakeIsPlain) {
  constexpr std::uint32_t kHandshake = 0x000201c3, kExchange = 0xff0202c3;
  // How many bytes less than were sent; all: nothing is left to be read.
  const auto lost = [](const Message& message) {
    Bytes bytes = message.bytes();
    EXPECT_EQ(examine(bytes), DatagramAdmission::pass);
    return bytes.size() - strip_plain_submessages(bytes);
  };
  const auto all = [](const Message& message) { return message.bytes().size(); };
  const auto whole =
      own().submessage(0x33, 0, Bytes(20)).submessage(0x30, 0, encrypted(64)).submessage(0x34, 0, Bytes(20));
  const auto handshake = own().data(0, kHandshake, 1, kData, {}, kPayload);
  EXPECT_EQ(lost(whole), 0U);
  EXPECT_EQ(lost(handshake), 0U);
  EXPECT_EQ(lost(own()
                     .submessage(0x31, 0, Bytes(20))
                     .submessage(0x30, 0, encrypted(64))
                     .submessage(0x32, 0, Bytes(20))),
            0U)
      << "keys are exchanged so";
  for (const Message& plain :
       {own().data(0, kExchange, 1, kData, {}, kPayload), own().data(0, kUserWriter, 1, kData, {}, kPayload),
        own().heartbeat(0, kUserWriter, 1, 0, 1), own().acknack(7, kUserWriter, 1, 0),
        own().gap(0, kUserWriter, 1, 200, 32), own().submessage(0x0e, 0, Bytes(12))})
    EXPECT_EQ(lost(plain), all(plain));
  // Cyclone DDS sends its handshake so.
  EXPECT_EQ(lost(own().acknack(7, kUserWriter, 1, 0).data(0, kHandshake, 1, kData, {}, kPayload)),
            all(own().acknack(7, kUserWriter, 1, 0)) - all(own()));
}

// A parser that meets no prefix at the beginning reads the rest in plain, and so does one that has read the postfix.
TEST(Guard, AnEncryptedMessageIsNothingElse) {
  const auto left = [](const Message& message) {
    Bytes bytes = message.bytes();
    return strip_plain_submessages(bytes);
  };
  EXPECT_EQ(left(own().submessage(0x33, 0, Bytes(20)).data(0, kUserWriter, 1, kData, {}, kPayload)), 0U);
  EXPECT_EQ(left(own()
                     .submessage(0x01, 0, Bytes(4))
                     .submessage(0x33, 0, Bytes(20))
                     .data(0, kUserWriter, 1, kData, {}, kPayload)),
            0U);
  const auto before = own().submessage(0x30, 0, encrypted(8));
  EXPECT_EQ(left(own()
                     .submessage(0x33, 0, Bytes(20))
                     .submessage(0x30, 0, encrypted(8))
                     .submessage(0x34, 0, Bytes(20))
                     .heartbeat(0, kUserWriter, 1, 0, 1)),
            before.bytes().size())
      << "the body alone, which nobody can decrypt";
}

// Who cannot decrypt what precedes the end of a handshake reads no further, and can never decrypt it.
TEST(Guard, InASecureRunTheHandshakePrecedesWhatItMakesReadable) {
  constexpr std::uint32_t kHandshake = 0x000201c3;
  const auto with_keys = [](Message message) {
    return message.submessage(0x31, 0, Bytes(20))
        .submessage(0x30, 0, encrypted(64))
        .submessage(0x32, 0, Bytes(20));
  };
  const auto with_handshake = [](Message message) {
    return message.submessage(0x09, 0, Bytes(8)).data(0, kHandshake, 1, kData, {}, kPayload);
  };
  const auto to = [](std::uint8_t whom) { return own().submessage(0x0e, 0, Bytes(12, whom)); };
  const auto ordered = [](const Message& message) {
    Bytes bytes = message.bytes();
    put_plain_submessages_first(bytes);
    return bytes;
  };
  EXPECT_EQ(ordered(with_handshake(with_keys(to(1)))), with_keys(with_handshake(to(1))).bytes());
  EXPECT_EQ(ordered(with_keys(with_handshake(to(1)))), with_keys(with_handshake(to(1))).bytes());
  EXPECT_EQ(ordered(with_keys(to(1))), with_keys(to(1)).bytes());
  const auto for_two = with_handshake(with_keys(to(1)).submessage(0x0e, 0, Bytes(12, 2)));
  EXPECT_EQ(ordered(for_two), for_two.bytes());
  // What is for everybody does not become what is for one.
  const auto for_all = with_handshake(with_keys(own()).submessage(0x0e, 0, Bytes(12, 2)));
  EXPECT_EQ(ordered(for_all), for_all.bytes());
  const auto times = with_keys(with_keys(to(1)).submessage(0x09, 0, Bytes(8)));
  EXPECT_EQ(ordered(times), times.bytes());
  const auto whole =
      own().submessage(0x33, 0, Bytes(20)).submessage(0x30, 0, encrypted(64)).submessage(0x34, 0, Bytes(20));
  EXPECT_EQ(ordered(whole), whole.bytes());
  // Through the guard, as a vendor's parser gets it.
  Bytes received = with_handshake(with_keys(to(1))).bytes();
  EXPECT_EQ(Guard({.peers = {}, .secure = true}).admit(received, std::nullopt), received.size());
  EXPECT_EQ(received, with_keys(with_handshake(to(1))).bytes());
}

TEST(Guard, LengthsOfWhatIsEncryptedFit) {
  EXPECT_EQ(judge(own().submessage(0x33, 0, Bytes(16))), DatagramAdmission::cut);
  Bytes lying = encrypted(8);
  lying[3] = 9;
  EXPECT_EQ(judge(own().submessage(0x30, 0, lying)), DatagramAdmission::cut);
  Bytes codes(40);
  codes[19] = 1;
  EXPECT_EQ(judge(own().submessage(0x34, 0, codes)), DatagramAdmission::pass);
  codes[19] = 2;
  EXPECT_EQ(judge(own().submessage(0x34, 0, codes)), DatagramAdmission::cut);
}

TEST(Identities, InASecureRunAPrefixNamesItsPortBehindTheCertificate) {
  Identities identities(true);
  const Source source{0x7f000001, 0x9c40}, other{0x7f000001, 0x9c41};
  GuidPrefix certified{0x80, 1, 2, 3, 4, 5, 0x9c, 0x40, 6, 7, 8, 9};
  const auto now = std::chrono::steady_clock::now();
  EXPECT_EQ(identities.claim(certified, other, now), DatagramAdmission::taken_identity);
  EXPECT_EQ(identities.claim(certified, source, now), DatagramAdmission::pass);
  EXPECT_EQ(identities.claim({0x01, 0x0f, 2, 3, 4, 5, 0x9c, 0x40}, source, now),
            DatagramAdmission::taken_identity);
  EXPECT_TRUE(may_speak_for(certified, certified));
  GuidPrefix twin = certified, stranger = certified;
  twin[11] = 0;     // of the same process
  stranger[7] = 0;  // another one with the same certificate
  EXPECT_TRUE(may_speak_for(certified, twin));
  EXPECT_FALSE(may_speak_for(certified, stranger));
}

TEST(Guard, EachKindOfDamageHasItsVerdict) {
  EXPECT_EQ(examine(Bytes(19)), DatagramAdmission::no_rtps);
  EXPECT_EQ(examine(Bytes(64)), DatagramAdmission::no_rtps);
  Bytes cut = own().heartbeat(0, kUserWriter, 1, 1, 1).bytes();
  cut.resize(cut.size() - 4);
  EXPECT_EQ(examine(cut), DatagramAdmission::cut);
  EXPECT_EQ(judge(own().submessage(0x07, 0, Bytes(24))), DatagramAdmission::cut) << "shorter than its kind";
  EXPECT_EQ(judge(own().submessage(0x0f, 0, Bytes(24))), DatagramAdmission::unknown_submessage);
  EXPECT_EQ(judge(own().submessage(0x44, 0, Bytes(24))), DatagramAdmission::unknown_submessage);
  EXPECT_EQ(judge(own().heartbeat(0, kUserWriter, 0, 1, 1)), DatagramAdmission::bad_numbers);
  EXPECT_EQ(judge(own().heartbeat(0, kUserWriter, 5, 3, 1)), DatagramAdmission::bad_numbers);
  EXPECT_EQ(judge(own().gap(0, kUserWriter, 2, std::int64_t{1} << 30, 0)), DatagramAdmission::bad_numbers);
  EXPECT_EQ(judge(own().acknack(7, kUserWriter, 1, 257)), DatagramAdmission::bad_numbers);
  EXPECT_EQ(judge(own().nack_fragments(7, kUserWriter, 1, kMaxSampleBytes, 256, 0xff, 1)), DatagramAdmission::pass);
  EXPECT_EQ(judge(own().nack_fragments(7, kUserWriter, 1, 0xffffff00, 256, 0xff, 1)), DatagramAdmission::bad_numbers)
      << "no sample has as many; Cyclone DDS tells of each in its log";
  EXPECT_EQ(judge(own().data(0, kUserWriter, 0, kData, {}, kPayload)), DatagramAdmission::bad_numbers);
  EXPECT_EQ(judge(own().data(0, kUserWriter, 1, kData | kKey, {}, kPayload)), DatagramAdmission::cut);
  EXPECT_EQ(judge(own().data(0, kUserWriter, 1, kInlineQos | kData, {}, kPayload)),
            DatagramAdmission::bad_parameters);
  EXPECT_EQ(judge(own().data(0, kUserWriter, 1, kInlineQos, Parameters().add(0x70, Bytes(8)).list(), {})),
            DatagramAdmission::bad_parameters);
}

// Fast DDS walks through each number of a GAP, and keeps those that it cannot place yet.
TEST(Guard, TheGapsOfOneDatagramAreBoundedInAll) {
  constexpr std::int64_t kStep = std::int64_t{1} << 18, kLongest = std::int64_t{1} << 28;
  EXPECT_EQ(judge(own().gap(0, kUserWriter, 1, kLongest, 0)), DatagramAdmission::pass)
      << "what a late joiner is told by a writer with a long past";
  EXPECT_EQ(judge(own().gap(0, kUserWriter, 2, 2 + kStep, 0)), DatagramAdmission::pass);
  Message chain = own(), walks = own();
  for (std::int64_t k = 0; k < 2; ++k) {
    chain.gap(0, kUserWriter, 2 + k * kStep, 2 + (k + 1) * kStep, 0);
    walks.gap(0, kUserWriter, 1, kLongest, 0);
  }
  EXPECT_EQ(judge(chain), DatagramAdmission::bad_numbers);
  EXPECT_EQ(judge(walks), DatagramAdmission::bad_numbers);
  Message holes = own();
  for (std::int64_t k = 0; k <= kStep / 256; ++k) holes.gap(0, kUserWriter, 2 + 256 * k, 2 + 256 * k, 256);
  EXPECT_EQ(judge(holes), DatagramAdmission::bad_numbers) << "the bits of its lists count, too";
  constexpr std::int64_t kLast = std::numeric_limits<std::int64_t>::max();
  for (const std::int64_t from : {1, 2})
    EXPECT_EQ(judge(own().gap(0, kUserWriter, from, kLast, 256)), DatagramAdmission::bad_numbers)
        << "their sum has no 64 bits";
}

TEST(Guard, TheGapsOfOneSocketAreBoundedInTime) {
  using namespace std::chrono_literals;
  constexpr Source kSource{0x7f000001, 7413}, kAnother{0x7f000001, 7415};
  const GapBudget::Time start{1000s};
  for (const SkippedNumbers& most : {SkippedNumbers{SkippedNumbers::kMostFromStart, 0},
                                    SkippedNumbers{0, SkippedNumbers::kMostFurtherUp}}) {
    GapBudget budget;
    int taken = 0;
    while (taken < 100 && budget.take(kSource, {}, most, start)) ++taken;
    EXPECT_EQ(taken, most.from_start > 0 ? 1 : 4);
    EXPECT_FALSE(budget.take(kSource, {}, most, start + 1s));
    EXPECT_TRUE(budget.take(kAnother, {}, most, start + 1s)) << "nobody spends what is another's";
    EXPECT_TRUE(budget.take(kSource, {}, {}, start + 1s));
    EXPECT_TRUE(budget.take(kSource, {}, most, start + 9s)) << "a writer that says it again is heard";
  }
  Guard guard(Policy{{kSource.address}});
  const auto admits = [&](std::int64_t from) {
    Bytes bytes = own().gap(0, kUserWriter, from, from + SkippedNumbers::kMostFurtherUp, 0).bytes();
    return guard.admit(bytes, kSource) > 0;
  };
  for (std::int64_t k = 0; k < 4; ++k) EXPECT_TRUE(admits(2 + k * SkippedNumbers::kMostFurtherUp));
  EXPECT_FALSE(admits(2));
}

// Fast DDS aborts on a list of 256 numbers behind the last one there is.
TEST(Guard, NumbersThatNoWriterReachesAreNotBelieved) {
  for (const std::int64_t number : {kHighestNumber, kHighestNumber + 1, std::numeric_limits<std::int64_t>::max()}) {
    const auto wanted = number == kHighestNumber ? DatagramAdmission::pass : DatagramAdmission::bad_numbers;
    EXPECT_EQ(judge(own().heartbeat(0, kUserWriter, 1, number, 1)), wanted) << number;
    EXPECT_EQ(judge(own().heartbeat(0, kUserWriter, number, number, 1)), wanted) << number;
    EXPECT_EQ(judge(own().acknack(7, kUserWriter, number, 0)), wanted) << number;
    EXPECT_EQ(judge(own().gap(0, kUserWriter, number, number, 0)), wanted) << number;
    EXPECT_EQ(judge(own().data(0, kUserWriter, number, kData, {}, kPayload)), wanted) << number;
    EXPECT_EQ(judge(own().fragment(0, kUserWriter, number, 1, 2, 8, 16, Bytes(16))), wanted) << number;
  }
}

// Fast DDS walks to the first number of a HEARTBEAT one by one.
TEST(Guard, TheStartsOfWritersAreBoundedInTime) {
  using namespace std::chrono_literals;
  constexpr Source kSource{0x7f000001, 7413}, kAnother{0x7f000001, 7415};
  constexpr std::int64_t kMost = SkippedNumbers::kMostFromStart / GapBudget::kCostOfStart;
  const GapBudget::Time start{1000s};
  const GuidPrefix one{1}, two{2};
  const auto from = [](std::uint32_t writer, std::int64_t first) {
    return SkippedNumbers{0, 0, {{writer, first}}};
  };
  GapBudget budget;
  EXPECT_FALSE(budget.take(kSource, one, from(7, kHighestNumber), start));
  EXPECT_TRUE(budget.take(kSource, one, from(7, kMost), start)) << "a writer with a long past";
  EXPECT_TRUE(budget.take(kSource, one, from(7, kMost), start)) << "it says so again and again";
  EXPECT_TRUE(budget.take(kSource, one, from(7, kMost + 1000), start)) << "and goes on";
  EXPECT_FALSE(budget.take(kSource, one, from(8, kMost), start)) << "another writer has a walk of its own";
  EXPECT_FALSE(budget.take(kSource, two, from(7, kMost), start)) << "so has one of another participant";
  EXPECT_TRUE(budget.take(kAnother, one, from(7, kMost), start)) << "nobody spends what is another's";
  EXPECT_TRUE(budget.take(kSource, one, from(8, kMost), start + 9s)) << "a writer that says it again is heard";
  GapBudget crowd;
  for (std::uint32_t writer = 0; writer < 4 * GapBudget::kStarts; ++writer)
    EXPECT_TRUE(crowd.take(kSource, one, from(writer, SkippedNumbers::kFreeStart + 1), start));
  EXPECT_FALSE(crowd.take(kSource, one, {0, 0, std::vector<WriterStart>(GapBudget::kStarts + 1, {7, 1 << 17})},
                          start));
  for (std::uint16_t port = 0; port < 3 * GapBudget::kSockets; ++port)
    EXPECT_TRUE(crowd.take({1, port}, one, from(7, SkippedNumbers::kFreeStart + 1), start + 1s * port));
  Guard guard(Policy{{kSource.address}});
  const auto admits = [&](std::int64_t first) {
    Bytes bytes = own().heartbeat(0, kUserWriter, first, first, 1).bytes();
    return guard.admit(bytes, kSource) > 0;
  };
  EXPECT_TRUE(admits(1000));
  EXPECT_TRUE(admits(kMost));
  EXPECT_TRUE(admits(kMost));
  EXPECT_FALSE(admits(3 * kMost));
}

TEST(Guard, FragmentsLieWithinTheirSampleAndAreThere) {
  const auto fragment = [](std::uint32_t first, std::uint16_t count, std::uint16_t size, std::uint32_t sample,
                           std::size_t there) {
    return judge(own().fragment(0, kUserWriter, 1, first, count, size, sample, Bytes(there)));
  };
  EXPECT_EQ(fragment(1, 2, 8, 16, 16), DatagramAdmission::pass);
  EXPECT_EQ(fragment(1, 2, 8, 16, 8), DatagramAdmission::bad_fragment);
  EXPECT_EQ(fragment(0, 1, 8, 16, 8), DatagramAdmission::bad_fragment);
  EXPECT_EQ(fragment(1, 0, 8, 16, 8), DatagramAdmission::bad_fragment);
  EXPECT_EQ(fragment(1, 1, 0, 16, 8), DatagramAdmission::bad_fragment);
  EXPECT_EQ(fragment(3, 1, 8, 16, 8), DatagramAdmission::bad_fragment);
  EXPECT_EQ(fragment(0xffffffff, 0xffff, 0xffff, 16, 8), DatagramAdmission::bad_fragment);
  EXPECT_EQ(fragment(1, 1, 8, kMaxSampleBytes + 1, 8), DatagramAdmission::oversized);
  EXPECT_EQ(judge(own().fragment(0, kParticipants, 1, 1, 1, 8, 16, Bytes(8))),
            DatagramAdmission::bad_fragment)
      << "discovery comes in one piece";
}

TEST(Guard, ASenderSpeaksInDiscoveryForItselfAlone) {
  constexpr std::uint32_t kWho = 0x000001c1;
  const auto told = [](const Prefix& whose) {
    return Parameters().add_guid(0x50, whose, kWho).add(2, kLease).sample();
  };
  const auto hash = [](const Prefix& whose) { return Parameters().add_guid(0x70, whose, kWho).list(); };
  const auto discovery = [](std::uint8_t flags, const Bytes& qos, const Bytes& payload) {
    return judge(own().data(0, kParticipants, 1, flags, qos, payload));
  };
  EXPECT_EQ(discovery(kData, {}, told(kOwn)), DatagramAdmission::pass);
  EXPECT_EQ(discovery(kInlineQos, hash(kOwn), {}), DatagramAdmission::pass);
  EXPECT_EQ(discovery(kData, {}, told(kOther)), DatagramAdmission::speaks_for_another);
  EXPECT_EQ(discovery(kKey, {}, told(kOther)), DatagramAdmission::speaks_for_another);
  EXPECT_EQ(discovery(kInlineQos, hash(kOther), {}), DatagramAdmission::speaks_for_another);
  EXPECT_EQ(discovery(kInlineQos | kData, hash(kOther), told(kOwn)), DatagramAdmission::speaks_for_another);
  EXPECT_EQ(discovery(kKey, {}, Bytes(16, 1)), DatagramAdmission::bad_parameters) << "a bare GUID";
  Bytes alive{0, 1, 0, 0};
  alive.insert(alive.end(), kOther.begin(), kOther.end());
  alive.resize(24);
  EXPECT_EQ(judge(own().data(0, kLiveliness, 1, kData, {}, alive)), DatagramAdmission::speaks_for_another);
  Bytes source(8);
  source.insert(source.end(), kOther.begin(), kOther.end());
  EXPECT_EQ(judge(own().submessage(0x0c, 0, source)), DatagramAdmission::speaks_for_another);
}

TEST(Guard, ParticipantsOfOneCycloneProcessSpeakForEachOther) {
  const Prefix first{'R', 'o', 1, 2, 3}, second{'R', 'o', 1, 2, 4}, elsewhere{'R', 'o', 1, 3, 4};
  const auto says = [&](const Prefix& of) {
    return judge(Message(first, kEclipse)
                     .data(0, kParticipants, 1, kData, {},
                           Parameters().add_guid(0x50, of, 0x1c1).add(2, kLease).sample()));
  };
  EXPECT_EQ(says(second), DatagramAdmission::pass);
  EXPECT_EQ(says(elsewhere), DatagramAdmission::speaks_for_another);
}

TEST(Guard, DiscoveryWhoseTextsDoNotFitIsRefused) {
  constexpr std::uint32_t kWriters = 0x000003c2;
  const auto discovery = [](const Parameters& parameters) {
    return judge(own().data(0, kWriters, 1, kData, {}, parameters.sample()));
  };
  EXPECT_EQ(discovery(Parameters().add_string(5, "roci/goal").add_strings(0x29, {"a", "b"})),
            DatagramAdmission::pass);
  EXPECT_EQ(discovery(Parameters().add(5, {0xff, 0xff, 0xff, 0x7f, 'a', 0, 0, 0})),
            DatagramAdmission::bad_parameters);
  EXPECT_EQ(discovery(Parameters().add_u32(0x59, 0x40000000)), DatagramAdmission::bad_parameters);
  EXPECT_EQ(discovery(Parameters().add(0x59, {1, 0, 0, 0, 4, 0, 0, 0, 'a', 'b', 'c', 0})),
            DatagramAdmission::bad_parameters)
      << "a property without its value";
  EXPECT_EQ(discovery(Parameters().add(0x32, Bytes(20))), DatagramAdmission::bad_parameters);
  EXPECT_EQ(discovery(Parameters().add_string(5, std::string(kMaxDiscoveryBytes - 100, 'x'))), DatagramAdmission::pass);
  EXPECT_EQ(discovery(Parameters().add_string(5, std::string(kMaxDiscoveryBytes, 'x'))), DatagramAdmission::oversized);
}

TEST(Guard, VendorsOwnSubmessagesAreTakenOut) {
  const Bytes bare = own().heartbeat(0, kUserWriter, 1, 2, 3).acknack(7, kUserWriter, 1, 0).bytes();
  Bytes with = own()
                   .heartbeat(0, kUserWriter, 1, 2, 3)
                   .submessage(0x81, 0, Bytes(8, 1))
                   .acknack(7, kUserWriter, 1, 0)
                   .submessage(0x80, 0, Bytes(56, 0xff))
                   .bytes();
  ASSERT_EQ(examine(with), DatagramAdmission::pass);
  with.resize(strip_vendor_submessages(with));
  EXPECT_EQ(with, bare);
}

// As both vendors say it, and two other ways that the protocol permits.
TEST(Guard, AFarewellIsTakenOutOfItsMessage) {
  constexpr std::uint32_t kReader = 0x000100c7, kParticipant = 0x000001c1;
  const Bytes gone = Parameters().add_guid(0x0070, kOwn, kParticipant).add(0x0071, {0, 0, 0, 3}).list();
  const Bytes alive = Parameters().add(0x0071, {0, 0, 0, 0}).list();
  const Bytes name = Parameters().add_guid(0x0050, kOwn, kParticipant).add(2, kLease).sample();
  const auto stripped = [](const Message& message) {
    Bytes bytes = message.bytes();
    EXPECT_EQ(examine(bytes), DatagramAdmission::pass);
    bytes.resize(strip_farewells(bytes));
    return bytes;
  };
  const Message rest = own().heartbeat(0, kUserWriter, 1, 1, 1);
  const auto with = [&](std::uint8_t flags, const Bytes& qos, const Bytes& payload) {
    return own().data(kReader, kParticipants, 7, flags, qos, payload).heartbeat(0, kUserWriter, 1, 1, 1);
  };
  EXPECT_EQ(stripped(with(kInlineQos | kKey, gone, name)), rest.bytes());
  EXPECT_EQ(stripped(with(kInlineQos, gone, {})), rest.bytes());
  EXPECT_EQ(stripped(with(kInlineQos | kData, gone, name)), rest.bytes());
  EXPECT_EQ(stripped(with(kInlineQos | kData, alive, name)), with(kInlineQos | kData, alive, name).bytes());
  EXPECT_EQ(stripped(with(kData, {}, name)), with(kData, {}, name).bytes()) << "an announcement";
  const Message of_a_user = own().data(0, kUserWriter, 7, kInlineQos, gone, {});
  EXPECT_EQ(stripped(of_a_user), of_a_user.bytes()) << "an instance of a topic";
}

TEST(Guard, LetsNoFarewellThroughWhereItsPolicySaysSo) {
  constexpr std::uint32_t kReader = 0x000100c7;
  const Bytes farewell = own().data(kReader, kParticipants, 7, kInlineQos, Parameters().list(), {}).bytes();
  for (const bool without : {true, false}) {
    Guard guard({.peers = {0x7f000001}, .without_farewells = without});
    Bytes message = farewell;
    EXPECT_EQ(guard.admit(message, Source{0x7f000001, 7400}), without ? kHeaderSize : farewell.size());
  }
}

TEST(Guard, AStrangerIsRefusedWhateverItSays) {
  Guard guard({{0x7f000001}});
  Bytes message = own().heartbeat(0, kUserWriter, 1, 1, 1).bytes();
  EXPECT_EQ(guard.admit(message, Source{0x0a000001, 7400}), 0U);
  EXPECT_EQ(guard.admit(message, std::nullopt), 0U);
  EXPECT_EQ(guard.admit(message, Source{0x7f000001, 7400}), message.size());
  EXPECT_EQ(guard.counts()[static_cast<std::size_t>(DatagramAdmission::stranger)], 2U);
}

TEST(Guard, WhereAVendorsXmlSaysWhoEverybodyIsTakenInButForDamage) {
  Guard guard(policy_of({.vendor_xml = "profiles.xml"}));
  Bytes message = own().heartbeat(0, kUserWriter, 1, 1, 1).bytes();
  EXPECT_EQ(guard.admit(message, Source{0x0a000001, 7400}), message.size());
  EXPECT_EQ(guard.admit(message, std::nullopt), message.size());
  message[20] = 0x44;
  EXPECT_EQ(guard.admit(message, Source{0x0a000001, 7400}), 0U);
}

constexpr Identities::Time kStart{};

TEST(Identities, APrefixBelongsToWhoeverWasHeardWithItFirst) {
  Identities identities;
  EXPECT_EQ(identities.claim(kOwn, {1, 10}, kStart), DatagramAdmission::pass);
  EXPECT_EQ(identities.claim(kOwn, {1, 11}, kStart), DatagramAdmission::taken_identity);
  EXPECT_EQ(identities.claim(kOwn, {2, 10}, kStart + std::chrono::hours(1)),
            DatagramAdmission::taken_identity);
  EXPECT_EQ(identities.claim(kOwn, {1, 10}, kStart + std::chrono::hours(1)), DatagramAdmission::pass);
}

TEST(Identities, AParticipantOfOursIsReadFromThePortThatItIsNamedAfterAlone) {
  Identities identities;
  Prefix ours{};
  const auto start = prefix_start(40000);
  std::copy(start.begin(), start.end(), ours.begin());
  EXPECT_EQ(identities.claim(ours, {1, 39999}, kStart), DatagramAdmission::taken_identity)
      << "also when nobody was heard";
  EXPECT_EQ(identities.claim(ours, {1, 40000}, kStart), DatagramAdmission::pass);
  EXPECT_EQ(identities.claim(ours, {2, 40000}, kStart), DatagramAdmission::taken_identity);
}

Prefix prefix(std::size_t i) { return {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i >> 8)}; }

TEST(Identities, ACrowdMakesNobodyForgotten) {
  Identities identities;
  EXPECT_EQ(identities.claim(kOwn, {1, 10}, kStart), DatagramAdmission::pass);
  std::size_t admitted = 0;
  for (std::size_t i = 0; i < 4 * Identities::kPerAddress; ++i) {
    const Source source{1, static_cast<std::uint16_t>(100 + i / 128)};
    if (identities.claim(prefix(i), source, kStart) == DatagramAdmission::pass) ++admitted;
  }
  EXPECT_EQ(admitted, Identities::kPerAddress - 1);
  EXPECT_EQ(identities.claim(kOther, {1, 99}, kStart), DatagramAdmission::crowd);
  EXPECT_EQ(identities.claim(kOther, {2, 99}, kStart), DatagramAdmission::pass) << "another host";
  EXPECT_EQ(identities.claim(kOwn, {1, 10}, kStart + Identities::kSilent), DatagramAdmission::pass);
  EXPECT_EQ(identities.claim(kOther, {2, 99}, kStart + Identities::kSilent), DatagramAdmission::pass);
  EXPECT_EQ(identities.claim(prefix(9999), {1, 99}, kStart + Identities::kSilent + std::chrono::seconds(1)),
            DatagramAdmission::pass)
      << "the crowd is silent";
  EXPECT_EQ(identities.claim(kOwn, {1, 11}, kStart + Identities::kSilent + std::chrono::seconds(1)),
            DatagramAdmission::taken_identity);
}

EndpointWord endpoint(std::uint32_t number, std::uint32_t of = 0) {
  EndpointWord word{{}, 0x000003c2, number + 1, false};
  for (std::size_t i = 0; i < 4; ++i) word.guid[i] = static_cast<std::uint8_t>(number >> 8 * i);
  for (std::size_t i = 0; i < 4; ++i) word.guid[4 + i] = static_cast<std::uint8_t>(of >> 8 * i);
  return word;
}

TEST(Identities, AParticipantHasNotAnyNumberOfEndpoints) {
  Identities identities;
  ASSERT_EQ(identities.claim(kOwn, {1, 10}, kStart), DatagramAdmission::pass);
  for (std::uint32_t i = 0; i < Identities::kEndpoints; ++i)
    ASSERT_TRUE(identities.announce(kOwn, {endpoint(i)}, kStart));
  EXPECT_TRUE(identities.announce(kOwn, {endpoint(7)}, kStart)) << "it is known";
  EXPECT_FALSE(identities.announce(kOwn, {endpoint(5000)}, kStart));
  // Ends make room if a vendor takes them for new.
  auto end = endpoint(3);
  end.ended = true;
  EXPECT_TRUE(identities.announce(kOwn, {end}, kStart)) << "an old word";
  EXPECT_FALSE(identities.announce(kOwn, {endpoint(5000)}, kStart));
  end.number = 6000;
  EXPECT_TRUE(identities.announce(kOwn, {end}, kStart));
  EXPECT_TRUE(identities.announce(kOwn, {endpoint(5000)}, kStart));
}

TEST(Identities, TheEndpointsOfAnAddressAreBoundedTogether) {
  Identities identities;
  std::size_t admitted = 0;
  constexpr std::uint32_t kParticipantsOfIt = 20;
  for (std::uint32_t p = 0; p < kParticipantsOfIt; ++p) {
    ASSERT_EQ(identities.claim(prefix(p), {1, static_cast<std::uint16_t>(p)}, kStart), DatagramAdmission::pass);
    for (std::uint32_t i = 0; i < Identities::kEndpoints; ++i)
      admitted += identities.announce(prefix(p), {endpoint(i, p)}, kStart) ? 1 : 0;
  }
  EXPECT_EQ(admitted, Identities::kEndpointsPerAddress);
  ASSERT_EQ(identities.claim(kOther, {2, 99}, kStart), DatagramAdmission::pass);
  EXPECT_TRUE(identities.announce(kOther, {endpoint(0, 99)}, kStart)) << "another host";
  const auto later = kStart + Identities::kSilent + std::chrono::seconds(1);
  ASSERT_EQ(identities.claim(prefix(0), {1, 0}, later), DatagramAdmission::pass);
  ASSERT_EQ(identities.claim(prefix(1), {1, 1}, later), DatagramAdmission::pass);
  EXPECT_TRUE(identities.announce(prefix(1), {endpoint(0, 1)}, later)) << "who was silent has been forgotten";
}

TEST(Guard, ReadsWhatIsSaidOfEndpoints) {
  constexpr std::uint32_t kWriters = 0x000003c2, kReaders = 0x000004c2;
  const Bytes named = Parameters().add_guid(0x5a, kOwn, 0x102).sample();
  const Bytes gone = Parameters().add_guid(0x70, kOwn, 0x107).add(0x71, {0, 0, 0, 3}).list();
  const auto words = endpoints_in(own()
                                      .data(0, kWriters, 4, kData, {}, named)
                                      .data(0, kReaders, 5, kInlineQos, gone, {})
                                      .data(0, kUserWriter, 6, kData, {}, kPayload)
                                      .data(0, kParticipants, 7, kInlineQos, gone, {})
                                      .bytes());
  ASSERT_EQ(words.size(), 2U);
  EXPECT_TRUE(std::equal(kOwn.begin(), kOwn.end(), words[0].guid.begin()));
  EXPECT_EQ(words[0].writer, kWriters);
  EXPECT_EQ(words[0].number, 4);
  EXPECT_FALSE(words[0].ended);
  EXPECT_EQ(words[1].writer, kReaders);
  EXPECT_EQ(words[1].number, 5);
  EXPECT_TRUE(words[1].ended);
}

TEST(Guard, NoParticipantIsWaitedForLongerThanTheLongestLease) {
  const auto said = [](const Bytes& lease) {
    return own().data(0, kParticipants, 1, kData, {}, Parameters().add_guid(0x50, kOwn, 0x1c1).add(2, lease).sample());
  };
  const auto after = [&](const Bytes& lease) {
    Guard guard({.peers = {0x7f000001}});
    Bytes message = said(lease).bytes();
    EXPECT_EQ(guard.admit(message, Source{0x7f000001, 7400}), message.size());
    return message;
  };
  EXPECT_EQ(after(kLease), said(kLease).bytes());
  const Bytes longest{kLongestLease, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(after({100, 0, 0, 0, 0, 0, 0, 0}), said(longest).bytes());
  EXPECT_EQ(after({0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff, 0xff}), said(longest).bytes()) << "for ever";
  EXPECT_EQ(judge(own().data(0, kParticipants, 1, kData, {}, Parameters().add_guid(0x50, kOwn, 0x1c1).sample())),
            DatagramAdmission::bad_parameters)
      << "vendors would wait for ever";
}

TEST(Identities, OneSocketHasNotManyNames) {
  Identities identities;
  for (std::size_t i = 0; i < Identities::kPerSource; ++i)
    EXPECT_EQ(identities.claim(prefix(i), {1, 10}, kStart), DatagramAdmission::pass);
  EXPECT_EQ(identities.claim(kOther, {1, 10}, kStart), DatagramAdmission::crowd);
  EXPECT_EQ(identities.claim(kOther, {1, 11}, kStart), DatagramAdmission::pass);
}

}  // namespace
}  // namespace roci::services::vendors::guard
