// This file tests whether the arm touches itself, its carrier or the ground, by exact shape tests of FCL
// (Pan, Chitta, Manocha, ICRA 2012).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/kinematics/arm.hpp"

namespace roci::arm {

/// Says what is tested, and how near things may come.
struct CollisionRules {
  std::optional<double> ground_z;  ///< Is level ground in the base frame, m; without it space is free.
  double margin = 0.01;            ///< Every surface is moved outwards by this, m.
  std::vector<std::pair<std::string, std::string>> may_touch;  ///< These pairs of links are never tested.
};

/// Names two things that touch.
struct Contact {
  std::string first;   ///< Names a link.
  std::string second;  ///< Names a link, or "ground".
};

/// Tests bodies that are not joined by a joint (those that are may touch at it), and moving bodies against
/// the ground and against obstacles. It is safe to use from several threads.
class CollisionChecker {
 public:
  /// `obstacles` stand still in the base frame; other than the base they are tested against every moving body.
  CollisionChecker(kinematics::Arm arm, CollisionRules rules,
                   std::vector<kinematics::CollisionShape> obstacles = {});
  ~CollisionChecker();
  CollisionChecker(CollisionChecker&&) noexcept;
  CollisionChecker& operator=(CollisionChecker&&) noexcept;

  /// Returns the obstacles that the arm touches at `q`, as indices into those that the checker was made with.
  std::vector<std::size_t> obstacles_touched(const kinematics::JointVector& q) const;

  /// Returns the first contact in a fixed order of pairs, with surfaces moved out by the margin.
  std::optional<Contact> contact(const kinematics::JointVector& q) const;

  /// Returns true if there is no contact anywhere on the straight joint-space line between the two. The line
  /// is sampled so densely that no point of the arm moves more than twice the margin between samples: nothing
  /// can pass through unseen.
  bool line_is_free(const kinematics::JointVector& from, const kinematics::JointVector& to) const;

 private:
  struct Scene;
  std::unique_ptr<const Scene> scene_;
};

}  // namespace roci::arm
