#include "services/security/private_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace roci::services::security {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& what, const fs::path& path) {
  throw std::system_error(errno, std::generic_category(), "cannot " + what + " " + path.string());
}

}  // namespace

void write_private(const fs::path& file, const std::string& text) {
  const fs::path unfinished = fs::path(file).concat(".new");
  std::error_code none;
  fs::remove(unfinished, none);
  const int out = open(unfinished.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (out < 0) fail("make", unfinished);
  const bool whole =
      write(out, text.data(), text.size()) == static_cast<ssize_t>(text.size()) && fsync(out) == 0;
  close(out);
  if (!whole) fail("write", unfinished);
  fs::rename(unfinished, file);
}

void make_private(const fs::path& folder) {
  if (!folder.parent_path().empty()) fs::create_directories(folder.parent_path());
  if (mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) fail("make", folder);
}

}  // namespace roci::services::security
