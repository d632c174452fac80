; One car wants to get over.
(define (problem one-car)
  (:domain ferry)
  (:objects north south - quay van - car)
  (:init (ferry-at south) (at-quay van north) (empty)
         (= (crossing north south) 9) (= (crossing north south) 5) (= (crossing south north) 5)
         (= (crossing north north) 1) (= (crossing south south) 1))
  (:goal (at-quay van south)))
