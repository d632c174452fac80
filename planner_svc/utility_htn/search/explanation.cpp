#include "planner_svc/utility_htn/search/explanation.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "core/temporal/value.hpp"
#include "planner_svc/utility_htn/search/chain_table.hpp"
#include "planner_svc/utility_htn/search/score.hpp"

namespace roci::planner::utility_htn::search {

using temporal::bounded, temporal::plus, temporal::RankVector, temporal::Time, temporal::to_text;
using temporal::timelines::Conflict, temporal::timelines::Interval, temporal::timelines::Kind,
    temporal::timelines::Timelines;

namespace {

std::string number(double value) { return temporal::to_text(temporal::Value{value}); }
std::string quoted(const std::string& name) { return "'" + name + "'"; }

// Takes back what was placed for the explanation.
class Trial {
 public:
  explicit Trial(Timelines& timelines) : timelines_(timelines), mark_(timelines.mark()) {}
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;
  ~Trial() { timelines_.undo(mark_); }

 private:
  Timelines& timelines_;
  std::size_t mark_;
};

class WhyNotAsked {
 public:
  WhyNotAsked(const Problem& problem, const Outcome& outcome, std::uint32_t chain)
      : problem_(problem),
        outcome_(outcome),
        table_(problem),
        chain_(chain),
        name_(quoted(table_.chain(chain).name)) {}

  Explanation run() {
    if (std::optional<Explanation> out = of_request()) return *out;
    const std::vector<std::uint32_t> planned = by_start(problem_.committed, outcome_.plan.placed);
    const assessor::Context context{problem_.network,       problem_.values,   problem_.chains,
                                    problem_.timelines_now, problem_.products, planned,
                                    problem_.closed};
    if (std::string objection = problem_.assessor.objection(chain_, context); !objection.empty())
      return {WhyNot::breaks_rule, name_ + " is not planned, since " + objection};
    const RankVector utility = table_.predicted(chain_, planned);
    if (refused(utility))
      return {WhyNot::breaks_rule,
              name_ + " is not planned, since its predicted utility is below nothing: " + to_text(utility)};
    if (rounded(outcome_.plan.cost + table_.cost(chain_)) >= problem_.budget) return too_dear();
    if (std::optional<Explanation> out = of_windows()) return *out;
    Trial trial(problem_.anchored);
    place_plan();
    std::optional<std::vector<Time>> starts =
        problem_.scheduler.schedule(table_.links(chain_), problem_.anchored);
    if (!starts) return no_valid_start();
    if (!gets_downlink({chain_, *starts}))
      return {WhyNot::no_downlink, name_ +
                                       " is not planned, since not everything that the plan would then "
                                       "generate gets its downlink"};
    if (!(utility > RankVector{}))
      return {WhyNot::worthless, name_ + " is not planned, since it would bring nothing and cost " +
                                     number(table_.cost(chain_))};
    return {WhyNot::not_tried,
            name_ + " would fit into the plan from " + to_text(starts->front()) + " on: " + of_search()};
  }

 private:
  std::optional<Explanation> of_request() const {
    const model::TaskIndex request = table_.chain(chain_).task;
    const std::string asked = quoted(problem_.network.tasks[request].id);
    for (const auto& chains : {problem_.committed, outcome_.plan.placed}) {
      for (const Placed& placed : chains) {
        if (placed.chain == chain_)
          return Explanation{WhyNot::planned,
                             name_ + " is planned from " + to_text(placed.starts.front()) + " on"};
        if (table_.chain(placed.chain).task == request)
          return Explanation{WhyNot::other_way, name_ + " is not planned, since " + asked + " is done as " +
                                                    quoted(table_.chain(placed.chain).name)};
      }
    }
    if (std::ranges::find(problem_.closed, request) == problem_.closed.end()) return std::nullopt;
    return Explanation{WhyNot::closed,
                       name_ + " is not planned, since nobody asks for " + asked + " any more"};
  }

  // Says why the search has not found what fits.
  std::string of_search() const {
    if (outcome_.complete) return "its batch was planned before what now makes it possible";
    if (outcome_.statistics.nodes == 0) return "no search was made since it was taken out";
    return "the search ended after " + number(double(outcome_.statistics.entries)) +
           " entries, before it was tried";
  }

  Explanation too_dear() const {
    const std::string unit = quoted(problem_.network.timelines.at(problem_.network.budget).name);
    return {WhyNot::too_dear, name_ + " is not planned, since it costs " + number(table_.cost(chain_)) +
                                  " of " + unit + " and the plan leaves less than " +
                                  number(rounded(problem_.budget - outcome_.plan.cost)) + " of " +
                                  number(problem_.budget)};
  }

  std::optional<Explanation> of_windows() {
    const std::span<const Link> links = table_.links(chain_);
    for (std::size_t index = 0; index < links.size(); ++index) {
      const Interval& starts = links[index].starts;
      if (starts.earliest <= starts.latest) continue;
      return Explanation{WhyNot::out_of_window, name_ + " is not planned, since " + task(index) +
                                                    " could not start before " + to_text(starts.earliest) +
                                                    " and would have to start by " + to_text(starts.latest)};
    }
    return std::nullopt;
  }

  // Says at which task the chain ends, and what stands in its way at its earliest.
  Explanation no_valid_start() {
    const std::span<const Link> links = table_.links(chain_);
    Timelines& timelines = problem_.anchored;
    Time after = -temporal::no_bound;
    for (std::size_t index = 0; index < links.size(); ++index) {
      const Link& link = links[index];
      Interval window = link.starts;
      if (index > 0) {
        window.earliest = std::max(window.earliest, plus(after, link.shortest_gap));
        window.latest = std::min(window.latest, plus(after, link.longest_gap));
      }
      const std::string begin =
          name_ + " is not planned, since " + task(index) + " has no valid start from " +
          to_text(window.earliest) +
          (bounded(window.latest) ? " to " + to_text(window.latest) : std::string(" on"));
      if (window.earliest > window.latest)
        return {WhyNot::no_valid_start, name_ + " is not planned, since " + task(index) +
                                            " would have to start by " + to_text(window.latest) +
                                            ", before what precedes it has ended"};
      const std::optional<Time> start = timelines.first_valid_start(link.footprint, window);
      if (!start) return {WhyNot::no_valid_start, begin + obstacle(link, window.earliest)};
      timelines.place(link.id, link.footprint, *start);
      after = plus(*start, link.footprint.duration);
    }
    return {WhyNot::no_valid_start,
            name_ + " is not planned, since its tasks have no common place within their gaps"};
  }

  std::string obstacle(const Link& link, Time start) {
    Timelines& timelines = problem_.anchored;
    constexpr Time kFar = temporal::no_bound;
    const std::vector<Conflict> before = timelines.conflicts(problem_.from, kFar);
    Trial trial(timelines);
    timelines.place(link.id, link.footprint, start);
    for (const Conflict& conflict : timelines.conflicts(problem_.from, kFar)) {
      if (std::ranges::find(before, conflict) != before.end()) continue;
      const auto& definition = timelines.definitions()[conflict.timeline];
      const double value = timelines.value(conflict.timeline, conflict.from);
      const std::string shown =
          definition.kind == Kind::state && value >= 0 && value < double(definition.states.size())
              ? quoted(definition.states[static_cast<std::size_t>(value)])
              : number(value);
      return ": at " + to_text(start) + " " + quoted(definition.name) + " would be " + shown + " at " +
             to_text(conflict.from) + ", which " +
             (!conflict.task              ? "is out of its range"
              : *conflict.task == link.id ? "breaks a constraint of it"
                                          : "breaks a constraint of another task");
    }
    return "";
  }

  void place_plan() {
    for (const Placed& placed : outcome_.plan.placed) {
      const std::span<const Link> links = table_.links(placed.chain);
      for (std::size_t link = 0; link < links.size(); ++link)
        problem_.anchored.place(links[link].id, links[link].footprint, placed.starts[link]);
    }
  }

  bool gets_downlink(const Placed& added) const {
    if (!problem_.downlink) return true;
    PlannedData data = table_.committed_data();
    for (const Placed& placed : outcome_.plan.placed) table_.add_data(placed, data);
    table_.add_data(added, data);
    return problem_.downlink(data);
  }

  std::string task(std::size_t link) const {
    return quoted(problem_.network.tasks[table_.chain(chain_).links[link].task].id);
  }

  const Problem& problem_;
  const Outcome& outcome_;
  ChainTable table_;
  std::uint32_t chain_;
  std::string name_;
};

}  // namespace

Explanation why_not(const Problem& problem, const Outcome& outcome, std::uint32_t chain) {
  return WhyNotAsked(problem, outcome, chain).run();
}

}  // namespace roci::planner::utility_htn::search
