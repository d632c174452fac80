// The vendor boundary: serialized samples in and out of named, typed topics. A DDS vendor is a shared object
// that implements these classes (vendors/X); services link none of them. Types are known here by name and key
// alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "services/transport/qos.hpp"

namespace roci::services::transport {

// 4-byte encapsulation header + CDR, exactly as on the wire.
using Payload = std::vector<std::uint8_t>;
using Guid = std::array<std::uint8_t, 16>;

// Type-erased description of a type. `serialized_key` appends the big-endian CDR of the key members (no
// encapsulation) of a payload, which is a whole sample or, with key_only, a key-only payload; false: the
// payload is malformed.
struct TypeDescription {
  std::string name;  // "roci::v1::Goal": matching is by name alone, so a foreign type never matches
  bool keyed = false;
  bool key_fits_hash =
      false;  // the largest serialized key takes at most 16 bytes: the key hash is the key itself
  bool (*serialized_key)(std::span<const std::uint8_t> payload, bool key_only, Payload& out) = nullptr;
};

struct EndpointDescription {
  std::string topic;
  TypeDescription type;
  QosSettings qos;
};

enum class SampleKind {
  data,
  disposed,    // keyed topics: the writer disposed the instance; payload holds at least the key
               // (deserialize_key)
  owner_lost,  // keyed topics: the instance has no live writer any more; payload as above
};

struct Sample {
  SampleKind kind = SampleKind::data;
  Payload payload;
  Guid writer{};
};

// Called from vendor threads: implementations only enqueue, they never write and never block.
struct ReaderEvents {
  std::function<void(Sample&&)> on_sample;
  std::function<void(int current_writers)> on_matched;
};

// A reliable writer that counts a reader reaches it: all that is written from then on arrives.
struct WriterEvents {
  std::function<void(int current_readers)> on_matched;
};

class Writer {
 public:
  virtual ~Writer() = default;
  // False: a reliable reader's history stood full for longer than max_blocking_ms, or the payload is
  // malformed.
  virtual bool write(std::span<const std::uint8_t> payload) = 0;
  // Disposes the instance whose key members the (whole) payload holds.
  virtual bool dispose(std::span<const std::uint8_t> payload) = 0;
  virtual Guid guid() const = 0;
  virtual int matched_readers() const = 0;
};

// Destroying a Reader (or a Writer) waits until no callback of it runs any more; never do it in a callback.
class Reader {
 public:
  virtual ~Reader() = default;
  virtual int matched_writers() const = 0;
};

struct TransportOptions {
  int domain = 0;
  std::string participant{};                       // shown by vendor tools
  std::string address = "127.0.0.1";               // the one interface address that is used; never any other
  std::vector<std::string> peers = {"127.0.0.1"};  // hosts that are asked for participants, unicast
  std::string partition{};                         // empty: none
  std::string vendor_xml{};  // path of a vendor's own XML, used instead of the defaults if not empty
};

class TransportError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// One DDS participant. Its writers and readers are destroyed before it. A topic has one type in it; asking
// for another is a TransportError, like everything that the vendor refuses.
class Transport {
 public:
  virtual ~Transport() = default;
  virtual std::string_view vendor() const = 0;
  virtual std::unique_ptr<Writer> create_writer(const EndpointDescription&, WriterEvents) = 0;
  virtual std::unique_ptr<Reader> create_reader(const EndpointDescription&, ReaderEvents) = 0;
};

// Each plug-in exports this under the name roci_create_transport. It throws TransportError.
using CreateTransport = std::unique_ptr<Transport>(const TransportOptions&);
inline constexpr char kCreateTransportSymbol[] = "roci_create_transport";

}  // namespace roci::services::transport
