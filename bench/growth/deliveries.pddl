; Drivers walk along paths to trucks and drive them along roads; trucks carry any number of parcels. Nearly every object may
; meet every other one at every place: ground actions grow with the product of three or four kinds of objects.
(define (domain growth-deliveries)
  (:requirements :typing :durative-actions :numeric-fluents)
  (:types place driver truck parcel)
  (:predicates (road ?a ?b - place) (path ?a ?b - place) (driver-at ?d - driver ?l - place) (truck-at ?t - truck ?l - place)
               (in-cab ?d - driver ?t - truck) (cab-empty ?t - truck) (parcel-at ?p - parcel ?l - place)
               (aboard ?p - parcel ?t - truck))
  (:functions (drive-time ?a ?b - place) (walk-time ?a ?b - place))

  (:durative-action load :parameters (?p - parcel ?t - truck ?l - place) :duration (= ?duration 2)
    :condition (and (over all (truck-at ?t ?l)) (at start (parcel-at ?p ?l)))
    :effect (and (at start (not (parcel-at ?p ?l))) (at end (aboard ?p ?t))))

  (:durative-action unload :parameters (?p - parcel ?t - truck ?l - place) :duration (= ?duration 2)
    :condition (and (over all (truck-at ?t ?l)) (at start (aboard ?p ?t)))
    :effect (and (at start (not (aboard ?p ?t))) (at end (parcel-at ?p ?l))))

  (:durative-action board :parameters (?d - driver ?t - truck ?l - place) :duration (= ?duration 1)
    :condition (and (over all (truck-at ?t ?l)) (at start (driver-at ?d ?l)) (at start (cab-empty ?t)))
    :effect (and (at start (not (driver-at ?d ?l))) (at start (not (cab-empty ?t))) (at end (in-cab ?d ?t))))

  (:durative-action leave :parameters (?d - driver ?t - truck ?l - place) :duration (= ?duration 1)
    :condition (and (over all (truck-at ?t ?l)) (at start (in-cab ?d ?t)))
    :effect (and (at start (not (in-cab ?d ?t))) (at end (driver-at ?d ?l)) (at end (cab-empty ?t))))

  (:durative-action drive :parameters (?t - truck ?a ?b - place ?d - driver) :duration (= ?duration (drive-time ?a ?b))
    :condition (and (at start (road ?a ?b)) (at start (truck-at ?t ?a)) (over all (in-cab ?d ?t)))
    :effect (and (at start (not (truck-at ?t ?a))) (at end (truck-at ?t ?b))))

  (:durative-action walk :parameters (?d - driver ?a ?b - place) :duration (= ?duration (walk-time ?a ?b))
    :condition (and (at start (path ?a ?b)) (at start (driver-at ?d ?a)))
    :effect (and (at start (not (driver-at ?d ?a))) (at end (driver-at ?d ?b)))))
