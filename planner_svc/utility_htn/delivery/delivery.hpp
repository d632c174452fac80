// The delivery joins the search, the products that exist and the Downlink Manager (MEXEC, section IV.C.2 and
// appendix A; R110, R111, R115, R127).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "planner_svc/utility_htn/assessor/assessor.hpp"
#include "planner_svc/utility_htn/delivery/rules.hpp"
#include "planner_svc/utility_htn/downlink/manager.hpp"
#include "planner_svc/utility_htn/search/search.hpp"

namespace roci::planner::utility_htn::delivery {

/// Says what has become of data, in the order of ProductFate in idl/command.idl.
/// Only what is stored waits for a downlink.
enum class Fate { stored, sent, received, discarded, left_behind, lost };

/// Describes data that were generated on board.
struct Existing {
  model::DataProduct data;
  model::TaskIndex task = 0;     ///< the primitive task that generated it
  model::TaskIndex request = 0;  ///< the requested task of which that was part
  Fate fate = Fate::stored;
  temporal::RankVector predicted{};  ///< by the network; none: it does not know this product
  friend bool operator==(const Existing&, const Existing&) = default;
};

/// Describes what one planned downlink carries.
struct Downlink {
  model::TaskIndex task = 0;
  temporal::Time start{0};
  temporal::Time end{0};
  std::uint64_t bytes = 0;
  temporal::Duration takes{0};  ///< the transmission alone, as much of the window as is needed
  double energy_j = 0;          ///< of the transmission
  /// Stand in the order in which they go: by tier, then by utility, the greatest first, then the older one.
  std::vector<std::string> products{};
  temporal::timelines::TaskId id = 0;  ///< PlannedDownlink::id
  friend bool operator==(const Downlink&, const Downlink&) = default;
};

/// Names a product that is not sent, or later than its tier asks for.
struct Unsent {
  std::string product;
  std::string why;
  friend bool operator==(const Unsent&, const Unsent&) = default;
};

/// Describes data that a schedule mentions.
struct Scheduled {
  bool exists = false;
  std::uint64_t bytes = 0;
  model::Tier tier = model::Tier::mandatory;
  friend bool operator==(const Scheduled&, const Scheduled&) = default;
};

/// Says which data go with which downlink, and which are left out or late.
struct Schedule {
  std::map<std::string, Scheduled> products{};  ///< all, by id
  std::vector<Downlink> downlinks{};            ///< by start
  std::vector<Unsent> left_out{};
  std::vector<Unsent> late{};
  friend bool operator==(const Schedule&, const Schedule&) = default;
};

/// Counts what has answered the search's questions.
struct Counts {
  std::uint64_t nothing_to_send = 0;
  std::uint64_t limits = 0;     ///< refused by a limit of energy, before anything was assigned
  std::uint64_t first_fit = 0;  ///< one assignment was found at once
  downlink::Counts manager{};   ///< the others
};

/// Knows what is on board and what planned downlinks can carry.
/// The same history and question always give the same answer.
///
/// A downlink lasts as long as the network's parameter says, whatever it carries: so it stands on the timelines with
/// its whole energy, and the limits of a downlink and of a sol (R111) hold for that. It can carry rate × duration. What
/// of it is needed, the schedule tells.
class Delivery {
 public:
  /// The network outlives this.
  explicit Delivery(const model::Network& network) : network_(network), rules_(network) {}

  /// Takes in that another network replaces `before`. Data of tasks that it lacks still wait.
  void replaced(const model::Network& before);
  /// Takes in a product's newest state; returns whether anything is new. Its request stays what it was once nobody
  /// knows it any more, since the plan forgets chains that have ended. A score that is negative or not finite counts as
  /// 0, one above a million as a million. `now` is when its owner said so: a downlink that runs has been sending the
  /// next product since the last one was sent.
  bool hear(Existing product, temporal::Time now = temporal::Time{0});
  /// Takes in what downlinks were told to send, in order: a running one is sending the first product that is still on
  /// board. Before anything was told, another process may have told it in the same order: then a running downlink is
  /// sending the first product for which a downlink of its length has room.
  void told(std::map<temporal::timelines::TaskId, std::vector<std::string>> products) {
    has_told_ = true;
    told_ = std::move(products);
  }
  /// Takes in what an executed downlink took, for the limit of its sol. `activity` is unique;
  /// what is told again counts once.
  void executed(temporal::timelines::TaskId activity, model::TaskIndex task, temporal::Time start,
                temporal::Time end, const model::Values& values);
  /// Returns the joules that executed downlinks took in the sol of `now` and later, by sol, beside those of activities
  /// for which `told` holds; nothing where sols have no limit.
  std::map<std::uint32_t, double> spent(const std::function<bool(temporal::timelines::TaskId)>& told,
                                        temporal::Time now, const model::Values& values) const;
  /// Takes in what spent() has told another process, once.
  void resume(const std::map<std::uint32_t, double>& spent);

  /// Gives the search the existing products, and the question that it asks of each candidate.
  /// `this` outlives the problem.
  void join(search::Problem& problem, temporal::Time now);
  /// Returns all data that were generated, whatever became of them, with what they are worth (R115).
  std::span<const assessor::ExistingProduct> products() const { return products_; }
  /// Returns the same as they were heard, by id.
  std::span<const Existing> existing() const { return existing_; }
  /// Returns whether the network names a rate: otherwise all data get home without a schedule.
  bool limited() const { return rules_.has_rate(); }
  /// Returns how long the data take that wait on board, of all that these requests have generated but what is residual,
  /// as far as they go with one downlink of at most this length: a product is not split. Products that do not go
  /// together are taken in the order in which they are sent. A downlink that is to bring them home lasts that long at
  /// least (R127).
  temporal::Duration transmission(const std::set<model::TaskIndex>& requests, const model::Values& values,
                                  temporal::Duration longest = temporal::no_bound) const;
  /// Returns the requests whose data wait on board, without residual ones.
  std::set<model::TaskIndex> requests_with_data() const;
  /// Returns how long a downlink that starts then may last by the limit of one downlink and,
  /// beside all others, by that of its sol.
  temporal::Duration longest(model::TaskIndex task, temporal::Time start,
                             std::span<const search::PlannedDownlink> others,
                             const model::Values& values) const;
  /// Returns whether a downlink that starts then may last so long by the limit of one downlink and, beside all
  /// others, by that of its sol.
  bool permits(model::TaskIndex task, temporal::Time start, temporal::Duration length,
               std::span<const search::PlannedDownlink> others, const model::Values& values) const;
  /// Returns whether a downlink may last so long where nothing else is sent: otherwise no sol has energy for it.
  bool permits_alone(model::TaskIndex task, temporal::Duration length, const model::Values& values) const;
  /// Returns how long a downlink may last by its limit and that of a sol in which nothing else is sent.
  temporal::Duration longest_alone(model::TaskIndex task, const model::Values& values) const;
  /// Returns the sols of which these downlinks and what was executed take more than the limit.
  std::set<std::uint32_t> overdrawn_sols(std::span<const search::PlannedDownlink> downlinks,
                                         const model::Values& values) const;
  std::uint32_t sol_of(temporal::Time time, const model::Values& values) const {
    return rules_.sol_of(time, values);
  }
  /// Returns when the sol in which this time lies ends.
  temporal::Time end_of_sol(temporal::Time time, const model::Values& values) const {
    return rules_.end_of_sol(sol_of(time, values), values);
  }
  /// Returns what was received on Earth with its last byte: executed utility, of which nothing is predicted.
  temporal::RankVector received() const;

  /// Returns whether the data that are not standing yet have room, each in time, beside all that stands.
  bool admits(const search::PlannedData& planned, const model::Values& values, temporal::Time now);
  /// Returns when the first sol ends whose limit is exceeded by downlinks that are not committed; none where it is no
  /// limit of a sol that they exceed.
  std::optional<temporal::Time> next_sol(const search::PlannedData& planned,
                                         const model::Values& values) const;
  /// Returns which data go with which downlink.
  Schedule schedule(const search::PlannedData& planned, const model::Values& values,
                    temporal::Time now) const;

  const Counts& counts() const { return counts_; }

 private:
  struct Question;
  struct Spent {
    std::uint32_t sol = 0;
    double joules = 0;
  };
  Question question(const search::PlannedData& planned, const model::Values& values,
                    temporal::Time now) const;
  void keep_what_is_sent(Question& question, temporal::Time now) const;
  std::vector<std::string> sent_by(const search::PlannedDownlink& downlink, const Question& question,
                                   const downlink::Window& left) const;
  double spent_in(std::uint32_t sol) const;
  double limit_alone_j(const model::Values& values) const;
  double left_for(temporal::Time start, std::span<const search::PlannedDownlink> others,
                  const model::Values& values) const;
  temporal::Duration lasting(model::TaskIndex task, double joules, const model::Values& values) const;
  bool keeps_limits(const search::PlannedData& planned, const model::Values& values) const;

  const model::Network& network_;
  Rules rules_;
  std::vector<Existing> existing_;                   // by data.id
  std::vector<assessor::ExistingProduct> products_;  // the same
  std::map<std::uint32_t, double> spent_;            // joules, by sol
  std::map<temporal::timelines::TaskId, Spent> executed_;
  Counts counts_;
  temporal::Time last_sent_{0};  // when the newest product was sent
  bool has_told_ = false;
  std::map<temporal::timelines::TaskId, std::vector<std::string>> told_;
};

}  // namespace roci::planner::utility_htn::delivery
