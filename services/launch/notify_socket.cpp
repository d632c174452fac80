#include "services/launch/notify_socket.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <system_error>

namespace roci::services::launch {
namespace {

// The kernel chooses a free abstract name.
std::string bind_somewhere(int socket) {
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  if (bind(socket, reinterpret_cast<const sockaddr*>(&name), sizeof name.sun_family) != 0) return "";
  socklen_t size = sizeof name;
  if (getsockname(socket, reinterpret_cast<sockaddr*>(&name), &size) != 0) return "";
  return "@" + std::string(name.sun_path + 1, size - offsetof(sockaddr_un, sun_path) - 1);
}

// Empty where the name does not fit.
std::string bind_in(int socket, const std::filesystem::path& folder) {
  const std::string path = folder / ("notify-" + std::to_string(getpid()));
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  if (path.front() != '/' || path.size() >= sizeof name.sun_path) return "";
  path.copy(name.sun_path, path.size());
  unlink(path.c_str());  // of a process of the same number that was killed
  if (bind(socket, reinterpret_cast<const sockaddr*>(&name), sizeof name) != 0) return "";
  return path;
}

// The kernel says who sent it.
pid_t sender_of(msghdr& message) {
  for (cmsghdr* part = CMSG_FIRSTHDR(&message); part != nullptr; part = CMSG_NXTHDR(&message, part)) {
    if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SCM_CREDENTIALS) continue;
    ucred sender{};
    std::memcpy(&sender, CMSG_DATA(part), sizeof sender);
    return sender.uid == geteuid() ? sender.pid : -1;
  }
  return -1;
}

}  // namespace

NotifySocket::NotifySocket(const std::filesystem::path& folder)
    : socket_(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
  const int on = 1;
  if (socket_ >= 0 && setsockopt(socket_, SOL_SOCKET, SO_PASSCRED, &on, sizeof on) == 0) {
    if (!folder.empty()) address_ = bind_in(socket_, folder);
    if (address_.empty()) address_ = bind_somewhere(socket_);
  }
  if (!address_.empty()) return;
  const int error = errno;
  if (socket_ >= 0) close(socket_);
  throw std::system_error(error, std::generic_category(), "cannot open a socket for notifications");
}

NotifySocket::~NotifySocket() {
  close(socket_);
  if (address_.starts_with('/')) unlink(address_.c_str());
}

std::vector<pid_t> NotifySocket::receive() {
  std::vector<pid_t> senders;
  for (;;) {
    std::array<char, 256> text{};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(ucred))> control{};
    iovec content{text.data(), text.size()};
    msghdr message{};
    message.msg_iov = &content;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    if (recvmsg(socket_, &message, MSG_CMSG_CLOEXEC) < 0) return senders;
    if (const pid_t sender = sender_of(message); sender >= 0) senders.push_back(sender);
  }
}

}  // namespace roci::services::launch
