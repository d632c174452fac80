#include "arm_svc/path_search.hpp"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/datastructures/NearestNeighborsLinear.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include "arm_svc/sampling.hpp"

namespace roci::arm {
namespace {

namespace ob = ompl::base;
using kinematics::Arm;
using kinematics::JointVector;
using Space = ob::RealVectorStateSpace;

// A state's coordinates are q / speed limit: distances are seconds at full speed.
JointVector scale_of(const Arm& arm) {
  JointVector scale(static_cast<Eigen::Index>(arm.joints.size()));
  for (Eigen::Index i = 0; i < scale.size(); ++i) {
    scale[i] = arm.joints[static_cast<std::size_t>(i)].limits.velocity;
  }
  return scale;
}

JointVector joints_of(const ob::State* state, const JointVector& scale) {
  const double* values = state->as<Space::StateType>()->values;
  return Eigen::Map<const JointVector>(values, scale.size()).cwiseProduct(scale);
}

void store(const JointVector& q, const JointVector& scale, ob::State* state) {
  double* values = state->as<Space::StateType>()->values;
  Eigen::Map<JointVector>(values, scale.size()) = q.cwiseQuotient(scale);
}

// RRTConnect asks for nothing but uniform samples; the other two forms complete the interface.
class SeededSampler : public ob::StateSampler {
 public:
  SeededSampler(const ob::StateSpace* space, const Arm& arm, std::uint64_t seed)
      : ob::StateSampler(space), arm_(arm), scale_(scale_of(arm)), random_(seed) {}

  void sampleUniform(ob::State* state) override { store(sample_coordinates(arm_, random_), scale_, state); }

  void sampleUniformNear(ob::State* state, const ob::State* near, double distance) override {
    double* values = state->as<Space::StateType>()->values;
    for (Eigen::Index i = 0; i < scale_.size(); ++i) {
      values[i] = near->as<Space::StateType>()->values[i] + distance * (2.0 * unit_sample(random_) - 1.0);
    }
    space_->enforceBounds(state);
  }

  void sampleGaussian(ob::State* state, const ob::State* mean, double deviation) override {
    double* values = state->as<Space::StateType>()->values;
    for (Eigen::Index i = 0; i < scale_.size(); ++i) {
      const double sample = std::normal_distribution<double>(0.0, deviation)(random_);
      values[i] = mean->as<Space::StateType>()->values[i] + sample;
    }
    space_->enforceBounds(state);
  }

 private:
  const Arm& arm_;
  JointVector scale_;
  std::mt19937_64 random_;
};

class LineValidator : public ob::MotionValidator {
 public:
  LineValidator(const ob::SpaceInformationPtr& si, const CollisionChecker& checker, JointVector scale)
      : ob::MotionValidator(si), checker_(checker), scale_(std::move(scale)) {}

  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    return checker_.line_is_free(joints_of(from, scale_), joints_of(to, scale_));
  }

  // The farthest valid point is not worth finding here: RRTConnect grows by whole steps.
  bool checkMotion(const ob::State* from, const ob::State* to,
                   std::pair<ob::State*, double>& last) const override {
    if (checkMotion(from, to)) return true;
    last.second = 0.0;
    if (last.first != nullptr) si_->copyState(last.first, from);
    return false;
  }

 private:
  const CollisionChecker& checker_;
  JointVector scale_;
};

std::shared_ptr<Space> make_space(const Arm& arm, std::uint64_t seed) {
  const JointVector scale = scale_of(arm);
  auto space = std::make_shared<Space>(static_cast<unsigned>(scale.size()));
  ob::RealVectorBounds bounds(static_cast<unsigned>(scale.size()));
  for (Eigen::Index i = 0; i < scale.size(); ++i) {
    const auto& limits = arm.joints[static_cast<std::size_t>(i)].limits;
    bounds.setLow(static_cast<unsigned>(i), limits.lower / scale[i]);
    bounds.setHigh(static_cast<unsigned>(i), limits.upper / scale[i]);
  }
  space->setBounds(bounds);
  space->setStateSamplerAllocator([&arm, seed](const ob::StateSpace* of) -> ob::StateSamplerPtr {
    return std::make_shared<SeededSampler>(of, arm, seed);
  });
  return space;
}

JointPath path_of(const ob::ProblemDefinition& problem, const JointVector& scale) {
  JointPath path;
  for (const ob::State* state :
       problem.getSolutionPath()->as<ompl::geometric::PathGeometric>()->getStates()) {
    path.push_back(joints_of(state, scale));
  }
  return path;
}

}  // namespace

std::variant<JointPath, SearchFailure> find_path(const Arm& arm, const CollisionChecker& checker,
                                                 const JointVector& from, const JointVector& to,
                                                 const SearchBudget& budget) {
  const auto cancelled = [&budget] { return budget.cancelled && budget.cancelled(); };
  if (cancelled()) return SearchFailure::cancelled;
  if (checker.line_is_free(from, to)) return JointPath{from, to};

  ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);  // OMPL reports each search on standard output otherwise
  const JointVector scale = scale_of(arm);
  auto space = make_space(arm, query_seed(from, to));
  auto si = std::make_shared<ob::SpaceInformation>(space);
  si->setStateValidityChecker([&](const ob::State* s) { return !checker.contact(joints_of(s, scale)); });
  si->setMotionValidator(std::make_shared<LineValidator>(si, checker, scale));
  si->setup();

  auto problem = std::make_shared<ob::ProblemDefinition>(si);
  ob::ScopedState<Space> start(space), goal(space);
  store(from, scale, start.get());
  store(to, scale, goal.get());
  problem->setStartAndGoalStates(start, goal);

  ompl::geometric::RRTConnect planner(si);
  planner.setNearestNeighbors<ompl::NearestNeighborsLinear>();
  planner.setProblemDefinition(problem);
  planner.setup();

  unsigned asked = 0;
  const ob::PlannerTerminationCondition stop([&] { return ++asked > budget.iterations || cancelled(); });
  if (planner.solve(stop) != ob::PlannerStatus::EXACT_SOLUTION) {
    return cancelled() ? SearchFailure::cancelled : SearchFailure::budget_spent;
  }
  JointPath path = path_of(*problem, scale);
  path.front() = from;  // scaling there and back is not exact
  path.back() = to;
  return path;
}

}  // namespace roci::arm
