#include "exec_svc/standby/chunk.hpp"

#include "core/bytes/crc_32.hpp"
#include "core/bytes/little_endian.hpp"

namespace roci::exec::standby {

using journal::Position;

std::uint32_t checksum(const Chunk& chunk) {
  std::string numbers;
  for (const std::uint64_t number :
       {chunk.leader, chunk.after.epoch, chunk.after.sequence, chunk.at.epoch, chunk.at.sequence,
        std::uint64_t{chunk.part}, std::uint64_t{chunk.parts}})
    bytes::append_little_endian(numbers, number, sizeof number);
  return bytes::Crc32().add(numbers).add(chunk.bytes).value();
}

std::vector<Chunk> split(std::uint64_t leader, const Position& at, const std::string& whole) {
  std::vector<Chunk> out;
  for (std::size_t begin = 0; begin < whole.size(); begin += kPartBytes) {
    Chunk part;
    part.leader = leader;
    part.at = at;
    part.part = static_cast<std::uint32_t>(out.size());
    part.bytes = whole.substr(begin, kPartBytes);
    out.push_back(std::move(part));
  }
  for (Chunk& part : out) {
    part.parts = static_cast<std::uint32_t>(out.size());
    part.checksum = checksum(part);
  }
  return out;
}

}  // namespace roci::exec::standby
