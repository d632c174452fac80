// A component's settings are looked up in scenario and mission.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "core/mission/entry.hpp"

namespace roci::sim::setup {

/// Returns a number of the section that is no less than `least`, or the fallback where it is not given; throws
/// mission::FileError.
double number(const mission::Entry& section, std::string_view key, double fallback, double least = 0);

/// Holds what the files say of one component. A setting is looked up in the scenario's `world` first, then in
/// the component's entry of mission.yaml; keys that nobody asked for are errors, so that a misspelt one is no
/// silent default. All reading throws mission::FileError with place and remedy.
class Settings {
 public:
  /// `start` is the scenario's word on how this component begins; `conditions` are the scenario's settings
  /// for all components that have one of that name.
  Settings(mission::Entry mission, mission::Entry component, std::optional<mission::Entry> start,
           const std::map<std::string, mission::Entry>& conditions);

  double number(std::string_view key, double fallback, double least = 0);
  /// Returns a number from 0 to 1.
  double share(std::string_view key, double fallback);
  std::string text(std::string_view key, std::string fallback);
  /// Returns a setting of any form, or nothing if it is not given.
  std::optional<mission::Entry> find(std::string_view key);
  /// Returns how the scenario lets this component begin, or nothing if it says nothing of it.
  const std::optional<mission::Entry>& start();
  const mission::Entry& mission() const { return mission_; }
  const mission::Entry& component() const { return component_; }

  /// Throws for keys that nobody asked for; it is to be called when all has been read.
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

/// Throws mission::FileError for a name that cannot be part of a timeline's.
void check_name(const std::string& name, const mission::Entry& where);
/// Throws mission::FileError when a field's key is not among the known ones.
void refuse_unknown_keys(const mission::Entry&, const std::set<std::string, std::less<>>& known);

}  // namespace roci::sim::setup
