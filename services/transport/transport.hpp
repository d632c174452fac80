// This is the vendor boundary: serialized samples go in and out of named, typed topics. A DDS vendor is a
// shared object that implements these classes (vendors/X); services link none of them. Types are known here
// by name and key alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "services/transport/qos.hpp"

namespace roci::services::transport {

/// Holds a 4-byte encapsulation header and CDR, exactly as on the wire.
using Payload = std::vector<std::uint8_t>;
using Guid = std::array<std::uint8_t, 16>;

/// Describes a type without naming it in C++. `serialized_key` appends the big-endian CDR of the key members
/// (no encapsulation) of a payload, which is a whole sample or, with key_only, a key-only payload; it returns
/// false if the payload is malformed.
struct TypeDescription {
  /// Names the type, e.g. "roci::v1::Goal". Matching is by name alone, so a foreign type never matches.
  std::string name;
  bool keyed = false;
  /// Says whether the largest serialized key takes at most 16 bytes, so that the key hash is the key itself.
  bool key_fits_hash = false;
  bool (*serialized_key)(std::span<const std::uint8_t> payload, bool key_only, Payload& out) = nullptr;
};

/// Describes a writer or a reader that a transport is asked for.
struct EndpointDescription {
  std::string topic;
  TypeDescription type;
  QosSettings qos;
  /// Lists the partitions, which follow from the topic's scope (partitions_of in scope.hpp); empty: the
  /// partition "".
  std::vector<std::string> partitions{};
};

/// Says what a sample tells. The last two kinds occur on keyed topics alone; their payload holds at least the
/// key (deserialize_key).
enum class SampleKind {
  data,
  disposed,    ///< the writer disposed the instance
  no_writers,  ///< the instance has no live writer any more (DDS: NOT_ALIVE_NO_WRITERS)
};

/// Holds a sample as it came in.
struct Sample {
  SampleKind kind = SampleKind::data;
  Payload payload;
  Guid writer{};
};

/// Holds what vendor threads call: implementations only enqueue, they never write and never block.
struct ReaderEvents {
  std::function<void(Sample&&)> on_sample;
  std::function<void(int current_writers)> on_matched;
  /// Names each writer that the reader is matched with, before or after it is counted, at least once.
  std::function<void(const Guid& writer)> on_writer{};
};

/// Holds what vendor threads call of a writer. A reliable writer reaches every reader that it counts: all
/// that is written from then on arrives.
struct WriterEvents {
  std::function<void(int current_readers)> on_matched;
  /// Names each reader that the writer is matched with, before or after it is counted, at least once.
  std::function<void(const Guid& reader)> on_reader{};
};

/// Writes serialized samples on one topic.
class Writer {
 public:
  virtual ~Writer() = default;
  /// Returns false if a reliable reader's history stood full for longer than max_blocking_ms, or the payload
  /// is malformed.
  virtual bool write(std::span<const std::uint8_t> payload) = 0;
  /// Disposes the instance whose key members the (whole) payload holds.
  virtual bool dispose(std::span<const std::uint8_t> payload) = 0;
  virtual Guid guid() const = 0;
  virtual int matched_readers() const = 0;
};

/// Keeps a subscription open. Destroying a Reader (or a Writer) waits until none of its callbacks runs any
/// more; never do it in a callback.
class Reader {
 public:
  virtual ~Reader() = default;
  virtual int matched_writers() const = 0;
};

/// Names the files of DDS Security that a participant joins with (services/security/key_folder.hpp makes and checks
/// them).
struct Credentials {
  std::string service;  ///< service of the certificate
  std::filesystem::path identity_authority;
  std::filesystem::path certificate;
  std::filesystem::path private_key;
  std::filesystem::path revoked;
  std::filesystem::path permissions_authority;
  std::filesystem::path governance;
  std::filesystem::path permissions;
};

/// Says how a participant joins a domain.
struct TransportOptions {
  int domain = 0;
  std::string participant{};  ///< vendor tools show it
  /// Holds the one interface address that is used.
  std::string address = "127.0.0.1";
  std::vector<std::string> peers = {"127.0.0.1"};  ///< hosts that are asked for participants, unicast
  /// Holds the path of a vendor's own XML, which replaces the defaults if not empty.
  std::string vendor_xml{};
  /// Makes the run secure: nothing is sent or heard in plain, and a transport that cannot do that is not
  /// opened. Without credentials the run is plain.
  std::optional<Credentials> credentials{};
  /// Holds the USER_DATA of the participant; if empty, open_transport fills in the announcement of this
  /// build.
  std::optional<std::string> announcement{};
};

/// Holds what a participant of the domain says of itself.
struct Participant {
  std::string name{};          ///< empty if it has none
  std::string announcement{};  ///< its USER_DATA (announcement.hpp); empty if it has none
};

/// Reports what a vendor, or the choice of one, refuses.
class TransportError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Holds one DDS participant. Its writers and readers must be destroyed before it. A topic has one type in
/// it; asking for another throws TransportError, as does everything that the vendor refuses.
class Transport {
 public:
  virtual ~Transport() = default;
  virtual std::string_view vendor() const = 0;
  virtual std::unique_ptr<Writer> create_writer(const EndpointDescription&, WriterEvents) = 0;
  virtual std::unique_ptr<Reader> create_reader(const EndpointDescription&, ReaderEvents) = 0;
  /// Returns what this participant announces.
  virtual std::string announcement() const = 0;
  /// Returns the participant that a writer or a reader belongs to, including this one, even after it has left. It is
  /// known before its first sample arrives, provided that its USER_DATA is. Returns nothing if it was not discovered.
  /// Any thread may ask.
  virtual std::optional<Participant> participant_of(const Guid&) = 0;
  /// Returns whether the participant of a writer may call itself `sender`: with credentials it must have that
  /// service's certificate, in a plain run anybody may. Any thread may ask.
  virtual bool speaks_as(const Guid& writer, std::string_view sender) const = 0;
};

/// Opens a transport; each plug-in exports it under the name roci_create_transport. It throws TransportError.
using CreateTransport = std::unique_ptr<Transport>(const TransportOptions&);
inline constexpr char kCreateTransportSymbol[] = "roci_create_transport";

}  // namespace roci::services::transport
