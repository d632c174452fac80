// The rules of the subway map (section II.B.2, figure 3, R112), applied to the samples of the plan one after the other.
#include <algorithm>
#include <iterator>
#include <optional>
#include <set>

#include "planner_svc/utility_htn/checking/parts.hpp"

namespace roci::planner::utility_htn::checking {
namespace {

struct Target {
  bool free = true;     // it is still asked for
  bool beyond = false;  // nothing leads to it any more
  double visual = 0;
};

struct Site {
  double value = 0;
  std::uint32_t samples = 0;
  bool negative = false;
  std::vector<Target> targets;

  bool open(std::uint32_t most) const {
    return !negative && samples < most &&
           std::ranges::any_of(targets, [](const Target& target) { return target.free && !target.beyond; });
  }
};

double newest(const Question& question, temporal::timelines::Index timeline) {
  double out = question.network.timelines[timeline].initial;
  std::optional<temporal::Time> sampled;
  for (const Observation& observation : question.observations) {
    if (observation.timeline != timeline || (sampled && observation.sampled < *sampled)) continue;
    sampled = observation.sampled;
    out = observation.value;
  }
  return out;
}

std::vector<Site> sites_of(const Question& question, const std::set<model::TaskIndex>& beyond) {
  std::vector<Site> out;
  for (const model::Site& site : question.network.subway.sites) {
    Site here{.value = model::evaluate(site.value, question.values), .targets = {}};
    for (const model::Target& target : site.targets) {
      const double signature = newest(question, target.signature);  // 0 unknown, 1 negative, 2 positive
      const bool closed = std::ranges::find(question.closed, target.task) != question.closed.end();
      here.targets.push_back({.free = signature == 0 && !closed,
                              .beyond = beyond.contains(target.task),
                              .visual = model::evaluate(target.visual, question.values)});
      here.samples += signature != 0 ? 1 : 0;
      here.negative |= signature == 1;
    }
    out.push_back(std::move(here));
  }
  return out;
}

Faults faults_of(const Question& question, const std::set<model::TaskIndex>& beyond) {
  Faults out;
  const model::SubwayMap& map = question.network.subway;
  std::vector<Site> sites = sites_of(question, beyond);
  std::vector<const Block*> blocks;
  for (const Block& block : question.plan) {
    if (!block.steps.empty()) blocks.push_back(&block);
  }
  std::ranges::stable_sort(blocks, {}, [](const Block* block) { return block->steps.front().start; });
  for (const Block* block : blocks) {
    for (std::size_t s = 0; s < sites.size(); ++s) {
      for (std::size_t t = 0; t < sites[s].targets.size(); ++t) {
        if (map.sites[s].targets[t].task != block->request) continue;
        Site& site = sites[s];
        Target& target = site.targets[t];
        const std::string who = "sample '" + question.network.tasks[block->request].id + "'";
        const bool begun = std::ranges::any_of(block->steps, [](const Step& step) { return step.committed; });
        if (begun && !target.free) continue;  // its signature is known, and counted
        if (!begun) {
          if (!target.free) out.push_back(who + ": that target is sampled or closed already");
          if (site.negative)
            out.push_back(who + ": a signature of site '" + map.sites[s].name +
                          "' is negative, which ends sampling there");
          if (site.samples >= map.most_samples) {
            out.push_back(who + ": site '" + map.sites[s].name + "' would have more than " +
                          std::to_string(map.most_samples) + " samples");
          }
          for (std::size_t o = 0; o < sites.size(); ++o) {
            if (o == s || site.samples > 0 || !sites[o].open(map.most_samples)) continue;
            if (sites[o].samples > 0)
              out.push_back(who + ": site '" + map.sites[o].name + "' is begun and goes first");
            if (sites[o].samples == 0 && sites[o].value > site.value + 1e-9) {
              out.push_back(who + ": site '" + map.sites[o].name + "' has the greater value and goes first");
            }
          }
          for (std::size_t o = 0; o < site.targets.size(); ++o) {
            if (o != t && site.targets[o].free && !site.targets[o].beyond &&
                site.targets[o].visual > target.visual + 1e-9) {
              out.push_back(who + ": target '" + question.network.tasks[map.sites[s].targets[o].task].id +
                            "' has the greater value and goes first");
            }
          }
        }
        if (target.free) ++site.samples;
        target.free = false;
      }
    }
  }
  return out;
}

}  // namespace

// What is out of reach excuses others, and is looked for only where there is something to excuse.
void check_subway_map(const Question& question, Faults& out) {
  Faults found = faults_of(question, {});
  if (!found.empty()) found = faults_of(question, out_of_reach(question));
  std::ranges::move(found, std::back_inserter(out));
}

}  // namespace roci::planner::utility_htn::checking
