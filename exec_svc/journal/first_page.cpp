#include "exec_svc/journal/first_page.hpp"

#include <cstdint>
#include <fstream>
#include <string>

#include "exec_svc/journal/journal.hpp"

namespace roci::exec::journal {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kHeaderSize = 100;
constexpr std::size_t kPageSizeAt = 16;
constexpr std::size_t kChangesAt = 24;    // file change counter
constexpr std::size_t kPagesAt = 28;      // size of the database
constexpr std::size_t kFirstFreeAt = 32;  // first page of the freelist
constexpr std::size_t kFreeAt = 36;       // its length
constexpr std::size_t kValidForAt = 92;   // the change for which the size holds

std::uint32_t number_at(const std::string& page, std::size_t at, std::size_t bytes) {
  std::uint32_t out = 0;
  for (std::size_t i = 0; i < bytes; ++i) out = out << 8 | static_cast<unsigned char>(page[at + i]);
  return out;
}

void put_number(std::string& page, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) page[at + i] = static_cast<char>(value >> (24 - 8 * i));
}

}  // namespace

bool replace_first_page(const fs::path& damaged, const fs::path& whole) {
  std::ifstream in(whole, std::ios::binary);
  std::string page(kHeaderSize, '\0');
  if (!in.read(page.data(), kHeaderSize)) throw JournalError("cannot read " + whole.string());
  const std::uint32_t stated = number_at(page, kPageSizeAt, 2);
  const std::uint32_t size = stated == 1 ? 65536 : stated;
  page.resize(size);
  if (!in.seekg(0).read(page.data(), size)) throw JournalError("cannot read " + whole.string());
  const auto pages = static_cast<std::uint32_t>(fs::file_size(damaged) / size);
  if (pages < 2) return false;
  put_number(page, kPagesAt, pages);
  put_number(page, kFirstFreeAt, 0);
  put_number(page, kFreeAt, 0);
  put_number(page, kValidForAt, number_at(page, kChangesAt, 4));
  std::fstream out(damaged, std::ios::binary | std::ios::in | std::ios::out);
  if (!out.write(page.data(), size).flush()) throw JournalError("cannot write " + damaged.string());
  return true;
}

}  // namespace roci::exec::journal
