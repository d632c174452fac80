; Jobs that can only be done while a furnace burns, each in one furnace and one at a time there; furnaces burn for a
; fixed time and cool down. A job inside needs its furnace to run around it: concurrency is required.
(define (domain growth-envelopes)
  (:requirements :typing :durative-actions :numeric-fluents)
  (:types furnace job)
  (:predicates (cold ?f - furnace) (hot ?f - furnace) (hands-free ?f - furnace) (belongs ?j - job ?f - furnace)
               (raw ?j - job) (done ?j - job))
  (:functions (burns ?f - furnace) (takes ?j - job))

  (:durative-action burn :parameters (?f - furnace) :duration (= ?duration (burns ?f))
    :condition (at start (cold ?f))
    :effect (and (at start (not (cold ?f))) (at start (hot ?f)) (at end (not (hot ?f))) (at end (cold ?f))))

  (:durative-action treat :parameters (?j - job ?f - furnace) :duration (= ?duration (takes ?j))
    :condition (and (at start (belongs ?j ?f)) (at start (raw ?j)) (at start (hands-free ?f)) (over all (hot ?f)))
    :effect (and (at start (not (hands-free ?f))) (at start (not (raw ?j))) (at end (hands-free ?f)) (at end (done ?j)))))
