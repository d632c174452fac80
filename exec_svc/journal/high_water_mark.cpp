#include "exec_svc/journal/high_water_mark.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include "core/bytes/fnv_1a.hpp"

namespace roci::exec::journal {
namespace {

// Returns the two numbers as the file has them, which its checksum covers.
std::string numbers_text(const Extent& extent) {
  return std::to_string(extent.epoch) + " " + std::to_string(extent.record);
}

// Returns a text that always has one length, as it is written over the one before.
std::string to_text(const Extent& extent) {
  std::array<char, 96> out{};
  std::snprintf(out.data(), out.size(), "%20lld %20lld %20llu\n", static_cast<long long>(extent.epoch),
                static_cast<long long>(extent.record),
                static_cast<unsigned long long>(bytes::fnv_1a(numbers_text(extent))));
  return out.data();
}

}  // namespace

HighWaterMark::HighWaterMark(const std::filesystem::path& journal)
    : file_(std::filesystem::path(journal).concat("-mark")) {}

HighWaterMark::~HighWaterMark() {
  if (descriptor_ >= 0) close(descriptor_);
}

HighWaterMark::HighWaterMark(HighWaterMark&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

std::optional<Extent> HighWaterMark::read() const {
  std::ifstream in(file_, std::ios::binary);
  Extent extent;
  std::uint64_t stated = 0;
  if (!(in >> extent.epoch >> extent.record >> stated)) return std::nullopt;
  return stated == bytes::fnv_1a(numbers_text(extent)) ? std::optional(extent) : std::nullopt;
}

void HighWaterMark::write(const Extent& extent) noexcept {
  if (descriptor_ < 0)
    descriptor_ = open(file_.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC, S_IRUSR | S_IWUSR);
  if (descriptor_ < 0) return;
  const std::string text = to_text(extent);
  if (pwrite(descriptor_, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size())) remove();
}

void HighWaterMark::remove() noexcept {
  if (descriptor_ >= 0) close(std::exchange(descriptor_, -1));
  std::error_code none;
  std::filesystem::remove(file_, none);
}

}  // namespace roci::exec::journal
