#include "tests/fuzz/files/damage.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace roci::fuzz {
namespace {

std::size_t below(std::mt19937_64& random, std::size_t bound) { return bound == 0 ? 0 : random() % bound; }

void damage_once(std::string& bytes, std::mt19937_64& random) {
  const std::size_t at = below(random, bytes.size() + 1);
  const std::size_t length = below(random, std::min<std::size_t>(bytes.size() - at, 512) + 1);
  switch (below(random, 6)) {
    case 0:
      bytes.resize(at);
      break;
    case 1:
      std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), length, '\0');
      break;
    case 2:
      bytes.insert(below(random, bytes.size() + 1), bytes.substr(at, length));
      break;
    case 3:
      std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), std::min<std::size_t>(length, 9), '\xff');
      break;
    default:
      for (std::size_t i = 0; i < 4 && !bytes.empty(); ++i)
        bytes[below(random, bytes.size())] = static_cast<char>(random());
  }
}

}  // namespace

std::string damaged(std::string bytes, std::mt19937_64& random) {
  for (std::size_t count = 1 + below(random, 4); count > 0; --count) damage_once(bytes, random);
  return bytes;
}

std::string read_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

}  // namespace roci::fuzz
