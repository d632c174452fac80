#include "services/launch/anchor_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>
#include <system_error>

namespace roci::services::launch {
namespace {

// Owns the locked file.
class LockedFile {
 public:
  explicit LockedFile(const std::filesystem::path& file)
      : file_(file.string()),
        descriptor_(open(file.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0600)) {
    if (descriptor_ < 0 || flock(descriptor_, LOCK_EX) != 0) fail("cannot open");
  }
  ~LockedFile() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  LockedFile(const LockedFile&) = delete;
  LockedFile& operator=(const LockedFile&) = delete;

  std::string read() const {
    std::array<char, 256> text{};
    const ssize_t size = pread(descriptor_, text.data(), text.size(), 0);
    if (size < 0) fail("cannot read");
    return {text.data(), static_cast<std::size_t>(size)};
  }
  void write(const std::string& text) const {
    const bool written =
        ftruncate(descriptor_, 0) == 0 &&
        pwrite(descriptor_, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size()) &&
        fsync(descriptor_) == 0;
    if (!written) fail("cannot write");
  }

 private:
  [[noreturn]] void fail(const char* what) const {
    throw std::system_error(errno, std::generic_category(), std::string(what) + " " + file_);
  }

  std::string file_;
  int descriptor_;
};

}  // namespace

std::optional<clock::HostAnchor> kept_anchor(const std::filesystem::path& folder,
                                             std::int64_t epoch_unix_us) {
  const LockedFile file(folder / kAnchorFile);
  if (auto kept = clock::anchor_of(file.read())) return kept;
  const clock::HostAnchor anchor = clock::anchor_host();
  if (anchor.unix_us < epoch_unix_us) return std::nullopt;
  file.write(to_text(anchor));
  return anchor;
}

}  // namespace roci::services::launch
