// The watch raises goals from what is observed of timelines: a module that fails is to be replaced (Stellar, sections
// 3.2 and 5.2; R55). Which timelines, states and goals these are is mission data.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace roci::science::watch {

/// Timelines whose newest state the watch remembers; of those beyond, nothing is raised.
inline constexpr std::size_t kTimelines = 10'000;

/// Says how much a goal matters, in the order of GoalClass in idl/goal.idl.
enum class GoalClass { hard, optional, opportunistic };

/// Says what is to be asked for when a timeline enters a state.
struct Rule {
  std::string timeline;                          ///< a name, or a pattern with one *
  std::string state;                             ///< the state's name
  std::string goal_kind;                         ///< a kind of mission.yaml
  std::map<std::string, std::string> arguments;  ///< of the goal; * in a value is what stood for the *
  GoalClass importance = GoalClass::opportunistic;
  double utility = 1;
};

/// Describes a goal that nobody asked for.
struct Wish {
  std::string id;
  std::string goal_kind;
  std::map<std::string, std::string> arguments;
  GoalClass importance = GoalClass::opportunistic;
  double utility = 1;
  std::string timeline;  ///< whose state was the reason
  std::string state;
};

/// What stands for the * of a pattern in a name, empty where the pattern has none; nothing if they do not match.
std::optional<std::string> match(const std::string& pattern, const std::string& name);

/// Answers by its rules and the observations so far alone. The first wish of a kind for an object has the id
/// watch-KIND-OBJECT, the next ones -2, -3, … after it, so that a watch that begins anew and sees the states of before
/// asks for the same goals under the same ids.
class Watch {
 public:
  explicit Watch(std::vector<Rule> rules) : rules_(std::move(rules)) {}

  /// Takes the newest state of a timeline (empty: what it holds is no state). Returns a wish for each rule whose state
  /// it has entered: it was in another one before, or was never observed.
  std::vector<Wish> observe(const std::string& timeline, const std::string& state);
  /// Whether kTimelines are remembered.
  bool full() const { return states_.size() >= kTimelines; }

 private:
  Wish wish_of(const Rule& rule, const std::string& object, const std::string& timeline);

  std::vector<Rule> rules_;
  std::map<std::string, std::string> states_;  // by timeline
  std::map<std::string, int> raised_;          // by the first id
};

}  // namespace roci::science::watch
