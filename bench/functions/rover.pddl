; A rover that may drive from any way-point to any other, in a time and with an energy that its path planner alone knows.
; The domain of the measurements of external functions.
(define (domain functions-rover)
  (:requirements :typing :durative-actions :numeric-fluents)
  (:types site)
  (:modules (:module paths
    (:function (traverse_time ?from ?to - site))
    (:function (traverse_energy ?from ?to - site))))
  (:predicates (at ?s - site) (idle) (pictured ?s - site) (sent ?s - site))
  (:functions (battery))

  (:durative-action drive :parameters (?from ?to - site) :duration (= ?duration (traverse_time ?from ?to))
    :condition (and (at start (at ?from)) (at start (idle)) (at start (>= (battery) (traverse_energy ?from ?to))))
    :effect (and (at start (not (at ?from))) (at start (not (idle))) (at end (idle)) (at end (at ?to))
                 (at start (decrease (battery) (traverse_energy ?from ?to)))))

  (:durative-action picture :parameters (?s - site) :duration (= ?duration 30)
    :condition (and (over all (at ?s)) (at start (idle)))
    :effect (and (at start (not (idle))) (at end (idle)) (at end (pictured ?s))))

  (:durative-action send :parameters (?s - site) :duration (= ?duration 20)
    :condition (and (at start (pictured ?s)) (at start (idle)))
    :effect (and (at start (not (idle))) (at end (idle)) (at end (sent ?s)))))
