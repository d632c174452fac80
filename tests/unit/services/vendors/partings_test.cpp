// Who has given a participant up says nothing to it, and hears nothing of it, until that one has given it up, too.
#include "services/vendors/guard/partings.hpp"

#include <gtest/gtest.h>

#include <string_view>

#include "services/vendors/peers.hpp"
#include "tests/contract/hostile/rtps_message.hpp"

namespace roci::services::vendors::guard {
namespace {

using contract::hostile::Bytes;
using contract::hostile::kData;
using contract::hostile::kEclipse;
using contract::hostile::kEprosima;
using contract::hostile::kInlineQos;
using contract::hostile::Message;
using contract::hostile::Parameters;
using contract::hostile::Prefix;

constexpr Prefix kOwn{0x81, 1}, kOther{0x82, 2}, kNext{0x83, 3};
constexpr std::uint32_t kHost = 0x7f000001, kParticipants = 0x000100c2, kHandshakes = 0x000201c3;
constexpr Source kDiscovery{kHost, 7410}, kUserData{kHost, 7411}, kElsewhere{kHost, 7412};
constexpr Partings::Time kStart{std::chrono::hours(1)};

Bytes announced(const Prefix& who, std::uint8_t flags = 0) {
  const Bytes inline_qos = flags != 0 ? Parameters().add(0x70, Bytes(16)).list() : Bytes{};
  return Message(who, kEclipse)
      .data(0, kParticipants, 1, kData | flags, inline_qos,
            Parameters().add_locator(0x32, kHost, 7410).add_locator(0x31, kHost, 7411).sample())
      .bytes();
}

Bytes handshake(const Prefix& with, std::string_view token) {
  Bytes payload{0, 1, 0, 0};
  payload.resize(4 + 48);
  payload.insert(payload.end(), with.begin(), with.end());
  payload.insert(payload.end(), token.begin(), token.end());
  payload.resize((payload.size() + 3) / 4 * 4);
  return Message(kOwn, kEprosima).data(0, kHandshakes, 1, kData, {}, payload).bytes();
}

constexpr std::string_view kRequest = "DDS:Auth:PKI-DH:1.0+Req", kReply = "DDS:Auth:PKI-DH:1.0+Reply",
                           kFinal = "DDS:Auth:PKI-DH:1.0+Final";

Partings knowing(const Prefix& who) {
  Partings partings;
  partings.announced(*announcement_in(announced(who)), kStart);
  return partings;
}

TEST(Partings, AnAnnouncementSaysWhereItsParticipantIsSpokenTo) {
  for (const std::uint8_t flags : {std::uint8_t{0}, std::uint8_t{kInlineQos}}) {
    const auto news = announcement_in(announced(kOther, flags));
    ASSERT_TRUE(news);
    EXPECT_EQ(news->prefix, kOther);
    EXPECT_EQ(news->reached_at, (std::vector<Source>{kDiscovery, kUserData}));
  }
  EXPECT_FALSE(announcement_in(handshake(kOther, kRequest)));
}

// Whether a silence begins when this one announces itself now.
bool begins(Partings& partings, const Prefix& who, Partings::Time now) {
  return partings.announced(*announcement_in(announced(who)), now);
}

constexpr Partings::Time kParted = kStart + Partings::kGrace;

TEST(Partings, WhoIsGivenUpAndStillThereIsNotSpokenToForLongerThanALease) {
  static_assert(Partings::kSilence > std::chrono::seconds(kLeaseSeconds));
  Partings partings = knowing(kOther);
  partings.gave_up(kOther, kStart);
  EXPECT_FALSE(begins(partings, kOther, kParted - std::chrono::milliseconds(1)));
  EXPECT_FALSE(partings.keeps_back(kDiscovery, kParted)) << "nothing was heard of it since";
  EXPECT_TRUE(begins(partings, kOther, kParted));
  EXPECT_FALSE(begins(partings, kOther, kParted));
  const auto end = kParted + Partings::kSilence;
  for (const Source& place : {kDiscovery, kUserData}) {
    EXPECT_TRUE(partings.keeps_back(place, end - std::chrono::milliseconds(1)));
    EXPECT_FALSE(partings.keeps_back(place, end));
  }
  EXPECT_FALSE(partings.keeps_back(kElsewhere, kParted));
  EXPECT_TRUE(partings.is_deaf_to(kOther, kParted));
  EXPECT_FALSE(partings.is_deaf_to(kNext, kParted));
  EXPECT_FALSE(partings.is_deaf_to(kOther, end));
}

TEST(Partings, WhoAnswersIsSpokenTo) {
  for (const std::string_view answer : {kReply, kFinal}) {
    Partings partings = knowing(kOther);
    partings.gave_up(kOther, kStart);
    partings.sent(handshake(kOther, answer), kStart);
    EXPECT_FALSE(begins(partings, kOther, kParted));
  }
  Partings partings = knowing(kOther);
  partings.gave_up(kOther, kStart);
  partings.sent(handshake(kOther, kRequest), kStart);
  partings.sent(handshake(kNext, kFinal), kStart);
  EXPECT_TRUE(begins(partings, kOther, kParted)) << "only asked, and another one";
}

TEST(Partings, AHandshakeThatIsBegunAnewSaysThatTheOtherOneWasGivenUp) {
  Partings partings = knowing(kOther);
  partings.sent(handshake(kOther, kRequest), kStart);
  partings.sent(handshake(kOther, kRequest), kStart);  // repeated until it is answered
  EXPECT_FALSE(begins(partings, kOther, kParted));
  partings.sent(handshake(kOther, kFinal), kParted);
  EXPECT_FALSE(begins(partings, kOther, kParted + Partings::kGrace));
  partings.sent(handshake(kOther, kRequest), kParted);
  EXPECT_TRUE(begins(partings, kOther, kParted + Partings::kGrace));
}

// A service that was started anew takes the ports of the dead one.
TEST(Partings, WhoeverComesInThePlaceOfAnotherIsSpokenToAtOnce) {
  Partings partings = knowing(kOther);
  partings.gave_up(kOther, kStart);
  EXPECT_TRUE(begins(partings, kOther, kParted));
  EXPECT_FALSE(begins(partings, kNext, kParted));
  EXPECT_FALSE(partings.keeps_back(kDiscovery, kParted));
  EXPECT_FALSE(partings.is_deaf_to(kOther, kParted));
}

}  // namespace
}  // namespace roci::services::vendors::guard
