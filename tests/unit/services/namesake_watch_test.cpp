#include "services/health/namesake_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace roci::services::health {
namespace {

using namespace std::chrono_literals;
using Precedence = NamesakeWatch::Precedence;

v1::Heartbeat process(std::int32_t id, std::uint32_t incarnation = 1, const std::string& host = "rover") {
  v1::Heartbeat out;
  out.service("sim_svc");
  out.host(host);
  out.process_id(id);
  out.incarnation(incarnation);
  out.state(v1::SERVICE_RUNNING);
  return out;
}

// The precedences that follow from heartbeats of `other`, four a second.
std::vector<Precedence> hear(NamesakeWatch& watch, const v1::Heartbeat& other, int beats) {
  std::vector<Precedence> out;
  clock::WallTime now{1000s};
  for (int i = 0; i < beats; ++i, now += 250ms) out.push_back(watch.hear(other, now));
  return out;
}

TEST(NamesakeWatch, BothProcessesAgreeWhoGoesOn) {
  const std::vector<v1::Heartbeat> processes{process(7), process(9), process(9, 2), process(3, 1, "scout")};
  for (const v1::Heartbeat& a : processes) {
    for (const v1::Heartbeat& b : processes) {
      if (a == b || (a.process_id() == b.process_id() && a.host() == b.host())) continue;
      NamesakeWatch at_a(a), at_b(b);
      const Precedence of_a = hear(at_a, b, 4).back(), of_b = hear(at_b, a, 4).back();
      EXPECT_NE(of_a, of_b);
      for (const Precedence one : {of_a, of_b}) EXPECT_NE(one, Precedence::nothing);
    }
  }
  NamesakeWatch older(process(7)), later(process(9)), restarted(process(9, 2));
  EXPECT_EQ(hear(later, process(7), 4).back(), Precedence::yields);
  EXPECT_EQ(hear(restarted, process(7), 4).back(), Precedence::goes_on);
  EXPECT_EQ(hear(older, process(9, 2), 4).back(), Precedence::yields);
}

TEST(NamesakeWatch, AFewForgedHeartbeatsEndNobody) {
  NamesakeWatch watch(process(7));
  for (const Precedence precedence : hear(watch, process(3), 3)) EXPECT_EQ(precedence, Precedence::nothing);
  NamesakeWatch flooded(process(7));
  for (int i = 0; i < 100; ++i) EXPECT_EQ(flooded.hear(process(3), clock::WallTime{1s}), Precedence::nothing);
  NamesakeWatch far(process(7));
  EXPECT_EQ(hear(far, process(3, 4'000'000'000U), 8).back(), Precedence::nothing)
      << "told once, and not believed";
}

TEST(NamesakeWatch, ItselfOthersAndWhoStopsAreNoNamesakes) {
  NamesakeWatch watch(process(7));
  EXPECT_EQ(hear(watch, process(7), 9).back(), Precedence::nothing);
  v1::Heartbeat other = process(3);
  other.service("arm_svc");
  EXPECT_EQ(hear(watch, other, 9).back(), Precedence::nothing);
  other = process(3);
  other.state(v1::SERVICE_STOPPING);
  EXPECT_EQ(hear(watch, other, 9).back(), Precedence::nothing);
}

TEST(NamesakeWatch, OperatorsAreToldOnce) {
  NamesakeWatch watch(process(7));
  const auto heard = hear(watch, process(9), 20);
  EXPECT_EQ(std::count(heard.begin(), heard.end(), Precedence::goes_on), 1);
}

}  // namespace
}  // namespace roci::services::health
