// This file holds the fixture of the tests of the planning cycle: a toy network, its chains and a scheduler.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "planner_svc/utility_htn/assessor/assessor.hpp"
#include "planner_svc/utility_htn/cycle/cycle.hpp"
#include "tests/unit/planner_svc/utility_htn/cycle/toy_network.hpp"

namespace roci::planner::utility_htn::cycle {

/// Gives each test a toy network of its own, which it may change before make().
class CycleTest : public ::testing::Test {
 protected:
  Cycle make(Settings settings = {}) {
    chains_ = flattening::flatten_all(network_);
    return {network_, chains_, assessor_, *scheduler_, temporal::Time{0}, settings};
  }

  std::vector<std::string> requests(const Cycle& cycle) const {
    std::vector<std::string> out;
    for (const Block& one : cycle.blocks()) out.push_back(network_.tasks[chains_.chains[one.chain].task].id);
    std::ranges::sort(out);
    return out;
  }

  const Block& block_of_request(const Cycle& cycle, const std::string& id) const {
    for (const Block& one : cycle.blocks())
      if (network_.tasks[chains_.chains[one.chain].task].id == id) return one;
    throw std::logic_error("no block of " + id);
  }

  // Its first link is committed.
  Block sample_in(Cycle& cycle) const {
    cycle.run(temporal::Time{0});
    cycle.run(std::chrono::seconds(10));
    const Block& out = block_of_request(cycle, "sample");
    EXPECT_EQ(out.links.front().stage, Stage::committed);
    return out;
  }

  model::Network network_ = testing::toy_network();
  flattening::Chains chains_;
  assessor::NetworkAssessor assessor_;
  std::unique_ptr<search::Scheduler> scheduler_ = search::make_scheduler("earliest");
};

}  // namespace roci::planner::utility_htn::cycle
