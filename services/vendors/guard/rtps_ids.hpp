// These are the numbers of the wire protocol that the guard examines, by the names of RTPS 2.3 and DDS
// Security 1.1.
#pragma once

#include <cstdint>

namespace roci::services::vendors::guard {

/// Submessages (RTPS 2.3, 9.4.5.1.1; DDS Security 1.1, 7.3.6).
inline constexpr std::uint8_t kPad = 0x01;
inline constexpr std::uint8_t kAckNack = 0x06;
inline constexpr std::uint8_t kHeartbeat = 0x07;
inline constexpr std::uint8_t kGap = 0x08;
inline constexpr std::uint8_t kInfoTimestamp = 0x09;
inline constexpr std::uint8_t kInfoSource = 0x0c;
inline constexpr std::uint8_t kInfoDestination = 0x0e;
inline constexpr std::uint8_t kNackFragments = 0x12;
inline constexpr std::uint8_t kHeartbeatFragments = 0x13;
inline constexpr std::uint8_t kData = 0x15;
inline constexpr std::uint8_t kDataFragment = 0x16;
inline constexpr std::uint8_t kSecBody = 0x30;  ///< of one submessage, or of a whole message
inline constexpr std::uint8_t kSecPrefix = 0x31;
inline constexpr std::uint8_t kSecPostfix = 0x32;
inline constexpr std::uint8_t kSrtpsPrefix = 0x33;  ///< what follows is encrypted as a whole
inline constexpr std::uint8_t kSrtpsPostfix = 0x34;
inline constexpr std::uint8_t kFirstOfVendors = 0x80;  ///< from here on each vendor has ids of its own

/// Flag of all submessages (RTPS 2.3, 8.3.3.2.2), and those of DATA and DATA_FRAG (9.4.5.3).
inline constexpr std::uint8_t kLittleEndianFlag = 0x01;
inline constexpr std::uint8_t kInlineQosFlag = 0x02;
inline constexpr std::uint8_t kDataFlag = 0x04;
inline constexpr std::uint8_t kKeyFlag = 0x08;

/// Flags of PID_STATUS_INFO in its last byte: the instance was disposed, or unregistered (RTPS 2.3, 9.6.3.9).
inline constexpr std::uint8_t kNotAlive = 0x03;

/// Flag of INFO_TS: there is no time from here on (RTPS 2.3, 9.4.5.11).
inline constexpr std::uint8_t kInvalidateFlag = 0x02;

/// Built-in writers, as entity ids read in the order of their bytes (RTPS 2.3, 9.3.1.3; DDS Security 1.1, 7.3.7.1).
inline constexpr std::uint32_t kParticipants = 0x000100c2;
inline constexpr std::uint32_t kTopics = 0x000002c2;
inline constexpr std::uint32_t kWriters = 0x000003c2;
inline constexpr std::uint32_t kReaders = 0x000004c2;
inline constexpr std::uint32_t kLiveliness = 0x000200c2;
inline constexpr std::uint32_t kHandshakes = 0x000201c3;  ///< ParticipantStatelessMessage
inline constexpr std::uint32_t kSecureParticipants = 0xff0101c2;
inline constexpr std::uint32_t kSecureWriters = 0xff0003c2;
inline constexpr std::uint32_t kSecureReaders = 0xff0004c2;
inline constexpr std::uint32_t kSecureLiveliness = 0xff0200c2;

/// Parameters (RTPS 2.3, table 9.13) without the flag "must be understood", which is no part of an id.
inline constexpr std::uint16_t kMustUnderstand = 0x4000;
inline constexpr std::uint16_t kPadding = 0x0000;
inline constexpr std::uint16_t kSentinel = 0x0001;
inline constexpr std::uint16_t kLease = 0x0002;  ///< of a participant
inline constexpr std::uint16_t kTopicName = 0x0005;
inline constexpr std::uint16_t kTypeName = 0x0007;
inline constexpr std::uint16_t kPartition = 0x0029;
inline constexpr std::uint16_t kUserData = 0x002c;
inline constexpr std::uint16_t kGroupData = 0x002d;
inline constexpr std::uint16_t kTopicData = 0x002e;
inline constexpr std::uint16_t kUnicastLocator = 0x002f;
inline constexpr std::uint16_t kMulticastLocator = 0x0030;
inline constexpr std::uint16_t kDefaultUnicastLocator = 0x0031;
inline constexpr std::uint16_t kMetatrafficUnicastLocator = 0x0032;
inline constexpr std::uint16_t kMetatrafficMulticastLocator = 0x0033;
inline constexpr std::uint16_t kDefaultMulticastLocator = 0x0048;
inline constexpr std::uint16_t kParticipantGuid = 0x0050;
inline constexpr std::uint16_t kGroupGuid = 0x0052;
inline constexpr std::uint16_t kPropertyList = 0x0059;
inline constexpr std::uint16_t kEndpointGuid = 0x005a;
inline constexpr std::uint16_t kEntityName = 0x0062;
inline constexpr std::uint16_t kKeyHash = 0x0070;
inline constexpr std::uint16_t kStatusInfo = 0x0071;

/// Kind of a locator: UDP over IPv4 (RTPS 2.3, 9.3.2).
inline constexpr std::uint32_t kUdp4 = 1;

}  // namespace roci::services::vendors::guard
