#include "planner_svc/timeline_htn/search/resolvers.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <limits>
#include <optional>
#include <thread>
#include <utility>

namespace roci::planner::timeline_htn::search {

namespace {

constexpr std::uint64_t kFirstRound = 1000;

constexpr std::pair<const char*, Heuristic> kHeuristics[] = {{"blind", Heuristic::blind},
                                                             {"relaxed_plan", Heuristic::relaxed_plan},
                                                             {"landmarks", Heuristic::landmarks}};
constexpr std::string_view kLast = "_last";

// Runs the jobs on threads; what one throws is thrown again.
void run_all(std::size_t jobs, std::size_t threads, const std::function<void(std::size_t)>& run) {
  if (std::min(jobs, threads) <= 1) {
    for (std::size_t job = 0; job < jobs; ++job) run(job);
    return;
  }
  std::atomic<std::size_t> next{0};
  std::vector<std::exception_ptr> thrown(jobs);
  const auto work = [&] {
    for (std::size_t job = next++; job < jobs; job = next++) {
      try {
        run(job);
      } catch (...) {
        thrown[job] = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> workers;
    for (std::size_t i = 1; i < std::min(jobs, threads); ++i) workers.emplace_back(work);
    work();
  }
  for (const std::exception_ptr& one : thrown)
    if (one) std::rethrow_exception(one);
}

}  // namespace

std::optional<Resolver> resolver_named(std::string_view name) {
  Resolver out;
  if (name.ends_with(kLast)) {
    out.order = Order::last_declared;
    name.remove_suffix(kLast.size());
  }
  for (const auto& [word, heuristic] : kHeuristics)
    if (name == word) {
      out.heuristic = heuristic;
      return out;
    }
  return std::nullopt;
}

std::vector<std::string> resolver_names() {
  std::vector<std::string> out;
  for (const auto& [word, heuristic] : kHeuristics) {
    out.emplace_back(word);
    out.push_back(out.back() + std::string(kLast));
  }
  return out;
}

Resolution resolve(const model::Model& model, const std::vector<Resolver>& resolvers, std::size_t threads,
                   std::uint64_t evaluations, std::size_t memory_bytes,
                   const std::function<bool()>& cancelled) {
  std::vector<std::unique_ptr<Search>> searches;
  for (const Resolver& resolver : resolvers) searches.push_back(std::make_unique<Search>(model, resolver));
  std::vector<Outcome> outcomes(searches.size(), Outcome::searching);
  const std::uint64_t most = std::max<std::uint64_t>(1, evaluations / searches.size());
  Resolution out;
  std::optional<std::size_t> chosen;
  for (std::uint64_t round = std::min(kFirstRound, most);; round = round > most / 2 ? most : 2 * round) {
    run_all(searches.size(), threads, [&](std::size_t i) {
      if (outcomes[i] == Outcome::searching)
        outcomes[i] = searches[i]->run(round, memory_bytes / searches.size(), cancelled);
    });
    for (std::size_t i = 0; i < searches.size(); ++i) {
      if (outcomes[i] == Outcome::solved &&
          (!chosen || searches[i]->count().expanded < searches[*chosen]->count().expanded))
        chosen = i;
    }
    const auto first = [&](Outcome outcome) {
      const auto found = std::ranges::find(outcomes, outcome);
      if (!chosen && found != outcomes.end()) chosen = static_cast<std::size_t>(found - outcomes.begin());
    };
    first(Outcome::exhausted);
    first(Outcome::cancelled);
    const bool searching = std::ranges::find(outcomes, Outcome::searching) != outcomes.end();
    if (!chosen && (round >= most || !searching)) {
      first(Outcome::searching);
      first(Outcome::out_of_memory);
    }
    if (chosen) break;
  }
  for (const auto& search : searches) {
    out.expanded += search->count().expanded;
    out.evaluated += search->count().evaluated;
  }
  out.resolver = *chosen;
  out.outcome = outcomes[*chosen];
  out.search = std::move(searches[*chosen]);
  return out;
}

}  // namespace roci::planner::timeline_htn::search
