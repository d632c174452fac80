; A robot that bores holes. How long a hole takes the drill's own service knows: bore_time is its function.
(define (domain borehole)
  (:requirements :typing :durative-actions :numeric-fluents)
  (:types place - object)
  (:modules
    (:module drill
      (:function (bore_time ?p - place))))
  (:predicates
    (drill-idle)
    (bored ?p - place))
  (:durative-action bore
    :parameters (?p - place)
    :duration (= ?duration (bore_time ?p))
    :condition (at start (drill-idle))
    :effect (and
      (at start (not (drill-idle)))
      (at end (drill-idle))
      (at end (bored ?p)))))
