// Random syntax trees: anything that could have come from a text, well formed or not by the checks.
#pragma once

#include <cstdint>
#include <random>

#include "core/pddl/ast.hpp"

namespace roci::pddl {

class RandomTree {
 public:
  explicit RandomTree(std::uint64_t seed) : random_(seed) {}

  Domain domain();
  Problem problem();

 private:
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }
  bool chance(int percent) { return below(100) < percent; }
  double number();
  std::string name() { return std::string(1, static_cast<char>('a' + below(6))) + std::to_string(below(4)); }
  std::vector<std::string> types();
  std::vector<TypedName> names(std::string prefix);
  Term term() { return {(chance(60) ? "?" : "") + name(), {}}; }
  Atom atom();
  Signature signature() { return {name(), names("?"), {}}; }
  Expression expression(int depth, bool in_effect);
  Condition condition(int depth);
  Condition timed_part();
  TimedCondition timed() { return {timed_part(), timed_part(), timed_part()}; }
  enum class Place { plain, durative, continuous };
  Effect effect(int depth, Place place);
  std::vector<Effect> effects(int depth, Place place, int least);
  Action action();
  DurativeAction durative_action();

  template <typename Make>
  auto several(int most, Make make) {
    std::vector<decltype(make())> all;
    for (int i = below(most + 1); i > 0; --i) all.push_back(make());
    return all;
  }

  std::mt19937_64 random_;
};

}  // namespace roci::pddl
