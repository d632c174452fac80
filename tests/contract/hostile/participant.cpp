#include "tests/contract/hostile/participant.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "services/transport/rtps_ports.hpp"

namespace roci::services::contract::hostile {
namespace {

constexpr Entity kParticipant = 0x000001c1;
constexpr Entity kParticipantWriter = 0x000100c2, kParticipantReader = 0x000100c7;
constexpr Entity kPublicationWriter = 0x000003c2, kPublicationReader = 0x000003c7;
constexpr Entity kSubscriptionWriter = 0x000004c2, kSubscriptionReader = 0x000004c7;
constexpr int kParticipantsAttacked = 12;  // the first of a domain, more than a mission has
constexpr int kDeadPort = 9;               // what others send to this participant goes nowhere

}  // namespace

Socket::Socket() : socket_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in own{};
  own.sin_family = AF_INET;
  socklen_t size = sizeof own;
  if (socket_ < 0 || bind(socket_, reinterpret_cast<const sockaddr*>(&own), size) != 0 ||
      getsockname(socket_, reinterpret_cast<sockaddr*>(&own), &size) != 0)
    throw std::system_error(errno, std::generic_category(), "socket");
  port_ = ntohs(own.sin_port);
}
Socket::~Socket() { close(socket_); }

void Socket::send(const Bytes& bytes, std::uint32_t address, int port) const {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_addr.s_addr = htonl(address);
  to.sin_port = htons(static_cast<std::uint16_t>(port));
  sendto(socket_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
}

Entity writer_id(std::size_t index, bool keyed) {
  return static_cast<Entity>((index + 1) << 8) | (keyed ? 0x02 : 0x03);
}

Entity reader_id(std::size_t index, bool keyed) {
  return static_cast<Entity>((index + 1) << 8) | (keyed ? 0x07 : 0x04);
}

Participant::Participant(std::uint32_t target, int domain, Vendor vendor, std::uint8_t number,
                         std::string user_data)
    : target_(target), domain_(domain), vendor_(vendor), user_data_(std::move(user_data)) {
  prefix_ = {vendor[0], vendor[1], 0xba, 0xd0, number};
  const auto process = static_cast<std::uint32_t>(getpid());
  for (int i = 0; i < 4; ++i)
    prefix_[8 + static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(process >> 8 * i);
}

Entity Participant::add_writer(const EndpointDescription& writer) {
  writers_.push_back(writer);
  return writer_id(writers_.size() - 1, writer.keyed);
}

Entity Participant::add_reader(const EndpointDescription& reader) {
  readers_.push_back(reader);
  return reader_id(readers_.size() - 1, reader.keyed);
}

Bytes Participant::own_sample() const {
  Parameters parameters;
  parameters.add(0x0015, {2, 2})
      .add(0x0016, {vendor_[0], vendor_[1]})
      .add_guid(0x0050, prefix_, kParticipant);
  parameters.add_locator(0x0032, target_, kDeadPort).add_locator(0x0031, target_, kDeadPort);
  constexpr std::uint64_t kSecond = 1'000'000;
  const auto lease_us = static_cast<std::uint64_t>(lease_.count());
  Bytes lease;
  put_u32(lease, static_cast<std::uint32_t>(lease_us / kSecond));
  put_u32(lease, static_cast<std::uint32_t>((lease_us % kSecond << 32) / kSecond));
  parameters.add(0x0002, lease).add_u32(0x0058, 0x0000003f);
  Bytes user_data;
  put_u32(user_data, static_cast<std::uint32_t>(user_data_.size()));
  user_data.insert(user_data.end(), user_data_.begin(), user_data_.end());
  return parameters.add(0x002c, user_data).sample();
}

Bytes Participant::endpoint_sample(const EndpointDescription& endpoint, Entity id) const {
  Parameters parameters;
  parameters.add_guid(0x005a, prefix_, id).add_guid(0x0050, prefix_, kParticipant);
  parameters.add_string(0x0005, endpoint.topic).add_string(0x0007, endpoint.type);
  parameters.add_u32(0x001d, 1);  // transient local
  Bytes reliability;
  put_u32(reliability, 2);
  put_u32(reliability, 0);
  put_u32(reliability, 0x19999999);
  parameters.add(0x001a, reliability).add_locator(0x002f, target_, kDeadPort);
  if (!endpoint.partitions.empty()) parameters.add_strings(0x0029, endpoint.partitions);
  return parameters.sample();
}

void Participant::announce() {
  ++announcements_;
  send_to_discovery(
      message().data(kParticipantReader, kParticipantWriter, announcements_, kData, {}, own_sample()));
  announce_all(kPublicationWriter, kPublicationReader, writers_, writer_id);
  announce_all(kSubscriptionWriter, kSubscriptionReader, readers_, reader_id);
}

void Participant::announce_all(Entity writer, Entity reader, const std::vector<EndpointDescription>& endpoints,
                               Entity (*id)(std::size_t index, bool keyed)) {
  const auto count = static_cast<std::int64_t>(endpoints.size());
  send_to_discovery(message().heartbeat(reader, writer, 1, count, announcements_));
  for (std::size_t i = 0; i < endpoints.size(); ++i) {
    send_to_discovery(message().data(reader, writer, static_cast<std::int64_t>(i) + 1, kData, {},
                                     endpoint_sample(endpoints[i], id(i, endpoints[i].keyed))));
  }
}

Farewell farewell_of(const Prefix& prefix) {
  return {Parameters().add_guid(0x0070, prefix, kParticipant).add(0x0071, {0, 0, 0, 3}).list(),
          Parameters().add_guid(0x0050, prefix, kParticipant).sample()};
}

void Participant::leave() {
  const Farewell gone = farewell_of(prefix_);
  send_to_discovery(message().data(kParticipantReader, kParticipantWriter, ++announcements_,
                                   kInlineQos | kKey, gone.inline_qos, gone.key));
}

void Participant::send_to_readers(const Message& message) const {
  send(message, transport::first_participant_port(domain_) + 1);
}
void Participant::send_to_discovery(const Message& message) const {
  send(message, transport::first_participant_port(domain_));
}

void Participant::send_statistics_in_the_middle() const {
  for (const std::uint8_t fill : {0xff, 0x00, 0x7f, 0x01}) {
    auto bytes = message();
    bytes.submessage(0x80, 0, Bytes(56, fill)).submessage(0x01, 0, Bytes(60, fill));
    send_to_discovery(bytes);
    send_to_readers(bytes);
  }
}

void Participant::send(const Message& message, int first_port) const {
  for (int i = 0; i < kParticipantsAttacked; ++i) socket_.send(message.bytes(), target_, first_port + 2 * i);
}

}  // namespace roci::services::contract::hostile
