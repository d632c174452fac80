// This file holds the fixture of the tests of downlinks in the planning cycle: the toy lander with a radio.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "planner_svc/utility_htn/cycle/cycle.hpp"
#include "planner_svc/utility_htn/delivery/delivery.hpp"
#include "tests/unit/planner_svc/utility_htn/cycle/toy_network.hpp"

namespace roci::planner::utility_htn::delivery {

/// Gives each test a toy lander with a radio, which it may change before start(): `send_sample` and `send_view` take
/// 20 s at 5 W, and 10 bytes go in each second.
class DeliveryTest : public ::testing::Test {
 protected:
  DeliveryTest() {
    add_parameter("rate_bytes_per_s", 10);
    for (const char* id : {"send_sample", "send_view"}) task(id).downlinks = true;
    task("dig").products = {{"trench", model::Tier::mandatory, {150}, {0.5}}};
  }

  void add_parameter(const std::string& name, double value) {
    network_.parameters.push_back({name, value, 0, 1e9});
  }
  model::Task& task(const std::string& id) { return network_.tasks[testing::task_named(network_, id)]; }

  void start() {
    chains_ = flattening::flatten_all(network_);
    cycle_ = std::make_unique<cycle::Cycle>(network_, chains_, assessor_, *scheduler_, temporal::Time{0});
    delivery_ = std::make_unique<Delivery>(network_);
    cycle_->deliver_by(*delivery_);
  }

  std::vector<std::string> planned(temporal::Time now = temporal::Time{0}) {
    if (cycle_ == nullptr) start();
    cycle_->run(now);
    std::vector<std::string> out;
    for (const cycle::Block& one : cycle_->blocks())
      out.push_back(network_.tasks[chains_.chains[one.chain].task].id);
    std::ranges::sort(out);
    return out;
  }

  Schedule schedule(temporal::Time now = temporal::Time{0}) const {
    return delivery_->schedule(cycle_->data(), cycle_->past().values, now);
  }
  const Downlink& downlink(const Schedule& schedule, const std::string& id) {
    return *std::ranges::find(schedule.downlinks, testing::task_named(network_, id), &Downlink::task);
  }
  Existing stored(const std::string& id, model::Tier tier, std::uint64_t bytes, double utility = 1) {
    return {{id, tier, bytes, temporal::Time{0}, {utility}},
            testing::task_named(network_, "image"),
            testing::task_named(network_, "view")};
  }

  model::Network network_ = testing::toy_network();
  flattening::Chains chains_;
  assessor::NetworkAssessor assessor_;
  std::unique_ptr<search::Scheduler> scheduler_ = search::make_scheduler("earliest");
  std::unique_ptr<cycle::Cycle> cycle_;
  std::unique_ptr<Delivery> delivery_;
};

}  // namespace roci::planner::utility_htn::delivery
