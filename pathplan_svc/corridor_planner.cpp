#include "pathplan_svc/corridor_planner.hpp"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateSampler.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/datastructures/NearestNeighborsLinear.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/fmt/FMT.h>
#include <ompl/util/Console.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <random>
#include <utility>

namespace roci::pathplan {
namespace {

namespace ob = ompl::base;
using Plane = ob::RealVectorStateSpace;

terrain::Point point_of(const ob::State* state) {
  const double* values = state->as<Plane::StateType>()->values;
  return {values[0], values[1]};
}

void set_point(ob::State* state, terrain::Point p) {
  double* values = state->as<Plane::StateType>()->values;
  values[0] = p.x;
  values[1] = p.y;
}

// Returns a number uniform in [0, 1): the standard leaves its distributions to the library, and this is the
// same with every one.
double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

// Gives first the points of the guide in order, then points beside it, all of them free.
class CorridorSampler : public ob::StateSampler {
 public:
  CorridorSampler(const ob::StateSpace* space, const Costmap& map, Polyline guide, double half_width,
                  std::uint64_t seed)
      : StateSampler(space), map_(map), guide_(std::move(guide)), half_width_(half_width), random_(seed) {}

  void sampleUniform(ob::State* state) override { set_point(state, next()); }
  void sampleUniformNear(ob::State* state, const ob::State*, double) override { sampleUniform(state); }
  void sampleGaussian(ob::State* state, const ob::State*, double) override { sampleUniform(state); }

 private:
  terrain::Point next() {
    if (given_ + 2 < guide_.size()) return guide_[++given_];
    terrain::Point on_guide;
    for (int attempt = 0; attempt < 8; ++attempt) {
      const double place = uniform(random_) * static_cast<double>(guide_.size() - 1);
      const auto i = std::min(static_cast<std::size_t>(place), guide_.size() - 2);
      const double share = place - static_cast<double>(i);
      const terrain::Point a = guide_[i];
      const terrain::Point b = guide_[i + 1];
      on_guide = {a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share};
      const terrain::Point beside{on_guide.x + (2 * uniform(random_) - 1) * half_width_,
                                  on_guide.y + (2 * uniform(random_) - 1) * half_width_};
      if (map_.is_free(beside)) return beside;
    }
    return on_guide;
  }

  const Costmap& map_;
  Polyline guide_;
  double half_width_;
  std::mt19937_64 random_;
  std::size_t given_ = 0;
};

class CellValidator : public ob::MotionValidator {
 public:
  CellValidator(const ob::SpaceInformationPtr& si, const Costmap& map) : MotionValidator(si), map_(map) {}
  bool checkMotion(const ob::State* a, const ob::State* b) const override {
    return is_free(map_, point_of(a), point_of(b));
  }
  bool checkMotion(const ob::State* a, const ob::State* b, std::pair<ob::State*, double>&) const override {
    return checkMotion(a, b);
  }

 private:
  const Costmap& map_;
};

class DriveTime : public ob::OptimizationObjective {
 public:
  DriveTime(const ob::SpaceInformationPtr& si, const Costmap& map, const DriveModel& drive)
      : OptimizationObjective(si), map_(map), drive_(drive) {}
  ob::Cost stateCost(const ob::State*) const override { return ob::Cost(0); }
  ob::Cost motionCost(const ob::State* a, const ob::State* b) const override {
    return ob::Cost(drive_time(map_, drive_, point_of(a), point_of(b)));
  }

 private:
  const Costmap& map_;
  const DriveModel& drive_;
};

// Gives the neighbours that OMPL's plain list gives, in the same order, but works each distance out once, not
// with each comparison.
template <typename T>
class RankedList : public ompl::NearestNeighborsLinear<T> {
 public:
  void nearestK(const T& data, std::size_t k, std::vector<T>& neighbours) const override {
    ranked_.clear();
    for (const T& other : this->data_) ranked_.emplace_back(this->distFun_(other, data), other);
    const auto nearer = [](const auto& a, const auto& b) { return a.first < b.first; };
    const auto end = ranked_.begin() + static_cast<std::ptrdiff_t>(std::min(k, ranked_.size()));
    if (ranked_.size() > k) {
      std::partial_sort(ranked_.begin(), end, ranked_.end(), nearer);
    } else {
      std::sort(ranked_.begin(), ranked_.end(), nearer);
    }
    neighbours.clear();
    for (auto it = ranked_.begin(); it != end; ++it) neighbours.push_back(it->second);
  }

 private:
  mutable std::vector<std::pair<double, T>> ranked_;
};

// Is FMT* with neighbours by distance from a list: OMPL's default tree draws its pivots from the
// process-wide seed, and driving time, which it would use as distance, is no metric.
class ListFmt : public ompl::geometric::FMT {
 public:
  explicit ListFmt(const ob::SpaceInformationPtr& si) : FMT(si) {
    nn_ = std::make_shared<RankedList<Motion*>>();
    setExtendedFMT(false);
  }
  void setup() override {
    FMT::setup();
    nn_->setDistanceFunction([](const Motion* a, const Motion* b) {
      return terrain::distance(point_of(a->getState()), point_of(b->getState()));
    });
  }
};

ob::StateSpacePtr plane_over(const terrain::Grid& grid) {
  auto space = std::make_shared<Plane>(2);
  ob::RealVectorBounds bounds(2);
  bounds.setLow(0, grid.origin.x);
  bounds.setLow(1, grid.origin.y);
  bounds.setHigh(0, grid.origin.x + grid.width());
  bounds.setHigh(1, grid.origin.y + grid.height());
  space->setBounds(bounds);
  return space;
}

}  // namespace

std::optional<Polyline> plan_in_corridor(const Costmap& map, const DriveModel& drive, const Polyline& guide,
                                         const CorridorSettings& settings, std::uint64_t seed) {
  if (guide.size() < 2) return std::nullopt;
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  double length = 0;
  for (std::size_t i = 1; i < guide.size(); ++i) length += terrain::distance(guide[i - 1], guide[i]);
  const int wanted = static_cast<int>(length * settings.samples_per_metre);
  const int samples = std::clamp(wanted, settings.min_samples, settings.max_samples);
  const Polyline dense = densify(guide, std::max(2.0, 2 * length / samples));

  const ob::StateSpacePtr space = plane_over(map.grid());
  space->setStateSamplerAllocator([&](const ob::StateSpace* s) {
    return std::make_shared<CorridorSampler>(s, map, dense, settings.half_width, seed);
  });
  const auto si = std::make_shared<ob::SpaceInformation>(space);
  si->setStateValidityChecker([&map](const ob::State* s) { return map.is_free(point_of(s)); });
  si->setMotionValidator(std::make_shared<CellValidator>(si, map));
  si->setup();

  const auto problem = std::make_shared<ob::ProblemDefinition>(si);
  ob::ScopedState<Plane> start(space);
  ob::ScopedState<Plane> goal(space);
  set_point(start.get(), guide.front());
  set_point(goal.get(), guide.back());
  problem->setStartAndGoalStates(start, goal);
  problem->setOptimizationObjective(std::make_shared<DriveTime>(si, map, drive));

  ListFmt planner(si);
  planner.setNumSamples(static_cast<unsigned>(samples));
  planner.setProblemDefinition(problem);
  planner.setup();
  if (planner.solve(ob::plannerNonTerminatingCondition()) != ob::PlannerStatus::EXACT_SOLUTION)
    return std::nullopt;

  Polyline path;
  for (const ob::State* state :
       problem->getSolutionPath()->as<ompl::geometric::PathGeometric>()->getStates()) {
    path.push_back(point_of(state));
  }
  return path;
}

}  // namespace roci::pathplan
