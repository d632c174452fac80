#include <gtest/gtest.h>

#include <iostream>

#include "planner_svc/utility_htn/downlink/capacity.hpp"
#include "planner_svc/utility_htn/downlink/certificate.hpp"
#include "planner_svc/utility_htn/downlink/filling.hpp"
#include "planner_svc/utility_htn/downlink/selection.hpp"
#include "planner_svc/utility_htn/downlink/solver.hpp"
#include "tests/unit/planner_svc/utility_htn/downlink/brute_force.hpp"

namespace roci::planner::utility_htn::downlink {
namespace {

// All products of the question as one packing problem.
Packing packing_of(const RandomQuestion& question) {
  Packing out;
  Bins bins = bins_of(question.windows, question.limits);
  out.bins = std::move(bins.bins);
  out.sol_joules = std::move(bins.sol_joules);
  out.ranks = 3;
  for (const Product& product : question.products) {
    Item item{.bytes = product.bytes, .first = 0, .values = {}};
    while (item.first < question.windows.size() && question.windows[item.first].start < product.created)
      ++item.first;
    for (std::size_t rank = 0; rank < 3; ++rank)
      item.values.push_back(std::llround(product.utility[rank] * 1e6));
    out.items.push_back(std::move(item));
  }
  return out;
}

Worth without_earliness(Worth worth) {
  worth.earliness = 0;
  return worth;
}

TEST(RandomQuestions, AreAnsweredAsByBruteForce) {
  std::mt19937_64 random(1);
  Manager manager;
  for (int round = 0; round < 600; ++round) {
    const RandomQuestion question = draw(random, round % 2 == 0);
    ASSERT_EQ(fault(question, manager.assign(question.products, question.windows, question.limits)), "")
        << "round " << round;
  }
  // Both ways to an answer were gone.
  EXPECT_GT(manager.counts().certificate, 100u);
  EXPECT_GT(manager.counts().solver, 100u);
  EXPECT_EQ(manager.counts().open, 0u);
}

TEST(RandomQuestions, CertificateAndSolverAgree) {
  std::mt19937_64 random(3);
  int certified = 0;
  for (int round = 0; round < 600; ++round) {
    const Packing packing = packing_of(draw(random, false));
    const Certified quick = certify(packing);
    ASSERT_TRUE(holds(packing, quick.placement));
    const Solved exact = solve(packing, Placement(packing.items.size()), 2'000);  // from nothing
    ASSERT_TRUE(exact.best && exact.earliest && holds(packing, exact.placement)) << "round " << round;
    const Worth greedy = worth(packing, quick.placement);
    const Worth optimal = worth(packing, exact.placement);
    ASSERT_LE(greedy, optimal) << "round " << round;
    if (quick.best) {
      ASSERT_EQ(without_earliness(greedy), without_earliness(optimal)) << "round " << round;
    }
    if (quick.earliest) {
      ASSERT_EQ(greedy, optimal) << "round " << round;
    }
    certified += quick.earliest ? 1 : 0;
    // The gap is no smaller than it really is.
    if (!quick.best && quick.rank < packing.ranks) {
      const double truth = static_cast<double>(optimal.sums[quick.rank]);
      const double value = static_cast<double>(greedy.sums[quick.rank]);
      if (truth > 0) {
        ASSERT_GE(quick.gap + 1e-12, (truth - value) / truth) << "round " << round;
      }
    }
  }
  EXPECT_GT(certified, 100);
}

// What large questions are answered by, on small ones.
TEST(RandomQuestions, WhatIsSelectedAndFilledIsNoWorseAndItsBoundsHold) {
  std::mt19937_64 random(8);
  int best = 0, better = 0;
  for (int round = 0; round < 600; ++round) {
    const Packing packing = packing_of(draw(random, false));
    const Placement start = round % 2 == 0 ? certify(packing).placement : Placement(packing.items.size());
    const Solved filled = select_and_fill(packing, start, 200);
    ASSERT_TRUE(holds(packing, filled.placement)) << "round " << round;
    const Worth optimal = worth(packing, solve(packing, start, 2'000).placement);
    const Worth value = worth(packing, filled.placement);
    ASSERT_GE(value, worth(packing, start)) << "round " << round;
    ASSERT_LE(without_earliness(value), without_earliness(optimal)) << "round " << round;
    better += value > worth(packing, start) ? 1 : 0;
    best += filled.best ? 1 : 0;
    if (filled.best) {
      ASSERT_EQ(without_earliness(value), without_earliness(optimal)) << "round " << round;
      continue;
    }
    for (std::uint32_t rank = 0; rank < std::min<std::size_t>(filled.rank, packing.ranks); ++rank)
      ASSERT_EQ(value.sums[rank], optimal.sums[rank]) << "round " << round << ": it is proven there";
    if (filled.rank == packing.ranks) continue;
    const auto truth = static_cast<double>(optimal.sums[filled.rank]);
    ASSERT_GE(filled.gap * truth + 1e-6, truth - static_cast<double>(value.sums[filled.rank]))
        << "round " << round;
  }
  EXPECT_GT(best, 300);
  EXPECT_GT(better, 200);
}

// Items that fill all bins to the last byte, if each goes with the right others.
TEST(RandomQuestions, WhatFillsAllBinsIsFilledInWithNextToNothingLeft) {
  std::mt19937_64 random(9);
  for (int round = 0; round < 10; ++round) {
    Packing packing{.items = {}, .bins = std::vector<Bin>(20), .sol_joules = {}, .ranks = 1};
    Chosen chosen;
    std::uint64_t all = 0;
    for (std::uint32_t bin = 0; bin < packing.bins.size(); ++bin) {
      for (int i = 0; i < 15; ++i) {
        const std::uint64_t bytes = 1'000 + random() % 400'000;
        const auto first = static_cast<std::uint32_t>(random() % (bin + 1));
        packing.items.push_back({bytes, first, {static_cast<std::int64_t>(bytes)}});
        packing.bins[bin].capacity += bytes;
        all += bytes;
      }
      chosen.bytes.push_back(static_cast<double>(packing.bins[bin].capacity));
    }
    chosen.items.assign(packing.items.size(), true);
    const Placement placement = fill(packing, chosen);
    ASSERT_TRUE(holds(packing, placement));
    std::uint64_t placed = 0;
    for (std::size_t i = 0; i < placement.size(); ++i) placed += placement[i] ? packing.items[i].bytes : 0;
    EXPECT_GT(static_cast<double>(placed), 0.995 * static_cast<double>(all)) << "round " << round;
  }
}

TEST(RandomQuestions, WhetherAllFitIsTheSameByCertificateAndSolver) {
  std::mt19937_64 random(4);
  int yes = 0;
  int no = 0;
  for (int round = 0; round < 600; ++round) {
    const Packing packing = packing_of(draw(random, false));
    const std::optional<bool> exact = solve_all_fit(packing, 2'000);
    ASSERT_TRUE(exact) << "round " << round;
    const AllFit quick = all_fit(packing);
    if (quick == AllFit::unknown) continue;
    ASSERT_EQ(quick == AllFit::yes, *exact) << "round " << round;
    ++(*exact ? yes : no);
  }
  EXPECT_GT(yes, 50);
  EXPECT_GT(no, 50);
}

TEST(RandomQuestions, AdmissionIsAsByBruteForce) {
  std::mt19937_64 random(5);
  Manager manager;
  int admitted = 0;
  for (int round = 0; round < 400; ++round) {
    RandomQuestion question = draw(random, false);
    const std::size_t others = question.products.size() - 1;
    const std::vector<Product> candidate{question.products.back()};
    const std::vector<Product> products(question.products.begin(),
                                        question.products.begin() + static_cast<std::ptrdiff_t>(others));
    const bool answer = manager.admits(products, question.windows, question.limits, candidate);
    // What the manager sends without the candidate must have room beside it.
    const Assignment without = manager.assign(products, question.windows, question.limits);
    RandomQuestion rest{.products = {}, .windows = question.windows, .limits = question.limits};
    for (std::size_t p = 0; p < others; ++p) {
      if (without.window[p]) rest.products.push_back(products[p]);
    }
    rest.products.push_back(candidate.front());
    for (Product& product : rest.products) product.utility = {};
    const auto best = greatest(rest, model::Tier::mandatory,
                               std::vector<std::optional<std::uint32_t>>(rest.products.size()));
    ASSERT_EQ(answer, best[3] == static_cast<std::int64_t>(rest.products.size())) << "round " << round;
    admitted += answer ? 1 : 0;
  }
  EXPECT_GT(admitted, 50);
  EXPECT_LT(admitted, 350);
}

TEST(RandomQuestions, TheOrderOfProductsDoesNotMatterAndNothingIsPrinted) {
  std::mt19937_64 random(6);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  for (int round = 0; round < 100; ++round) {
    RandomQuestion question = draw(random, true);
    const Assignment one = Manager().assign(question.products, question.windows, question.limits);
    std::map<std::string, std::optional<std::uint32_t>> windows;
    for (std::size_t p = 0; p < question.products.size(); ++p)
      windows[question.products[p].id] = one.window[p];
    std::shuffle(question.products.begin(), question.products.end(), random);
    const Assignment other = Manager().assign(question.products, question.windows, question.limits);
    for (std::size_t p = 0; p < question.products.size(); ++p) {
      ASSERT_EQ(other.window[p], windows[question.products[p].id]) << "round " << round;
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(RandomQuestions, WhatIsTooLargeForTheSolverIsAnsweredByTheCertificateAlone) {
  std::mt19937_64 random(10);
  Manager hasty(Effort{.most_variables = 0, .most_items = 0});
  for (int round = 0; round < 50; ++round) {
    const RandomQuestion question = draw(random, true);
    const Assignment quick = hasty.assign(question.products, question.windows, question.limits);
    ASSERT_TRUE(allowed(question, quick.window));
    ASSERT_NE(quick.proof.by, Proof::By::solver);
  }
  EXPECT_GT(hasty.counts().open, 0U);
  EXPECT_EQ(hasty.counts().solver, 0U);
}

TEST(RandomQuestions, SpentEffortIsSaidAndLeavesAGap) {
  std::mt19937_64 random(7);
  Manager hasty(Effort{.most_variables = 0, .most_nodes_of_items = 1});
  Manager patient;
  int open = 0;
  for (int round = 0; round < 100; ++round) {
    const RandomQuestion question = draw(random, false);
    const Assignment quick = hasty.assign(question.products, question.windows, question.limits);
    const Assignment exact = patient.assign(question.products, question.windows, question.limits);
    ASSERT_TRUE(allowed(question, quick.window));
    if (quick.proof.by != Proof::By::bound) continue;
    ++open;
    const std::uint32_t rank = quick.proof.rank;
    if (quick.proof.gap == 0 || rank >= 3) continue;
    const auto value = worth_of(question, model::Tier::mandatory, quick.window)[rank];
    const auto truth = worth_of(question, model::Tier::mandatory, exact.window)[rank];
    ASSERT_GE(static_cast<double>(value), (1 - quick.proof.gap) * static_cast<double>(truth) - 1e-6);
  }
  EXPECT_GT(open, 10);
  EXPECT_EQ(hasty.counts().solver, 0u);
}

}  // namespace
}  // namespace roci::planner::utility_htn::downlink
