// For coverage-guided fuzzing with clang: fuzz_topics_guided CORPUS_FOLDER. The first byte picks the topic.
#include <cstddef>
#include <cstdint>
#include <span>

#include "tests/fuzz/topics/decoders.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const roci::fuzz::Decoder& decoder = roci::fuzz::decoders()[data[0] % roci::fuzz::decoders().size()];
  const std::span<const std::uint8_t> payload(data + 1, size - 1);
  const auto decoded = decoder.topic.codec.decode(payload);
  if (decoded.whole) decoder.encode(decoded.value.get());
  roci::services::transport::Payload key;
  if (decoder.topic.codec.type.keyed) decoder.topic.codec.type.serialized_key(payload, true, key);
  return 0;
}
