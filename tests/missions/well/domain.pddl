; A cart that bores for water. It has wheels, a drill and a solar blanket that it spreads where it stands; no arm and no
; camera. Times are in seconds, energy is in joules; energies contain the 10 W that the cart draws anyway.
(define (domain well)
  (:requirements :typing :durative-actions :numeric-fluents)

  (:types location hole - object)

  (:modules
    (:module pathplan
      (:function (traverse_time ?from ?to - location))
      (:function (traverse_energy ?from ?to - location))))

  (:predicates
    (at ?l - location)
    (drill-rests)
    (blanket-rolled)
    (hole-at ?h - hole ?l - location)   ; it is to be bored there
    (bored ?h - hole))

  (:functions (battery) (reserve))

  (:durative-action drive
    :parameters (?from ?to - location)
    :duration (= ?duration (traverse_time ?from ?to))
    :condition (and
      (at start (at ?from))
      (over all (drill-rests))
      (over all (blanket-rolled))
      (at start (>= (battery) (+ (reserve) (traverse_energy ?from ?to)))))
    :effect (and
      (at start (not (at ?from)))
      (at start (decrease (battery) (traverse_energy ?from ?to)))
      (at end (at ?to))))

  (:durative-action bore
    :parameters (?h - hole ?l - location)
    :duration (= ?duration 600)
    :condition (and
      (at start (hole-at ?h ?l))
      (at start (drill-rests))
      (over all (at ?l))
      (at start (>= (battery) (+ (reserve) 60000))))
    :effect (and
      (at start (not (drill-rests)))
      (at start (decrease (battery) 60000))
      (at end (drill-rests))
      (at end (bored ?h))))

  (:durative-action charge
    :parameters (?l - location)
    :duration (= ?duration 1500)
    :condition (and
      (at start (blanket-rolled))
      (over all (at ?l))
      (at start (<= (battery) 100000)))
    :effect (and
      (at start (not (blanket-rolled)))
      (at end (blanket-rolled))
      (at end (increase (battery) 120000))))
)
