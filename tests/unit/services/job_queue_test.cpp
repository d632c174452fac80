#include "services/node/job_queue.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <numeric>
#include <vector>

namespace roci::services::node {
namespace {

TEST(JobQueue, RunsJobsInTheirOrder) {
  std::vector<int> order;
  std::promise<void> done;
  JobQueue jobs;
  for (int i = 0; i < 500; ++i) jobs.push([&order, i](const std::stop_token&) { order.push_back(i); });
  jobs.push([&done](const std::stop_token&) { done.set_value(); });
  done.get_future().wait();
  std::vector<int> expected(500);
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(order, expected);
}

TEST(JobQueue, DestructionStopsTheRunningJobAndDropsTheRest) {
  std::atomic<int> ran = 0;
  std::promise<void> started;
  {
    JobQueue jobs;
    jobs.push([&](const std::stop_token& stop) {
      ++ran;
      started.set_value();
      while (!stop.stop_requested()) std::this_thread::yield();
    });
    jobs.push([&](const std::stop_token&) { ++ran; });
    started.get_future().wait();
  }
  EXPECT_EQ(ran, 1);
}

}  // namespace
}  // namespace roci::services::node
