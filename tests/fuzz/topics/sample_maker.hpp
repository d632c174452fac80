// Random samples of any topic type, from the IDL alone: valid CDR in which it is known where counts, enumerators and
// texts stand, so that a test can put lies there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "services/transport/transport.hpp"

namespace roci::fuzz {

/// A place in a payload that a reader believes at its peril.
struct Mark {
  enum class Kind { count, text_length, enumerator, text };
  Kind kind = Kind::count;
  std::size_t offset = 0;
  std::uint32_t least =
      1;  ///< count: the fewest bytes of an element; enumerator: how many there are; text: its length
};

struct MadeSample {
  services::transport::Payload payload;
  std::vector<Mark> marks;
};

class SampleMaker {
 public:
  explicit SampleMaker(std::uint64_t seed) : random_(seed) {}
  /// Members called `run` name this one, and every other text is one of `words`.
  SampleMaker(std::uint64_t seed, std::string run, std::vector<std::string> words)
      : random_(seed), run_(std::move(run)), words_(std::move(words)) {}

  /// A whole sample of this type ("Goal"). Sequences have at most `longest` elements, and fewer the deeper they stand.
  /// Texts come from the words of the planetary mission, so that handlers look on; members called `run` name its run.
  MadeSample make(const std::string& type, std::size_t longest = 3);

  /// The same bytes with one to four places changed: marks get lies, other bytes are flipped,
  /// the end is cut or repeated.
  services::transport::Payload damaged(const MadeSample& sample);

  std::size_t below(std::size_t bound) { return bound == 0 ? 0 : random_() % bound; }
  std::mt19937_64& random() { return random_; }
  const std::string& run() const { return run_; }
  const std::vector<std::string>& words() const { return words_; }

 private:
  std::mt19937_64 random_;
  std::string run_ = "planetary";
  std::vector<std::string> words_;
};

/// Writes a number in the payload's byte order.
void put(services::transport::Payload& payload, std::size_t offset, std::uint32_t number);

/// The topic types of the IDL ("Goal"), as the contract announces them.
std::vector<std::string> topic_types();

}  // namespace roci::fuzz
