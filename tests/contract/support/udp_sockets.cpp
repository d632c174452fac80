#include "tests/contract/support/udp_sockets.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

namespace roci::services::contract {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(pid_t process) { return fs::path("/proc") / std::to_string(process); }

// The inodes of a process's sockets: what its descriptors link to is named "socket:[INODE]".
std::set<std::string> sockets_of(pid_t process) {
  std::set<std::string> out;
  std::error_code gone;
  for (const auto& descriptor : fs::directory_iterator(folder_of(process) / "fd", gone)) {
    const std::string target = fs::read_symlink(descriptor.path(), gone).string();
    if (target.starts_with("socket:[")) out.insert(target.substr(8, target.size() - 9));
  }
  return out;
}

// "0100007F" is written backwards.
std::string address_in(const std::string& digits) {
  if (digits.size() != 8) return "[" + digits + "]";
  std::string out;
  for (int at = 6; at >= 0; at -= 2)
    out += std::to_string(std::stoi(digits.substr(static_cast<std::size_t>(at), 2), nullptr, 16)) +
           (at > 0 ? "." : "");
  return out;
}

}  // namespace

std::vector<std::string> udp_addresses_of(pid_t process) {
  std::vector<std::string> out;
  const std::set<std::string> sockets = sockets_of(process);
  for (const char* table : {"net/udp", "net/udp6", "net/udplite", "net/udplite6"}) {
    std::ifstream in(folder_of(process) / table);
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
      std::istringstream words(line);
      const std::vector<std::string> column{std::istream_iterator<std::string>(words), {}};
      if (column.size() > 9 && sockets.contains(column[9]))
        out.push_back(address_in(column[1].substr(0, column[1].find(':'))));
    }
  }
  return out;
}

std::vector<pid_t> processes_below(pid_t process) {
  std::vector<pid_t> out;
  std::error_code gone;
  for (const auto& thread : fs::directory_iterator(folder_of(process) / "task", gone)) {
    std::ifstream in(thread.path() / "children");
    for (pid_t child = 0; in >> child;) {
      out.push_back(child);
      std::ranges::copy(processes_below(child), std::back_inserter(out));
    }
  }
  return out;
}

}  // namespace roci::services::contract
