#pragma once
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "core/mission/entry.hpp"

namespace roci::sim::setup {

/// What the files say of one component. A setting is looked up in the scenario's `world` first, then in the
/// component's entry of mission.yaml; keys that nobody asked for are errors, so that a misspelt one is no
/// silent default. All reading throws mission::FileError with place and remedy.
class Settings {
 public:
  /// `start`: the scenario's word on how this component begins. `conditions`: the scenario's settings for all
  /// components that have one of that name.
  Settings(mission::Entry mission, mission::Entry component, std::optional<mission::Entry> start,
           const std::map<std::string, mission::Entry>& conditions);

  double number(std::string_view key, double fallback, double least = 0);
  std::string text(std::string_view key, std::string fallback);
  /// Of any form; empty: it is not given.
  std::optional<mission::Entry> find(std::string_view key);
  /// Empty: the scenario says nothing of this component.
  const std::optional<mission::Entry>& start();
  const mission::Entry& mission() const { return mission_; }
  const mission::Entry& component() const { return component_; }

  /// To be called when all has been read.
  void refuse_unknown() const;
  const std::set<std::string, std::less<>>& known() const { return known_; }

 private:
  mission::Entry mission_;
  mission::Entry component_;
  std::optional<mission::Entry> start_;
  const std::map<std::string, mission::Entry>& conditions_;
  std::set<std::string, std::less<>> known_{"name", "type"};
  bool start_read_ = false;
};

/// Fails when a field's key is not among the known ones.
void refuse_unknown_keys(const mission::Entry&, const std::set<std::string, std::less<>>& known);

}  // namespace roci::sim::setup
