; The scout goes first; the primary follows where the way was found safe.
(define (domain convoy)
  (:requirements :typing :durative-actions)
  (:types waypoint - object)
  (:predicates
    (next ?from ?to - waypoint)
    (scout-at ?w - waypoint)
    (primary-at ?w - waypoint)
    (safe ?w - waypoint))

  (:durative-action scout
    :parameters (?from ?to - waypoint)
    :duration (= ?duration 70)
    :condition (and (at start (next ?from ?to)) (at start (scout-at ?from)) (over all (primary-at ?from)))
    :effect (and (at start (not (scout-at ?from))) (at end (scout-at ?to)) (at end (safe ?to))))

  (:durative-action follow
    :parameters (?from ?to - waypoint)
    :duration (= ?duration 90)
    :condition (and (at start (next ?from ?to)) (at start (primary-at ?from)) (at start (safe ?to))
                    (over all (scout-at ?to)))
    :effect (and (at start (not (primary-at ?from))) (at end (primary-at ?to))))
)
