// The state store holds the states that the search has stored: packed state, parent, operator, and the few
// constraints of the last steps.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/task/ids.hpp"
#include "planner_svc/temporal_pddl/task/state_layout.hpp"

namespace roci::planner::temporal_pddl::search {

using NodeId = task::Id<struct NodeTag>;

/// Tells how a state was reached: by a snap action, and, if it is compressed, the end of the same action at
/// once.
struct Transition {
  task::SnapId snap;
  bool compressed = false;
};

/// Stores nodes in blocks, so that nothing is ever copied to a larger place and no memory is held in reserve
/// for more than one block.
class StateStore {
 public:
  explicit StateStore(std::size_t words_per_state);

  /// Adds a node; `code` holds the serialized constraints of the steps of the transition. The first node is
  /// the root: its parent is none.
  NodeId add(task::StateView state, NodeId parent, Transition transition, std::span<const std::uint8_t> code);

  /// Forgets all nodes; keeps the memory of one block of each kind.
  void clear();

  task::StateView state(NodeId node) const;
  NodeId parent(NodeId node) const { return head(node).parent; }
  Transition transition(NodeId node) const;
  std::span<const std::uint8_t> code(NodeId node) const;

  std::size_t size() const { return size_; }
  std::size_t bytes() const;            ///< allocated
  double mean_bytes_per_state() const;  ///< used

 private:
  struct Head {
    NodeId parent;
    std::uint32_t operation = 0;  // 2 · snap + (compressed ? 1 : 0)
    std::uint32_t code_block = 0;
    std::uint16_t code_offset = 0;
    std::uint16_t code_length = 0;
  };
  static constexpr std::size_t kBlockBytes = 65536;
  static constexpr std::size_t kHeadsPerBlock = kBlockBytes / sizeof(Head);

  const Head& head(NodeId node) const {
    return heads_[node.index() / kHeadsPerBlock][node.index() % kHeadsPerBlock];
  }
  std::size_t states_per_block() const { return std::size_t{1} << block_shift_; }
  task::Word* place(std::size_t index) const {
    return states_[index >> block_shift_].get() + (index & (states_per_block() - 1)) * words_;
  }

  std::size_t words_;
  unsigned block_shift_;  // a block of states has room for 2^this
  std::size_t size_ = 0;
  std::size_t code_bytes_ = 0;
  std::size_t open_code_ = 0;  // bytes used of the last block
  std::vector<std::unique_ptr<Head[]>> heads_;
  std::vector<std::unique_ptr<task::Word[]>> states_;
  std::vector<std::unique_ptr<std::uint8_t[]>> codes_;
};

}  // namespace roci::planner::temporal_pddl::search
