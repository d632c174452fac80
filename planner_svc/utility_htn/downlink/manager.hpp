// The Downlink Manager (MEXEC, appendix A, R110, R111, R125–R127, Z9, Z17, Z18): which data goes to Earth with which
// downlink, and whether there is room for the data of one more task.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/temporal/duration.hpp"
#include "planner_svc/utility_htn/model/data_product.hpp"

namespace roci::planner::utility_htn::downlink {

/// Names a product, which only a window that starts when it is created or later can take. Differences of
/// scores below kScoreStep do not count.
using Product = model::DataProduct;

/// Describes a downlink opportunity: Earth is in view, and the uplink that belongs to it is already taken
/// off.
struct Window {
  std::string id;
  temporal::Time start{0};
  temporal::Time latest_end{0};  ///< Earth sets
  double bytes_per_s = 0;
  double power_w = 0;  ///< of the transmission
  double energy_limit_j = std::numeric_limits<double>::infinity();
  std::uint32_t sol = 0;
  /// Bounds one transmission until the temperature limit.
  double heat_limit_s = std::numeric_limits<double>::infinity();
};

/// Bounds what all downlinks of a sol take together; a sol that is not there has no limit.
struct Limits {
  std::map<std::uint32_t, double> sol_energy_j{};
};

/// Sets the smallest difference of a score that counts: utilities become integers of this step (equation 6).
inline constexpr double kScoreStep = 1e-6;

/// Says why a product is not sent.
enum class Reason {
  no_window,            ///< none starts after it is created
  larger_than_windows,  ///< it fits into no window after its creation, even alone
  no_room,              ///< higher tiers and utilities fill the windows
  nothing_left_over,    ///< Residual: what the others leave is too small
};

/// Names a product that is not sent, and why, in plain words.
struct LeftOut {
  std::size_t product = 0;
  Reason reason = Reason::no_room;
  std::string why{};
};

/// Names a Critical or Decisional product that its window cannot take, so that it goes with a later one.
struct Late {
  std::size_t product = 0;
  std::uint32_t due = 0;  ///< the window that it should go with
  std::string why;
};

/// Says what one window carries.
struct Load {
  std::uint64_t bytes = 0;
  temporal::Duration duration{0};
  double energy_j = 0;
};

/// Says how much of an answer is proven, for Mandatory and Residual products; the others have no choice.
struct Proof {
  enum class By {
    certificate,  ///< a greedy assignment meets a bound
    solver,       ///< CBC ended its search
    bound,        ///< neither: the best assignment that was found, `gap` away from a bound
  };
  By by = By::certificate;
  double gap = 0;             ///< of the summed scores at `rank`: (bound - value) / bound
  std::uint32_t rank = 0;     ///< the highest rank that is not proven; of no meaning with gap 0
  bool earliest_too = false;  ///< that no assignment of the same utility is earlier is proven, too
};

/// Says which product goes with which window, and how much of that is proven.
struct Assignment {
  std::vector<std::optional<std::uint32_t>> window;  ///< by product
  std::vector<LeftOut> left_out;                     ///< by product
  std::vector<Late> late;                            ///< by product
  std::vector<Load> loads;                           ///< by window
  Proof proof{};
};

/// Bounds the work, never the time, so that the same question has the same answer everywhere.
struct Effort {
  int most_nodes = 2'000;  ///< of CBC's search, for each rank; fewer for questions of more than 500 variables
  std::size_t most_variables = 2'000;  ///< pairs of product and window; above, CBC decides on products alone
  int most_nodes_of_items = 200;       ///< of that search, for each rank
  std::size_t most_items = 2'000;      ///< products of a tier; above, CBC is not asked at all
};

/// Counts what answered the questions so far: of admits() whole questions, of assign()
/// one each for the Mandatory and the Residual.
struct Counts {
  std::uint64_t certificate = 0;  ///< the greedy assignment or a bound
  std::uint64_t solver = 0;
  std::uint64_t open = 0;  ///< the effort was spent: a gap stays, or "no" was answered to be safe
};

/// Assigns products to downlinks. The same question always has the same answer.
class Manager {
 public:
  explicit Manager(Effort effort = {}) : effort_(effort) {}

  /// Returns the best assignment: Critical products go with the first window after their creation, Decisional with what
  /// that one has left (both outside the solver; the higher utility first); Mandatory ones so that their summed utility
  /// is greatest, by rank; among those, that most products are sent, and then that the windows' numbers add up to least
  /// ("earliest"). Residual ones get only what is left over, by the same rules, and change nothing of the others.
  /// Throws std::invalid_argument for a negative or infinite score, two products of one id, and windows out of order of
  /// their starts or with an impossible rate, power or limit.
  Assignment assign(std::span<const Product> products, std::span<const Window> windows, const Limits& limits);

  /// Returns whether the products of one more task have room, each in time, beside all that is sent without them; a
  /// Residual candidate is no reason to refuse as long as others are among the candidates. Throws as assign() does.
  bool admits(std::span<const Product> products, std::span<const Window> windows, const Limits& limits,
              std::span<const Product> candidates);

  const Counts& counts() const { return counts_; }

 private:
  Effort effort_;
  Counts counts_{};
};

}  // namespace roci::planner::utility_htn::downlink
