// A source is an entry of a network file together with the words that stand for others in it: "{site}" in every
// text and key.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/mission/entry.hpp"
#include "core/temporal/duration.hpp"

namespace roci::planner::utility_htn::reading {

/// Holds what each word in braces stands for.
using Bindings = std::map<std::string, std::string, std::less<>>;

/// Reads a mission::Entry with bindings; faults are those of Entry, with their places.
class Source {
 public:
  explicit Source(mission::Entry entry, std::shared_ptr<const Bindings> bindings = nullptr);

  /// Returns the same entry, where these bindings hold besides.
  Source with(const Bindings& more) const;

  std::optional<Source> find(std::string_view key) const;
  Source at(std::string_view key) const;
  std::vector<Source> items() const;
  /// Returns an item alone, or the items of a list.
  std::vector<Source> one_or_more() const;
  /// Returns the fields in the order of the file, keys as they are written.
  std::vector<std::pair<std::string, Source>> raw_fields() const;
  /// Returns them with the words in the keys replaced.
  std::vector<std::pair<std::string, Source>> fields() const;
  const mission::Entry& entry() const { return entry_; }

  std::string text() const;
  std::string text_or(std::string_view key, std::string fallback) const;
  /// Returns a number, which may be written as a sum of products: "3600 + {n} * 151200".
  double number() const;
  /// Returns a number, or `none` for the word "none".
  double number_or_none(double none) const;
  double number_or(std::string_view key, double fallback) const;
  /// Returns a whole number within bounds.
  std::uint64_t count(std::uint64_t most) const;
  bool truth() const;
  bool truth_or(std::string_view key, bool fallback) const;
  /// Returns a time that is written in seconds; "none" is no_bound.
  temporal::Duration seconds() const;

  [[noreturn]] void fail(const std::string& what) const { entry_.fail(what); }
  /// Puts what the words in braces stand for into a text; "{{" and "}}" are single braces.
  std::string filled(const std::string& text) const;

 private:
  mission::Entry entry_;
  std::shared_ptr<const Bindings> bindings_;
};

}  // namespace roci::planner::utility_htn::reading
