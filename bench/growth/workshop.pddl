; Pieces are fired while a kiln burns, any two fired ones may be joined, and what is joined may be glazed in a kiln. A pair of
; pieces is two facts that nothing deletes, each a variable of its own: they grow with the square of the pieces.
(define (domain growth-workshop)
  (:requirements :typing :durative-actions)
  (:types kiln piece)
  (:predicates (cold ?k - kiln) (hot ?k - kiln) (raw ?p - piece) (fired ?p - piece)
               (joined ?p ?q - piece) (glazed ?p ?q - piece))

  (:durative-action burn :parameters (?k - kiln) :duration (= ?duration 20)
    :condition (at start (cold ?k))
    :effect (and (at start (not (cold ?k))) (at start (hot ?k)) (at end (not (hot ?k))) (at end (cold ?k))))

  (:durative-action fire :parameters (?p - piece ?k - kiln) :duration (= ?duration 8)
    :condition (and (at start (raw ?p)) (over all (hot ?k)))
    :effect (and (at start (not (raw ?p))) (at end (fired ?p))))

  (:durative-action join :parameters (?p ?q - piece) :duration (= ?duration 3)
    :condition (and (at start (fired ?p)) (at start (fired ?q)))
    :effect (at end (joined ?p ?q)))

  (:durative-action glaze :parameters (?p ?q - piece ?k - kiln) :duration (= ?duration 5)
    :condition (and (at start (joined ?p ?q)) (over all (hot ?k)))
    :effect (at end (glazed ?p ?q))))
