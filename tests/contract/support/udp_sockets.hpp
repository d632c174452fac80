// The UDP sockets of processes, as the kernel tells of them (proc(5)).
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace roci::services::contract {

/// Returns the local address of each UDP socket that a process has bound to a port, in whatever way it got one:
/// "127.0.0.1", or "[…]" for IPv6 in the kernel's own digits. A process that is gone, or another user's, has none.
std::vector<std::string> udp_addresses_of(pid_t process);

/// Returns the processes that this one has started, and those that they have.
std::vector<pid_t> processes_below(pid_t process);

}  // namespace roci::services::contract
