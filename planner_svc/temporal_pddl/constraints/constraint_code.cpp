#include "planner_svc/temporal_pddl/constraints/constraint_code.hpp"

#include <stdexcept>

namespace roci::planner::temporal_pddl::constraints {

using temporal::Duration;
using temporal::no_bound;

namespace {

enum Kind : std::uint32_t { after = 0, separated = 1, exact = 2, between = 3 };

Kind kind_of(const StepConstraint& constraint, Duration epsilon) {
  if (constraint.upper == no_bound && constraint.lower == Duration{0}) return after;
  if (constraint.upper == no_bound && constraint.lower == epsilon) return separated;
  return constraint.lower == constraint.upper ? exact : between;
}

void put_varint(std::uint32_t value, std::vector<std::uint8_t>& code) {
  for (; value >= 0x80; value >>= 7) code.push_back(static_cast<std::uint8_t>(value | 0x80));
  code.push_back(static_cast<std::uint8_t>(value));
}

std::uint32_t get_varint(std::span<const std::uint8_t> code, std::size_t& at) {
  std::uint32_t value = 0;
  for (std::uint32_t shift = 0;; shift += 7) {
    const std::uint8_t byte = code[at++];
    value |= std::uint32_t{byte & 0x7fu} << shift;
    if (byte < 0x80) return value;
  }
}

}  // namespace

std::uint32_t BoundTable::intern(Duration bound) {
  const auto [place, added] = indices_.emplace(bound.count(), static_cast<std::uint32_t>(bounds_.size()));
  if (added) bounds_.push_back(bound);
  return place->second;
}

void encode(const StepConstraint& constraint, Duration epsilon, BoundTable& bounds,
            std::vector<std::uint8_t>& code) {
  if (constraint.from >= kMaxSteps || constraint.to >= kMaxSteps) {
    throw std::length_error("a plan has at most 32767 steps");
  }
  const Kind kind = kind_of(constraint, epsilon);
  const std::uint32_t head = constraint.to << 17 | constraint.from << 2 | kind;
  for (std::uint32_t shift = 0; shift < 32; shift += 8)
    code.push_back(static_cast<std::uint8_t>(head >> shift));
  if (kind == exact || kind == between) put_varint(bounds.intern(constraint.lower), code);
  if (kind == between) put_varint(bounds.intern(constraint.upper), code);
}

void decode(std::span<const std::uint8_t> code, Duration epsilon, const BoundTable& bounds,
            std::vector<StepConstraint>& constraints) {
  for (std::size_t at = 0; at < code.size();) {
    std::uint32_t head = 0;
    for (std::uint32_t shift = 0; shift < 32; shift += 8) head |= std::uint32_t{code[at++]} << shift;
    StepConstraint constraint{head >> 2 & 0x7fff, head >> 17, Duration{0}, no_bound};
    switch (head & 3) {
      case after:
        break;
      case separated:
        constraint.lower = epsilon;
        break;
      case exact:
        constraint.lower = constraint.upper = bounds[get_varint(code, at)];
        break;
      case between:
        constraint.lower = bounds[get_varint(code, at)];
        constraint.upper = bounds[get_varint(code, at)];
        break;
    }
    constraints.push_back(constraint);
  }
}

}  // namespace roci::planner::temporal_pddl::constraints
