// What a child process of the launcher has of its parent.
#include "services/launch/child.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <thread>

namespace roci::services::launch {
namespace {

using testing::HasSubstr;
using testing::Not;

// The vendors open sockets that an exec leaves open, as this test does.
TEST(ChildTest, InheritsNothingButTheStandardFiles) {
  const auto log = std::filesystem::temp_directory_path() / ("roci_child_" + std::to_string(getpid()));
  const int udp = socket(AF_INET, SOCK_DGRAM, 0);
  const int file = open("/dev/zero", O_RDONLY);
  ASSERT_GT(udp, STDERR_FILENO);
  ASSERT_GT(file, STDERR_FILENO);
  Child lister("/bin/sh", {"sh", "-c", "exec find /proc/self/fd -printf '%f %l\\n'"}, log);
  while (!lister.ending()) std::this_thread::yield();
  EXPECT_EQ(lister.ending()->code, 0);
  EXPECT_EQ(fcntl(udp, F_GETFD), 0) << "this process keeps its own as they are";
  close(udp);
  close(file);
  std::stringstream listed;
  listed << std::ifstream(log).rdbuf();
  std::filesystem::remove(log);
  EXPECT_THAT(listed.str(), HasSubstr("2 " + log.string()));
  EXPECT_THAT(listed.str(), Not(HasSubstr("socket:")));
  EXPECT_THAT(listed.str(), Not(HasSubstr("/dev/zero")));
}

}  // namespace
}  // namespace roci::services::launch
