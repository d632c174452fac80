// Finished instances of a keyed topic have had their last sample: a writer that runs for years keeps those of the
// newest instances alone. This is pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <string>
#include <unordered_map>
#include <vector>

#include "services/transport/transport.hpp"

namespace roci::services::node {

/// Guarantees that the newest `kept` finished instances stay, and with them the newest sample of the stream, and that
/// none goes before `rest` turns of its writer have passed since its last sample. Under the simulated clock two turns
/// are enough: a receiver has taken the samples of micro-step k before those of k + 2 can be written.
class FinishedInstances {
 public:
  using Key = std::string;  ///< the serialized key

  FinishedInstances(std::size_t kept, std::uint64_t rest) : kept_(kept), rest_(rest) {}

  /// Takes in that the instance has a further sample: it is not finished, or finishes anew.
  void written(const Key&);
  /// Takes in that the instance has its last word, which is `payload`.
  void finished(const Key&, transport::Payload payload);
  /// Ends a turn of the writer.
  void end_turn() { ++turn_; }
  /// Returns the last words of the instances to be forgotten now, each once, the oldest first.
  std::vector<transport::Payload> take_due();

 private:
  struct Finished {
    Key key;
    transport::Payload payload;
    std::uint64_t turn;
  };

  std::size_t kept_;
  std::uint64_t rest_;
  std::uint64_t turn_ = 0;
  std::list<Finished> oldest_first_;
  std::unordered_map<Key, std::list<Finished>::iterator> known_;
};

}  // namespace roci::services::node
