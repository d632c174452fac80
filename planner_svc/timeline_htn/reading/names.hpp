// This file keeps the names of a model while it is read.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/mission/entry.hpp"
#include "planner_svc/timeline_htn/model/model.hpp"

namespace roci::planner::timeline_htn::reading {

/// Returns "known: a, b" for whom no near word can be named; "declare it" where there are none or many.
std::string known_or_declare(const std::vector<std::string>& known);

/// Maps names of one kind to their numbers.
class Names {
 public:
  /// `kind` is the word for it in messages: "component".
  explicit Names(std::string kind) : kind_(std::move(kind)) {}

  /// Adds a name with the next number; fails where it is none or stands already, with the place of the other.
  void add(const std::string& name, const mission::Entry& place);
  std::optional<model::Index> find(std::string_view name) const;
  /// Returns the number of a name; fails with the nearest known one.
  model::Index index(std::string_view name, const mission::Entry& place) const;
  std::size_t size() const { return known_.size(); }

 private:
  struct Known {
    model::Index index;
    std::string place;
  };
  std::string kind_;
  std::map<std::string, Known, std::less<>> known_;
};

}  // namespace roci::planner::timeline_htn::reading
