// The writer end is the sending end of an inproc topic.
#pragma once

#include <list>
#include <memory>
#include <mutex>
#include <span>
#include <unordered_map>
#include <vector>

#include "services/transport/transport.hpp"
#include "services/vendors/inproc/dispatcher.hpp"
#include "services/vendors/inproc/reader_end.hpp"

namespace roci::services::vendors::inproc {

/// Hands samples to the matched readers, and keeps the history for late joiners.
class WriterEnd : public std::enable_shared_from_this<WriterEnd> {
 public:
  WriterEnd(transport::EndpointDescription, transport::WriterEvents, std::shared_ptr<Dispatcher>,
            Dispatcher::Endpoint, const transport::Guid&);

  const transport::EndpointDescription& description() const { return description_; }
  const transport::Guid& guid() const { return guid_; }
  int matched_readers() const;

  bool write(std::span<const std::uint8_t> payload);
  bool dispose(std::span<const std::uint8_t> payload);

  /// Attaches a reader, which gets the history first if it asked for it.
  void attach(const std::shared_ptr<ReaderEnd>&);
  void detach(const std::shared_ptr<ReaderEnd>&);
  /// Leaves all readers; returns when no callback runs any more.
  void close();

 private:
  struct Kept {
    Key key;
    transport::Payload payload;
  };
  using History = std::list<Kept>;  // oldest first

  bool key_of(std::span<const std::uint8_t> payload, Key&) const;
  bool send(transport::SampleKind, std::span<const std::uint8_t> payload, const Key&);
  void keep(const Key&, std::span<const std::uint8_t> payload);
  void forget(const Key&);
  void report_matched();

  const transport::EndpointDescription description_;
  const transport::WriterEvents events_;
  const std::shared_ptr<Dispatcher> dispatcher_;
  const Dispatcher::Endpoint id_;
  const transport::Guid guid_;

  mutable std::mutex mutex_;
  std::vector<std::shared_ptr<ReaderEnd>> readers_;
  History history_;
  std::unordered_map<Key, std::list<History::iterator>> kept_of_instance_;
};

}  // namespace roci::services::vendors::inproc
