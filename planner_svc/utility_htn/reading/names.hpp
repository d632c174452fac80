// This file keeps the names of a network while it is read.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "planner_svc/utility_htn/model/network.hpp"
#include "planner_svc/utility_htn/reading/expression.hpp"
#include "planner_svc/utility_htn/reading/source.hpp"
#include "planner_svc/utility_htn/reading/unknown_names.hpp"

namespace roci::planner::utility_htn::reading {

/// Maps names of one kind to their numbers.
class Names {
 public:
  /// `kind` is the word for it in messages: "timeline". Names that are looked up in vain go to `unknown`, which
  /// outlives this.
  Names(std::string kind, UnknownNames& unknown) : kind_(std::move(kind)), unknown_(&unknown) {}

  /// Adds a name with the next number; fails where it stands already, with the place of the other.
  void add(const std::string& name, const Source& source);
  /// Notes that the definition behind this name is faulty: index() fails for it without a finding.
  void mark_faulty(const std::string& name) { faulty_.insert(name); }
  /// Notes that some names could not be added, for faults that were reported.
  void mark_incomplete() const { unknown_->hide(kind_); }
  /// Returns the number of a name; fails with the nearest known one, which is told once for each name.
  std::uint32_t index(std::string_view name, const Source& source) const;
  std::uint32_t index(const Source& source) const { return index(source.text(), source); }

 private:
  struct Known {
    std::uint32_t index;
    std::string place;
  };
  std::string kind_;
  UnknownNames* unknown_;
  std::map<std::string, Known, std::less<>> known_;
  std::set<std::string, std::less<>> faulty_;
};

/// Holds the names of all kinds, and reads what is made of them.
struct Vocabulary {
  explicit Vocabulary(UnknownNames& unknown)
      : parameters("parameter", unknown),
        timelines("timeline", unknown),
        tasks("task", unknown),
        ranks("rank", unknown),
        batches("batch", unknown) {}

  Names parameters, timelines, tasks, ranks, batches;
  const model::Network* network = nullptr;  ///< whose timelines are read already

  model::Amount amount(const Source& source) const;
  model::Amount amount_or(const Source& source, std::string_view key, double fallback) const;
  temporal::timelines::Constraint constraint(const Source& source, temporal::timelines::Phase phase) const;
  /// Reads a list of constraints, or one alone.
  std::vector<temporal::timelines::Constraint> constraints(const std::optional<Source>& source,
                                                           temporal::timelines::Phase phase) const;
  /// Returns the number of a state of a timeline.
  std::uint32_t state(const temporal::timelines::Definition& timeline, std::string_view name,
                      const Source& source) const;
};

}  // namespace roci::planner::utility_htn::reading
