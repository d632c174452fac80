// Beliefs are what the executive takes to be so: the newest observed values, and the PDDL facts and fluents
// that the mission's metadata derives from them.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/temporal/value.hpp"
#include "exec_svc/mission/mission_model.hpp"

namespace roci::exec::beliefs {

/// Holds what is so from observations alone, never from planned effects: the newest value of each timeline,
/// and the PDDL facts and fluents that the mission's metadata derives from them.
class Beliefs {
 public:
  explicit Beliefs(const mission::MissionModel& mission);

  void observe(const std::string& timeline, temporal::Value value);
  /// Sets the facts that hold for as long as the timeline has not been observed.
  void assume(const std::string& timeline, std::vector<std::string> facts);
  const temporal::Value* value(const std::string& timeline) const;
  /// Takes in what the running plan has made of a timeline that nobody observes, or what the executive has found:
  /// goals and problems see it, conditions over facts do not. Without a value the conclusion is withdrawn. A
  /// timeline that was observed stays as it is. Returns whether anything changed.
  bool conclude(const std::string& timeline, const std::optional<temporal::Value>& value);
  const std::map<std::string, temporal::Value>& concluded() const { return concluded_; }
  const std::map<std::string, temporal::Value>& values() const { return values_; }
  const std::map<std::string, std::vector<std::string>>& assumed() const { return assumed_; }

  /// Returns the facts that observed states stand for, as text "(at place-1)", in a stable order.
  std::set<std::string> component_facts() const;
  std::set<std::string> family_facts() const;  ///< includes the assumed ones

  /// Returns the value of a condition's timeline: an observed timeline by its name, a fluent "(battery)", or
  /// a fact "(at place-1)", which is false when its predicate is observable and nothing observed stands for
  /// it. Returns nothing for a fact that the metadata do not mention.
  std::optional<temporal::Value> lookup(const std::string& name) const;

  bool holds(const std::vector<std::string>& facts) const;

  /// Return the components that are in an active state now, and those never observed yet.
  std::vector<const mission::Component*> active() const;
  std::vector<const mission::Component*> unobserved() const;

 private:
  const mission::MissionModel* mission_;
  std::map<std::string, temporal::Value> values_, concluded_;
  std::map<std::string, std::vector<std::string>> assumed_;
  std::set<std::string> observable_predicates_;
};

}  // namespace roci::exec::beliefs
