// This file has the type hierarchy of a domain, and its objects by type.
#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/pddl/ast.hpp"
#include "core/words/nearest_word.hpp"

namespace roci::pddl {

/// Knows which types are above which; "object" is above every type. A type that is only named as a supertype
/// exists too. Cycles are tolerated here (their types are all above one another) and refused by check(), and so is a
/// type with more than kMostAbove types above it: with such a one, nothing is above any type but "object".
class TypeTree {
 public:
  static constexpr std::size_t kMostAbove = 200;

  explicit TypeTree(const Domain& domain);

  /// Names a type with more than kMostAbove types above it; it is empty if there is none.
  const std::string& too_deep() const { return too_deep_; }
  /// Offers the names of all types.
  void offer(words::NearestWord& word) const;

  bool knows(std::string_view type) const;
  /// Returns the type itself, all above it, and "object"; there are none for unknown types.
  std::set<std::string> ancestors(std::string_view type) const;
  /// Returns whether every `type` is an `ancestor`. Every known type is one of itself; unknown types are
  /// none.
  bool is_a(std::string_view type, std::string_view ancestor) const;
  /// Returns whether the type is one of the `ancestors`, or under one of them.
  bool is_any(std::string_view type, const std::vector<std::string>& ancestors) const;
  /// Returns whether a thing of one of the types `given` may stand where one of the types `wanted` is asked
  /// for, whichever of `given` it has.
  bool accepts(const std::vector<std::string>& wanted, const std::vector<std::string>& given) const;

 private:
  std::map<std::string, std::set<std::string, std::less<>>, std::less<>> ancestors_;
  std::string too_deep_;
};

/// Numbers the constants of the domain and the objects of the problem from 0, in the order of their first
/// declaration (constants first). An object that is declared again has the types of all its declarations. The
/// table holds no reference to domain or problem.
class ObjectTable {
 public:
  ObjectTable(const Domain& domain, const Problem& problem);

  std::size_t size() const { return objects_.size(); }
  const TypedName& operator[](std::size_t object) const { return objects_[object]; }
  /// Returns the number of the object, or -1 if there is none of this name.
  int find(std::string_view name) const;
  /// Returns whether the object has one of the types.
  bool has_type(std::size_t object, const std::vector<std::string>& types) const;
  /// Returns all objects of one of the types, ascending.
  std::vector<int> of_types(const std::vector<std::string>& types) const;
  const TypeTree& types() const { return types_; }

 private:
  TypeTree types_;
  std::vector<TypedName> objects_;
  std::map<std::string, int, std::less<>> numbers_;
  std::map<std::string, std::vector<int>, std::less<>> by_type_;  // subtypes included
};

}  // namespace roci::pddl
