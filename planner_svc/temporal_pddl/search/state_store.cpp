#include "planner_svc/temporal_pddl/search/state_store.hpp"

#include <algorithm>
#include <stdexcept>

namespace roci::planner::temporal_pddl {

NodeId StateStore::add(StateView state, NodeId parent, Transition transition,
                       std::span<const std::uint8_t> code) {
  if (code.size() > kCodeBlockBytes - 1) throw std::length_error("too many constraints on one step");
  const std::size_t place = size_ % kNodesPerBlock;
  if (size_ / kNodesPerBlock == heads_.size()) {
    heads_.push_back(std::make_unique<Head[]>(kNodesPerBlock));
    states_.push_back(std::make_unique<Word[]>(kNodesPerBlock * words_));
  }
  if (codes_.empty() || open_code_ + code.size() > kCodeBlockBytes) {
    codes_.push_back(std::make_unique<std::uint8_t[]>(kCodeBlockBytes));
    open_code_ = 0;
  }
  Head& head = heads_.back()[place];
  head.parent = parent;
  head.operation = 2 * transition.snap.value + transition.compressed;
  head.code_block = static_cast<std::uint32_t>(codes_.size() - 1);
  head.code_offset = static_cast<std::uint16_t>(open_code_);
  head.code_length = static_cast<std::uint16_t>(code.size());
  std::ranges::copy(code, codes_.back().get() + open_code_);
  open_code_ += code.size();
  code_bytes_ += code.size();
  std::ranges::copy(state, states_.back().get() + place * words_);
  return NodeId(size_++);
}

void StateStore::clear() {
  size_ = code_bytes_ = open_code_ = 0;
  heads_.resize(std::min<std::size_t>(heads_.size(), 1));
  states_.resize(heads_.size());
  codes_.resize(std::min<std::size_t>(codes_.size(), 1));
}

StateView StateStore::state(NodeId node) const {
  return {states_[node.index() / kNodesPerBlock].get() + node.index() % kNodesPerBlock * words_, words_};
}

Transition StateStore::transition(NodeId node) const {
  const std::uint32_t operation = head(node).operation;
  return {SnapId(std::size_t{operation / 2}), operation % 2 == 1};
}

std::span<const std::uint8_t> StateStore::code(NodeId node) const {
  const Head& h = head(node);
  return {codes_[h.code_block].get() + h.code_offset, h.code_length};
}

std::size_t StateStore::bytes() const {
  return heads_.size() * kNodesPerBlock * (sizeof(Head) + words_ * sizeof(Word)) +
         codes_.size() * kCodeBlockBytes;
}

double StateStore::mean_bytes_per_state() const {
  if (size_ == 0) return 0;
  return static_cast<double>(sizeof(Head) + words_ * sizeof(Word)) +
         static_cast<double>(code_bytes_) / static_cast<double>(size_);
}

}  // namespace roci::planner::temporal_pddl
