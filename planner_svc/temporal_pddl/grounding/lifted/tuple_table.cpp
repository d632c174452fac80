#include "planner_svc/temporal_pddl/grounding/lifted/tuple_table.hpp"

#include <algorithm>

namespace roci::planner::temporal_pddl::grounding::lifted {

using task::ObjectId;

namespace {

std::uint64_t hash(std::uint32_t symbol, std::span<const ObjectId> objects) {
  std::uint64_t h = symbol * 0x9e3779b97f4a7c15ull;
  for (const ObjectId object : objects) {
    h = (h ^ object.value) * 0xff51afd7ed558ccdull;
    h ^= h >> 32;
  }
  return h;
}

}  // namespace

std::size_t TupleTable::slot_of(std::uint32_t symbol, std::span<const ObjectId> objects) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash(symbol, objects) & mask;
  while (slots_[slot] != kFree) {
    const std::uint32_t tuple = slots_[slot];
    if (symbols_[tuple] == symbol && std::ranges::equal(objects_[std::size_t{tuple}], objects)) break;
    slot = (slot + 1) & mask;
  }
  return slot;
}

void TupleTable::grow() {
  slots_.assign(slots_.size() * 2, kFree);
  for (std::uint32_t tuple = 0; tuple < symbols_.size(); ++tuple)
    slots_[slot_of(symbol(tuple), objects(tuple))] = tuple;
}

std::uint32_t TupleTable::intern(std::uint32_t symbol, std::span<const ObjectId> objects) {
  std::size_t slot = slot_of(symbol, objects);
  if (slots_[slot] != kFree) return slots_[slot];
  if (2 * (symbols_.size() + 1) > slots_.size()) {
    grow();
    slot = slot_of(symbol, objects);
  }
  slots_[slot] = static_cast<std::uint32_t>(symbols_.size());
  symbols_.push_back(symbol);
  objects_.push_back(objects);
  return slots_[slot];
}

std::optional<std::uint32_t> TupleTable::find(std::uint32_t symbol, std::span<const ObjectId> objects) const {
  const std::uint32_t tuple = slots_[slot_of(symbol, objects)];
  return tuple == kFree ? std::nullopt : std::optional(tuple);
}

std::size_t TupleTable::bytes() const {
  return symbols_.capacity() * sizeof(std::uint32_t) + objects_.bytes() +
         slots_.capacity() * sizeof(std::uint32_t);
}

}  // namespace roci::planner::temporal_pddl::grounding::lifted
