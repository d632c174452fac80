; A rover with a camera, a sampling arm and a radio on a planetary site (Stellar, section 3.3; R57).
; This file never changes during a mission (R8). Times are in seconds, energy is in joules. Energies contain what the
; robot draws anyway (14 W) for as long as the action takes; a transmission runs beside others and goes without.
(define (domain planetary)
  (:requirements :typing :durative-actions :numeric-fluents :timed-initial-literals)

  (:types location pose image sample - object)

  (:constants stow sampling deposit - pose)

  (:modules
    (:module pathplan
      (:function (traverse_time ?from ?to - location))
      (:function (traverse_energy ?from ?to - location)))
    (:module arm
      (:function (arm_move_time ?from ?to - pose))
      (:function (arm_move_energy ?from ?to - pose))))

  (:predicates
    (at ?l - location)               ; the rover stands there
    (arm-at ?p - pose)
    (camera-idle)
    (radio-idle)
    (gripper-empty)
    (holding ?s - sample)
    (sample-at ?s - sample ?l - location)
    (picked ?s - sample)             ; was picked at some time
    (dropped ?s - sample ?l - location)
    (target ?i - image ?l - location)  ; image ?i shows what is seen from ?l
    (available ?i - image)           ; the window of the image, if it has one, is open
    (have-image ?i - image)
    (sent ?i - image)
    (comm-window))                   ; the orbiter is in view

  (:functions (battery) (reserve))

  (:durative-action drive
    :parameters (?from ?to - location)
    :duration (= ?duration (traverse_time ?from ?to))
    :condition (and
      (at start (at ?from))
      (over all (arm-at stow))
      (over all (camera-idle))
      (at start (>= (battery) (+ (reserve) (traverse_energy ?from ?to)))))
    :effect (and
      (at start (not (at ?from)))
      (at start (decrease (battery) (traverse_energy ?from ?to)))
      (at end (at ?to))))

  (:durative-action move-arm
    :parameters (?from ?to - pose)
    :duration (= ?duration (arm_move_time ?from ?to))
    :condition (and
      (at start (arm-at ?from))
      (at start (>= (battery) (+ (reserve) (arm_move_energy ?from ?to)))))
    :effect (and
      (at start (not (arm-at ?from)))
      (at start (decrease (battery) (arm_move_energy ?from ?to)))
      (at end (arm-at ?to))))

  (:durative-action take-image
    :parameters (?i - image ?l - location)
    :duration (= ?duration 40)
    :condition (and
      (at start (target ?i ?l))
      (at start (camera-idle))
      (over all (at ?l))
      (over all (available ?i))
      (at start (>= (battery) (+ (reserve) 1160))))
    :effect (and
      (at start (not (camera-idle)))
      (at start (decrease (battery) 1160))
      (at end (camera-idle))
      (at end (have-image ?i))))

  (:durative-action pick
    :parameters (?s - sample ?l - location)
    :duration (= ?duration 60)
    :condition (and
      (at start (sample-at ?s ?l))
      (at start (gripper-empty))
      (over all (at ?l))
      (over all (arm-at sampling))
      (at start (>= (battery) (+ (reserve) 1740))))
    :effect (and
      (at start (not (gripper-empty)))
      (at start (decrease (battery) 1740))
      (at end (not (sample-at ?s ?l)))
      (at end (holding ?s))
      (at end (picked ?s))))

  (:durative-action drop
    :parameters (?s - sample ?l - location)
    :duration (= ?duration 30)
    :condition (and
      (at start (holding ?s))
      (over all (at ?l))
      (over all (arm-at deposit))
      (at start (>= (battery) (+ (reserve) 870))))
    :effect (and
      (at start (decrease (battery) 870))
      (at end (not (holding ?s)))
      (at end (gripper-empty))
      (at end (dropped ?s ?l))))

  (:durative-action transmit
    :parameters (?i - image)
    :duration (= ?duration 120)
    :condition (and
      (at start (have-image ?i))
      (at start (radio-idle))
      (over all (comm-window))
      (at start (>= (battery) (+ (reserve) 3000))))
    :effect (and
      (at start (not (radio-idle)))
      (at start (decrease (battery) 3000))
      (at end (radio-idle))
      (at end (sent ?i))))
)
