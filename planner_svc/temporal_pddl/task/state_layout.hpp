// A state lies in memory as finite-domain variables, bit-packed into 64-bit words, with the numbers behind
// them (R9).
//
// A variable is a set of facts of which at most one holds at a time; with its value 0, none of them does. A
// fact that is the negation of another needs no bits of its own.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/task/ids.hpp"
#include "planner_svc/temporal_pddl/task/numbers.hpp"

namespace roci::planner::temporal_pddl::task {

using StateView = std::span<const Word>;
using MutableState = std::span<Word>;

/// Reads and writes the facts and numbers of packed states.
class StateLayout {
 public:
  struct Variable {
    std::vector<FactId> facts;  ///< the value v ≥ 1 stands for facts[v − 1]
    std::uint32_t word = 0;
    std::uint32_t shift = 0;
    Word mask = 0;  ///< the bits of the variable before they are shifted
  };

  StateLayout() = default;
  /// Lays out states: every fact stands in exactly one of the variables, except those with negation_of[fact]
  /// set, which are the negations of others.
  StateLayout(std::vector<std::vector<FactId>> variables, const IdVector<FactId, FactId>& negation_of,
              std::size_t numbers);

  /// Returns the words of one state, its numbers included.
  std::size_t words() const { return number_offset_ + numbers_; }
  std::size_t packed_bits() const { return packed_bits_; }  ///< Σ ⌈log2(facts + 1)⌉
  std::span<const Variable> variables() const { return variables_; }
  std::size_t facts() const { return places_.size(); }
  std::size_t bytes() const { return variables_.capacity() * sizeof(Variable) + places_.bytes(); }
  std::size_t numbers() const { return numbers_; }

  bool holds(StateView state, FactId fact) const {
    const Place& place = places_[fact];
    return (((state[place.word] >> place.shift) & place.mask) == place.value) != place.negated;
  }
  std::uint32_t value(StateView state, std::size_t variable) const {
    const Variable& v = variables_[variable];
    return static_cast<std::uint32_t>((state[v.word] >> v.shift) & v.mask);
  }
  /// add() makes the fact true, and with it false what shares its variable. Negations follow by themselves:
  /// to add or remove one does nothing.
  void add(MutableState state, FactId fact) const;
  void remove(MutableState state, FactId fact) const;

  /// Returns the variable that a fact, or the one that it negates, is a value of.
  std::size_t variable_of(FactId fact) const { return places_[fact].variable; }
  /// Returns which of its values that is.
  std::uint32_t value_of(FactId fact) const { return places_[fact].value; }
  bool is_negation(FactId fact) const { return places_[fact].negated; }
  std::span<const FactId> negations() const { return negations_; }

  NumbersView numbers(StateView state) const { return NumbersView(state.subspan(number_offset_)); }
  void set_number(MutableState state, NumberId number, double value) const {
    state[number_offset_ + number.index()] = std::bit_cast<Word>(value);
  }

 private:
  struct Place {
    std::uint32_t word = 0;
    std::uint8_t shift = 0;
    bool negated = false;
    std::uint32_t value = 0;
    std::uint32_t variable = 0;
    Word mask = 0;
  };

  std::vector<Variable> variables_;
  IdVector<FactId, Place> places_;
  std::vector<FactId> negations_;
  std::size_t number_offset_ = 0;
  std::size_t numbers_ = 0;
  std::size_t packed_bits_ = 0;
};

}  // namespace roci::planner::temporal_pddl::task
