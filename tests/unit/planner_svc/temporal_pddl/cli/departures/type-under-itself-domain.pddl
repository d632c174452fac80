; A ferry carries cars over a river; it takes one at a time.
(define (domain ferry)
  (:requirements :typing :durative-actions :numeric-fluents)
  (:types
    jetty quay - quay
    car - object)
  (:predicates (at-quay ?c - car ?q - quay) (ferry-at ?q - quay) (on-board ?c - car) (empty))
  (:functions (crossing ?from ?to - quay))
  (:durative-action board
    :parameters (?c - car ?q - quay)
    :duration (= ?duration 2)
    :condition (and (at start (at-quay ?c ?q)) (at start (empty)) (over all (ferry-at ?q)))
    :effect (and (at start (not (at-quay ?c ?q))) (at start (not (empty))) (at end (on-board ?c))))
  (:durative-action land
    :parameters (?c - car ?q - quay)
    :duration (= ?duration 2)
    :condition (and (at start (on-board ?c)) (over all (ferry-at ?q)))
    :effect (and (at start (not (on-board ?c))) (at end (at-quay ?c ?q)) (at end (empty))))
  (:durative-action cross
    :parameters (?from ?to - quay)
    :duration (= ?duration (crossing ?from ?to))
    :condition (at start (ferry-at ?from))
    :effect (and (at start (not (ferry-at ?from))) (at end (ferry-at ?to)))))
