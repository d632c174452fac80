// A participant without a vendor: it is discovered, matched and read like any other, and sends whatever bytes it likes.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/contract/hostile/rtps_message.hpp"

namespace roci::services::contract::hostile {

/// A UDP socket with a port of its own.
class Socket {
 public:
  Socket();
  ~Socket();
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  void send(const Bytes&, std::uint32_t address, int port) const;
  int port() const { return port_; }

 private:
  int socket_ = -1;
  int port_ = 0;
};

struct EndpointDescription {
  std::string topic;
  std::string type;
  bool keyed = false;
  std::vector<std::string> partitions;
};

/// Reliable and transient local, so that every reader matches. It ignores what it is sent and says everything again,
/// which is all that a transient-local writer does for who joins late.
class Participant {
 public:
  Participant(std::uint32_t target, int domain, Vendor, std::uint8_t number, std::string user_data);

  /// The entity id of the new writer.
  Entity add_writer(const EndpointDescription&);

  /// The entity id of the new reader, which is reliable and transient local as well.
  Entity add_reader(const EndpointDescription&);

  /// Tells the first participants of the domain on the target of itself, its writers and its readers.
  void announce();
  /// Says farewell to them, as both vendors do when a participant is deleted.
  void leave();
  /// Sets the lease that it announces; it is 20 s at first.
  void set_lease(std::chrono::microseconds lease) { lease_ = lease; }
  void send_to_readers(const Message&) const;  ///< To the ports for samples of users.
  void send_to_discovery(const Message&) const;
  /// To both, messages in whose middle stand the statistics that Fast DDS reads at the end.
  void send_statistics_in_the_middle() const;
  Message message() const { return {prefix_, vendor_}; }
  const Prefix& prefix() const { return prefix_; }
  int port() const { return socket_.port(); }

 private:
  void send(const Message&, int first_port) const;
  Bytes own_sample() const;
  void announce_all(Entity writer, Entity reader, const std::vector<EndpointDescription>&,
                    Entity (*id)(std::size_t index, bool keyed));
  Bytes endpoint_sample(const EndpointDescription&, Entity id) const;

  const std::uint32_t target_;
  const int domain_;
  const Vendor vendor_;
  const std::string user_data_;
  Prefix prefix_{};
  Socket socket_;
  std::vector<EndpointDescription> writers_;
  std::vector<EndpointDescription> readers_;
  std::uint32_t announcements_ = 0;
  std::chrono::microseconds lease_{20'000'000};
};

/// What a sample of discovery says of a participant that has left.
struct Farewell {
  Bytes inline_qos;  ///< which instance it is, and that it is disposed and unregistered
  Bytes key;         ///< as a sample
};
Farewell farewell_of(const Prefix&);

/// The entity ids of the writer and of the reader that was added as number `index`, from 0.
Entity writer_id(std::size_t index, bool keyed);
Entity reader_id(std::size_t index, bool keyed);

}  // namespace roci::services::contract::hostile
