(define (problem planetary-4)
  (:domain planetary)
  (:objects
    image-h1 - image
    image-h2 - image
    image-n4 - image
    image-n5 - image
    image-n6 - image
    place-h1 - location
    place-h2 - location
    place-n4 - location
    place-n5 - location
    place-n6 - location
  )
  (:init
    (arm-at stow)
    (at place-h1)
    (available image-h2)
    (available image-n5)
    (available image-n6)
    (camera-idle)
    (gripper-empty)
    (have-image image-h2)
    (radio-idle)
    (target image-h1 place-h1)
    (target image-h2 place-h2)
    (target image-n4 place-n4)
    (target image-n5 place-n5)
    (target image-n6 place-n6)
    (= (battery) 669054.000000)
    (= (reserve) 20000.000000)
    (at 1992.000000 (comm-window))
    (at 3192.000000 (not (comm-window)))
    (at 5892.000000 (comm-window))
    (at 7092.000000 (not (comm-window)))
    (at 9792.000000 (comm-window))
    (at 10992.000000 (not (comm-window)))
    (at 510.000000 (available image-h1))
    (at 5774.000000 (not (available image-h1)))
    (at 773.000000 (not (available image-h2)))
    (at 702.000000 (available image-n4))
    (at 935.000000 (not (available image-n4)))
  )
  (:goal (and
    (sent image-h1)
    (sent image-h2)
    (sent image-n6)
    (sent image-n4)
    (sent image-n5)
  ))
  (:metric minimize (total-time))
)
