#include "planner_svc/utility_htn/search/bound.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "planner_svc/utility_htn/search/chain_table.hpp"
#include "planner_svc/utility_htn/search/score.hpp"

namespace roci::planner::utility_htn::search {

using flattening::Chain;
using model::Subtask, model::TaskIndex;
using temporal::RankVector;
using temporal::timelines::Constraint, temporal::timelines::Index;

namespace {

// A piece of a concave curve of score over cost.
struct Piece {
  double cost = 0;
  double score = 0;
};

// Whether a brings more per cost than b; what costs nothing comes first.
bool steeper(const Piece& a, const Piece& b) { return a.score * b.cost > b.score * a.cost; }

// The pieces of the upper concave hull of the origin and the choices, of which one may be taken.
std::vector<Piece> hull(std::vector<Piece> choices) {
  std::ranges::sort(choices, [](const Piece& a, const Piece& b) {
    return a.cost != b.cost ? a.cost < b.cost : a.score > b.score;
  });
  std::vector<Piece> out;
  double cost = 0, score = 0;  // where the hull so far ends
  for (const Piece& choice : choices) {
    if (choice.score <= score) continue;
    Piece piece{choice.cost - cost, choice.score - score};
    while (!out.empty() && !steeper(out.back(), piece)) {
      piece.cost += out.back().cost;
      piece.score += out.back().score;
      out.pop_back();
    }
    out.push_back(piece);
    cost = choice.cost;
    score = choice.score;
  }
  return out;
}

// The hull of a site: what its pieces bring once the charge is paid,
// and the straight line from the origin that lies above it.
std::vector<Piece> charged(std::vector<Piece> pieces, double charge) {
  std::ranges::stable_sort(pieces, steeper);
  Piece line{charge, 0};
  std::size_t used = 0;
  while (used < pieces.size() && (used == 0 || !steeper(line, pieces[used]))) {
    line.cost += pieces[used].cost;
    line.score += pieces[used].score;
    ++used;
  }
  std::vector<Piece> out;
  if (used > 0) out.push_back(line);
  out.insert(out.end(), pieces.begin() + static_cast<std::ptrdiff_t>(used), pieces.end());
  return out;
}

double filled(std::vector<Piece> pieces, double budget) {
  std::ranges::stable_sort(pieces, steeper);
  double score = 0;
  for (const Piece& piece : pieces) {
    if (piece.cost > budget) return budget > 0 ? score + piece.score * budget / piece.cost : score;
    budget -= piece.cost;
    score += piece.score;
  }
  return score;
}

class Bound {
 public:
  explicit Bound(const Problem& problem) : problem_(problem), table_(problem) {
    const assessor::Context context{problem.network,       problem.values,   problem.chains,
                                    problem.timelines_now, problem.products, {},
                                    problem.closed};
    for (std::uint32_t chain = 0; chain < problem.chains.chains.size(); ++chain) {
      if (!table_.open(chain)) continue;
      requests_[table_.chain(chain).task].push_back({chain, rounded(problem.assessor.most(chain, context))});
    }
    find_sites();
  }

  RankVector run() const {
    std::size_t ranks = 0;
    for (const auto& [request, options] : requests_) {
      for (const Option& option : options) ranks = std::max(ranks, option.most.scores().size());
    }
    std::vector<double> out;
    for (std::size_t rank = 0; rank < ranks; ++rank) out.push_back(at(rank));
    return RankVector(std::move(out));
  }

 private:
  struct Option {
    std::uint32_t chain = 0;
    RankVector most{};
  };
  // A site that is not open yet.
  struct ClosedSite {
    std::set<TaskIndex> requests;
    std::set<std::uint32_t> openers;  // chains
    double charge = 0;
  };

  double at(std::size_t rank) const {
    double budget = problem_.budget;
    for (const auto& [request, options] : requests_) {
      double gain = 0;
      for (const Option& option : options) gain = std::max(gain, -table_.cost(option.chain));
      budget += gain;
    }
    std::vector<Piece> pieces;
    std::set<TaskIndex> done;
    for (const ClosedSite& site : sites_) {
      std::vector<Piece> of_site;
      for (const TaskIndex request : site.requests) {
        const std::vector<Piece> more = hull(choices(request, rank, &site));
        of_site.insert(of_site.end(), more.begin(), more.end());
        done.insert(request);
      }
      const std::vector<Piece> more = charged(std::move(of_site), site.charge);
      pieces.insert(pieces.end(), more.begin(), more.end());
    }
    for (const auto& [request, options] : requests_) {
      if (done.contains(request)) continue;
      const std::vector<Piece> more = hull(choices(request, rank, nullptr));
      pieces.insert(pieces.end(), more.begin(), more.end());
    }
    // Predictions are whole billionths; what lies less than a thousandth of one above is an error of the sum.
    return std::ceil(filled(std::move(pieces), budget) * 1e9 - 1e-3) / 1e9;
  }

  std::vector<Piece> choices(TaskIndex request, std::size_t rank, const ClosedSite* site) const {
    std::vector<Piece> out;
    for (const Option& option : requests_.at(request)) {
      double cost = std::max(0.0, table_.cost(option.chain));
      if (site != nullptr && site->openers.contains(option.chain)) cost = std::max(0.0, cost - site->charge);
      out.push_back({cost, std::max(0.0, option.most[rank])});
    }
    return out;
  }

  bool changes(const Chain& chain, Index timeline) const {
    return std::ranges::any_of(chain.links, [&](const Subtask& link) {
      return std::ranges::any_of(problem_.network.tasks[link.task].impacts,
                                 [&](const model::Impact& impact) { return impact.timeline == timeline; });
    });
  }

  // Whether the constraint does not hold now, nor ever by what is committed.
  bool broken_now(const Constraint& constraint) const {
    if (constraint.timeline >= problem_.timelines_now.size()) return false;
    const bool holds = constraint.admits(problem_.timelines_now[constraint.timeline]);
    return !holds && std::ranges::none_of(problem_.committed, [&](const Placed& placed) {
      return changes(table_.chain(placed.chain), constraint.timeline);
    });
  }

  // The timelines for whose values the chain would wait now.
  std::set<Index> waits_for(const Chain& chain) const {
    std::set<Index> out;
    for (const Constraint& constraint : chain.when) {
      if (broken_now(constraint)) out.insert(constraint.timeline);
    }
    for (const Subtask& link : chain.links) {
      for (const Constraint& constraint : problem_.network.tasks[link.task].constraints) {
        if (broken_now(constraint)) out.insert(constraint.timeline);
      }
    }
    std::erase_if(out, [&](Index timeline) { return changes(chain, timeline); });
    return out;
  }

  void find_sites() {
    for (const model::Site& site : problem_.network.subway.sites) {
      for (const model::Target& target : site.targets) claimed_.insert(target.task);
    }
    for (const model::Site& site : problem_.network.subway.sites) {
      ClosedSite closed;
      for (const model::Target& target : site.targets) {
        if (requests_.contains(target.task)) closed.requests.insert(target.task);
      }
      std::set<Index> candidates;
      for (const TaskIndex request : closed.requests) {
        for (const Option& option : requests_.at(request))
          candidates.merge(waits_for(table_.chain(option.chain)));
      }
      for (const Index timeline : candidates) {
        if (!is_closed_by(timeline, closed)) continue;
        sites_.push_back(closed);
        break;
      }
    }
  }

  // Whether all chains of the site but its openers wait for this timeline, which only the openers change.
  bool is_closed_by(Index timeline, ClosedSite& site) {
    site.openers.clear();
    std::optional<double> charge;
    std::vector<TaskIndex> joined;
    for (const auto& [request, options] : requests_) {
      const bool inside = site.requests.contains(request);
      std::optional<double> opener, other;
      std::size_t outside_openers = 0;
      for (const Option& option : options) {
        const Chain& chain = table_.chain(option.chain);
        const double cost = std::max(0.0, table_.cost(option.chain));
        if (changes(chain, timeline)) {
          outside_openers += !inside;
          site.openers.insert(option.chain);
          opener = std::min(opener.value_or(cost), cost);
        } else if (inside) {
          if (!waits_for(chain).contains(timeline)) return false;
          other = std::min(other.value_or(cost), cost);
        }
      }
      if (!opener) continue;
      // A request that only opens the site belongs to it; one that may do something else,
      // or samples another site, does not.
      if (!inside && (outside_openers < options.size() || !claimed_.insert(request).second)) return false;
      if (!inside) joined.push_back(request);
      const double extra = std::max(0.0, *opener - other.value_or(0.0));
      charge = std::min(charge.value_or(extra), extra);
    }
    site.requests.insert(joined.begin(), joined.end());
    site.charge = charge.value_or(0.0);
    return !site.openers.empty();
  }

  const Problem& problem_;
  ChainTable table_;
  std::map<TaskIndex, std::vector<Option>> requests_;
  std::vector<ClosedSite> sites_;
  std::set<TaskIndex> claimed_;  // requests that belong to a site
};

}  // namespace

RankVector utility_bound(const Problem& problem) { return Bound(problem).run(); }

}  // namespace roci::planner::utility_htn::search
