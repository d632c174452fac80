#include "planner_svc/temporal_pddl/search/state_store.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>

namespace roci::planner::temporal_pddl::search {

using task::SnapId;
using task::StateView;
using task::Word;

StateStore::StateStore(std::size_t words_per_state)
    : words_(words_per_state),
      block_shift_(static_cast<unsigned>(std::bit_width(
                       kBlockBytes / std::max<std::size_t>(words_per_state * sizeof(Word), 1) | 1)) -
                   1) {}

NodeId StateStore::add(StateView state, NodeId parent, Transition transition,
                       std::span<const std::uint8_t> code) {
  if (code.size() > kBlockBytes - 1) throw std::length_error("too many constraints on one step");
  if (size_ / kHeadsPerBlock == heads_.size()) heads_.push_back(std::make_unique<Head[]>(kHeadsPerBlock));
  if (size_ >> block_shift_ == states_.size())
    states_.push_back(std::make_unique_for_overwrite<Word[]>(states_per_block() * words_));
  if (codes_.empty() || open_code_ + code.size() > kBlockBytes) {
    codes_.push_back(std::make_unique<std::uint8_t[]>(kBlockBytes));
    open_code_ = 0;
  }
  Head& head = heads_.back()[size_ % kHeadsPerBlock];
  head.parent = parent;
  head.operation = 2 * transition.snap.value + transition.compressed;
  head.code_block = static_cast<std::uint32_t>(codes_.size() - 1);
  head.code_offset = static_cast<std::uint16_t>(open_code_);
  head.code_length = static_cast<std::uint16_t>(code.size());
  std::ranges::copy(code, codes_.back().get() + open_code_);
  open_code_ += code.size();
  code_bytes_ += code.size();
  std::ranges::copy(state, place(size_));
  return NodeId(size_++);
}

void StateStore::clear() {
  size_ = code_bytes_ = open_code_ = 0;
  heads_.resize(std::min<std::size_t>(heads_.size(), 1));
  states_.resize(std::min<std::size_t>(states_.size(), 1));
  codes_.resize(std::min<std::size_t>(codes_.size(), 1));
}

StateView StateStore::state(NodeId node) const { return {place(node.index()), words_}; }

Transition StateStore::transition(NodeId node) const {
  const std::uint32_t operation = head(node).operation;
  return {SnapId(std::size_t{operation / 2}), operation % 2 == 1};
}

std::span<const std::uint8_t> StateStore::code(NodeId node) const {
  const Head& h = head(node);
  return {codes_[h.code_block].get() + h.code_offset, h.code_length};
}

std::size_t StateStore::bytes() const {
  return (heads_.size() + codes_.size()) * kBlockBytes +
         states_.size() * states_per_block() * words_ * sizeof(Word);
}

double StateStore::mean_bytes_per_state() const {
  if (size_ == 0) return 0;
  return static_cast<double>(sizeof(Head) + words_ * sizeof(Word)) +
         static_cast<double>(code_bytes_) / static_cast<double>(size_);
}

}  // namespace roci::planner::temporal_pddl::search
