// The launcher's end of services/health/sign_of_life.hpp.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace roci::services::launch {

class SignsOfLife {
 public:
  SignsOfLife();  // throws std::system_error
  ~SignsOfLife();
  SignsOfLife(const SignsOfLife&) = delete;
  SignsOfLife& operator=(const SignsOfLife&) = delete;

  const std::string& address() const { return address_; }  // for NOTIFY_SOCKET
  std::vector<pid_t> take();  // the processes that gave one since the last call, as often as they did

 private:
  int socket_ = -1;
  std::string address_;
};

}  // namespace roci::services::launch
