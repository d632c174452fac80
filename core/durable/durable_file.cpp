#include "core/durable/durable_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

namespace roci::durable {
namespace {

namespace fs = std::filesystem;

// Owns a descriptor.
class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags, mode_t mode = 0)
      : path_(path), value_(open(path.c_str(), flags | O_CLOEXEC, mode)) {
    if (value_ < 0) fail("cannot open");
  }
  ~Descriptor() { close(value_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  void write(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t written = ::write(value_, text.data(), text.size());
      if (written < 0 && errno != EINTR) fail("cannot write");
      if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  void sync() const {
    if (fsync(value_) != 0) fail("cannot write to the disk");
  }

 private:
  [[noreturn]] void fail(const char* what) const {
    throw std::system_error(errno, std::generic_category(), std::string(what) + " " + path_.string());
  }

  fs::path path_;
  int value_;
};

}  // namespace

void replace_file(const fs::path& file, std::string_view text, Durability durability, mode_t mode) {
  const fs::path unfinished = fs::path(file).concat(".new");
  std::error_code none;
  fs::remove(unfinished, none);
  {
    const Descriptor out(unfinished, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW, mode);
    out.write(text);
    if (durability == Durability::power) out.sync();
  }
  put_in_place(unfinished, file, durability);
}

void put_in_place(const fs::path& unfinished, const fs::path& file, Durability durability) {
  fs::rename(unfinished, file);
  if (durability == Durability::power) sync_folder(file.parent_path());
}

void sync_folder(const fs::path& folder) {
  Descriptor(folder.empty() ? fs::path(".") : folder, O_RDONLY | O_DIRECTORY).sync();
}

}  // namespace roci::durable
