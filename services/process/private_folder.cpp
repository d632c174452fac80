#include "services/process/private_folder.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

namespace roci::services::process {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kPrivate = 0700;

// Owns a descriptor of the folder, so that what is checked and what is changed is the same folder.
class OpenFolder {
 public:
  explicit OpenFolder(const fs::path& folder)
      : path_(folder), descriptor_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC)) {
    if (descriptor_ >= 0) return;
    const int error = errno;
    if (error == ENOTDIR || error == ELOOP) fail("is no folder, or a symbolic link");
    fail(std::string("cannot be opened: ") + std::strerror(error));
  }
  ~OpenFolder() { close(descriptor_); }
  OpenFolder(const OpenFolder&) = delete;
  OpenFolder& operator=(const OpenFolder&) = delete;

  void require_own() const {
    const struct stat status = this->status();
    if (status.st_uid != geteuid()) fail("belongs to another user");
    if ((status.st_mode & S_IWOTH) != 0) fail("can be written by every user");
  }
  void make_private() const {
    const struct stat status = this->status();
    if (status.st_uid != geteuid()) fail("belongs to another user");
    if ((status.st_mode & 07777) != kPrivate && fchmod(descriptor_, kPrivate) != 0)
      fail(std::string("cannot be made private: ") + std::strerror(errno));
  }

 private:
  struct stat status() const {
    struct stat out {};
    if (fstat(descriptor_, &out) != 0) fail(std::strerror(errno));
    return out;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(path_.string() + " " + what +
                             "; remove it, or choose another folder (--run-folder, XDG_RUNTIME_DIR)");
  }

  fs::path path_;
  int descriptor_;
};

void make_folder(const fs::path& folder) {
  if (folder.has_parent_path()) fs::create_directories(folder.parent_path());
  if (mkdir(folder.c_str(), kPrivate) == 0 || errno == EEXIST) return;
  throw std::runtime_error("cannot make the folder " + folder.string() + ": " + std::strerror(errno));
}

// A name that ends with '/' would be followed where it is a link.
fs::path without_slash(const fs::path& folder) {
  const fs::path normal = fs::absolute(folder).lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

}  // namespace

void make_own_folder(const fs::path& given) {
  const fs::path folder = without_slash(given);
  make_folder(folder);
  OpenFolder(folder).require_own();
}

void make_private_folder(const fs::path& given) {
  const fs::path folder = without_slash(given);
  make_folder(folder);
  OpenFolder(folder).make_private();
}

}  // namespace roci::services::process
