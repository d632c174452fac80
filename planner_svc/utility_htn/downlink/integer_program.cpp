#include "planner_svc/utility_htn/downlink/integer_program.hpp"

#include <CbcModel.hpp>
#include <CglKnapsackCover.hpp>
#include <CglMixedIntegerRounding2.hpp>
#include <CoinPackedMatrix.hpp>
#include <OsiClpSolverInterface.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace roci::planner::utility_htn::downlink {
namespace {

// Where CBC stops early its own bound can be farther away.
double relaxed(OsiClpSolverInterface linear) {
  linear.initialSolve();
  return linear.isProvenOptimal() ? -linear.getObjValue() : std::numeric_limits<double>::infinity();
}

}  // namespace

Optimum maximize(const std::vector<Variable>& variables, const std::vector<Row>& rows, double above,
                 int most_nodes) {
  const int columns = static_cast<int>(variables.size());
  CoinPackedMatrix matrix(false, 0, 0);
  matrix.setDimensions(0, columns);
  std::vector<double> row_lower, row_upper, lower(variables.size(), 0), upper, cost;
  for (const Row& row : rows) {
    CoinPackedVector terms;
    for (const auto& [variable, weight] : row.terms) terms.insert(variable, weight);
    matrix.appendRow(terms);
    row_lower.push_back(row.lower);
    row_upper.push_back(row.upper);
  }
  for (const Variable& one : variables) {
    upper.push_back(one.upper);
    cost.push_back(-one.gain);
  }
  OsiClpSolverInterface linear;
  linear.messageHandler()->setLogLevel(0);
  linear.loadProblem(matrix, lower.data(), upper.data(), cost.data(), row_lower.data(), row_upper.data());
  for (int p = 0; p < columns; ++p)
    if (variables[static_cast<std::size_t>(p)].whole) linear.setInteger(p);
  CbcModel model(linear);
  model.setLogLevel(0);
  model.messageHandler()->setLogLevel(0);
  model.solver()->messageHandler()->setLogLevel(0);
  CglKnapsackCover covers;
  CglMixedIntegerRounding2 roundings;
  model.addCutGenerator(&covers, -1, "covers");
  model.addCutGenerator(&roundings, -1, "roundings");
  // Strong branching goes through hot starts, in which Clp 1.17 can end the process by an
  // assertion once cuts are there.
  model.setNumberStrong(0);
  model.setNumberBeforeTrust(0);
  model.setMaximumNodes(most_nodes);
  model.setIntegerTolerance(1e-7);
  model.setCutoff(-above - 0.5);
  model.branchAndBound();
  Optimum out{.ended = model.isProvenOptimal() || model.isProvenInfeasible(),
              .bound = -model.getBestPossibleObjValue()};
  if (!out.ended) out.bound = std::min(out.bound, relaxed(std::move(linear)));
  if (model.bestSolution() == nullptr) return out;
  double gain = 0;
  for (std::size_t p = 0; p < variables.size(); ++p) {
    const double value = model.bestSolution()[p];
    out.values.push_back(variables[p].whole ? std::round(value) : value);
    gain += variables[p].gain * out.values.back();
  }
  if (gain <= above) out.values.clear();
  return out;
}

}  // namespace roci::planner::utility_htn::downlink
