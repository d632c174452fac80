; every section and construct once
(define (domain d)
  (:requirements :typing :durative-actions :numeric-fluents :derived-predicates :modules)
  (:types a b - t)
  (:constants home - a)
  (:predicates (p) (q ?x - t) (r ?x ?y - t) (s ?x - (either a b)))
  (:functions (f) - number (g ?x - t))
  (:modules (:module m (:function (cost ?x ?y - t)) (:function (k))))
  (:derived (s ?x - t) (or (q ?x) (exists (?y - t) (and (r ?x ?y) (s ?y)))))
  (:action act
    :parameters (?x - a)
    :precondition (and (p) (not (q ?x)) (imply (p) (>= (f) (+ 1 (g ?x) 2))) (not (= ?x home)))
    :effect (and (p) (not (q ?x)) (forall (?y - t) (when (r ?x ?y) (increase (g ?y) (- (f)))))))
  (:durative-action move
    :parameters (?x ?y - t)
    :duration (and (>= ?duration (cost ?x ?y)) (<= ?duration 20.5))
    :condition (and (at start (q ?x)) (over all (forall (?z - a) (r ?x ?z))) (at end (< (f) 3e2)))
    :effect (and (at start (not (q ?x))) (at end (q ?y)) (at end (assign (f) (/ (f) 2)))
      (when (at start (p)) (at end (not (p)))) (forall (?z - b) (at start (s ?z)))))
  (:durative-action fill
    :parameters ()
    :duration (= ?duration 3)
    :effect (and (at end (increase (f) (* ?duration 2))) (increase (f) (* #t 2)))))
