#include "exec_svc/reactor/conjuncts.hpp"

namespace roci::exec::reactor {

using temporal::ConditionNode;
using temporal::ConditionOp;

std::vector<ConditionNode> conjuncts(const temporal::Condition& condition) {
  std::vector<ConditionNode> out;
  std::size_t expected = 1;
  for (std::size_t i = 0; i < condition.nodes.size() && expected > 0; ++i, --expected) {
    const ConditionNode& node = condition.nodes[i];
    if (node.op == ConditionOp::all_of) {
      expected += node.child_count;
    } else if (node.op == ConditionOp::any_of || node.op == ConditionOp::negation) {
      return out;
    } else {
      out.push_back(node);
    }
  }
  return out;
}

}  // namespace roci::exec::reactor
