; An arm that walks along the rail of a modular satellite takes modules out of slots and puts them into others. How long
; it takes from one slot to another, with steps and changes of pose, and what energy it needs to arrive there, only the
; arm's own planner knows. It finds a slot precisely only as long as it stays there; modules are unlatched before they
; are moved and latched afterwards, by themselves while the arm goes on.
(define (domain orbital-arm)
  (:requirements :typing :durative-actions :numeric-fluents)
  (:types slot module)
  (:modules
    (:module ef_orbitalrarmplanner
      (:function (ra_move_dur ?from ?to - slot))
      (:function (ra_move_energy ?to - slot))))
  (:predicates (arm-at ?s - slot) (localised ?s - slot) (gripper-empty) (holding ?m - module)
               (in ?m - module ?s - slot) (free ?s - slot) (latched ?m - module) (loose ?m - module))
  (:functions (energy))

  (:durative-action move :parameters (?from ?to - slot) :duration (= ?duration (ra_move_dur ?from ?to))
    :condition (and (at start (arm-at ?from)) (at start (>= (energy) (ra_move_energy ?to))))
    :effect (and (at start (not (arm-at ?from))) (at start (not (localised ?from)))
                 (at start (decrease (energy) (ra_move_energy ?to))) (at end (arm-at ?to))))

  (:durative-action localise :parameters (?s - slot) :duration (= ?duration 25)
    :condition (over all (arm-at ?s))
    :effect (at end (localised ?s)))

  (:durative-action unlatch :parameters (?m - module) :duration (= ?duration 40)
    :condition (at start (latched ?m))
    :effect (and (at start (not (latched ?m))) (at end (loose ?m))))

  (:durative-action grasp :parameters (?m - module ?s - slot) :duration (= ?duration 15)
    :condition (and (at start (gripper-empty)) (at start (in ?m ?s)) (at start (localised ?s)) (over all (loose ?m))
                    (over all (arm-at ?s)))
    :effect (and (at start (not (gripper-empty))) (at end (not (in ?m ?s))) (at end (free ?s)) (at end (holding ?m))))

  (:durative-action place :parameters (?m - module ?s - slot) :duration (= ?duration 20)
    :condition (and (at start (holding ?m)) (at start (free ?s)) (at start (localised ?s)) (over all (arm-at ?s)))
    :effect (and (at start (not (free ?s))) (at end (not (holding ?m))) (at end (in ?m ?s)) (at end (gripper-empty))))

  (:durative-action latch :parameters (?m - module ?s - slot) :duration (= ?duration 40)
    :condition (and (at start (loose ?m)) (over all (in ?m ?s)))
    :effect (and (at start (not (loose ?m))) (at end (latched ?m)))))
