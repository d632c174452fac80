; A rover drives between sites, looks at rocks while they are lit, and sends each picture home; its battery is filled in
; the sun. The domain of the growth measurements.
(define (domain growth-rover)
  (:requirements :typing :durative-actions :numeric-fluents :timed-initial-literals)
  (:types site)
  (:predicates (at ?s - site) (road ?a ?b - site) (lit ?s - site) (sunny ?s - site) (idle)
               (pictured ?s - site) (sent ?s - site))
  (:functions (far ?a ?b - site) (battery))

  (:durative-action drive :parameters (?a ?b - site) :duration (= ?duration (far ?a ?b))
    :condition (and (at start (at ?a)) (at start (road ?a ?b)) (at start (>= (battery) (far ?a ?b))))
    :effect (and (at start (not (at ?a))) (at start (decrease (battery) (far ?a ?b))) (at end (at ?b))))

  (:durative-action picture :parameters (?s - site) :duration (= ?duration 3)
    :condition (and (over all (at ?s)) (over all (lit ?s)) (at start (idle)))
    :effect (and (at start (not (idle))) (at end (idle)) (at end (pictured ?s))))

  (:durative-action send :parameters (?s - site) :duration (= ?duration 5)
    :condition (and (at start (pictured ?s)) (at start (idle)))
    :effect (and (at start (not (idle))) (at end (idle)) (at end (sent ?s))))

  (:durative-action charge :parameters (?s - site) :duration (= ?duration 20)
    :condition (and (over all (at ?s)) (at start (sunny ?s)) (at start (idle)))
    :effect (and (at start (not (idle))) (at end (idle)) (at end (increase (battery) 60)))))
