(define (problem planetary-2)
  (:domain planetary)
  (:objects
    here - location
    image-h1 - image
    image-h2 - image
    image-n5 - image
    image-n6 - image
    image-o3 - image
    image-o4 - image
    place-h1 - location
    place-h2 - location
    place-n5 - location
    place-n6 - location
    place-o3 - location
    place-o4 - location
  )
  (:init
    (arm-at stow)
    (at here)
    (available image-h2)
    (available image-n5)
    (available image-o3)
    (camera-idle)
    (gripper-empty)
    (radio-idle)
    (target image-h1 place-h1)
    (target image-h2 place-h2)
    (target image-n5 place-n5)
    (target image-n6 place-n6)
    (target image-o3 place-o3)
    (target image-o4 place-o4)
    (= (battery) 876905.000000)
    (= (reserve) 20000.000000)
    (at 1185.000000 (comm-window))
    (at 2385.000000 (not (comm-window)))
    (at 5085.000000 (comm-window))
    (at 6285.000000 (not (comm-window)))
    (at 8985.000000 (comm-window))
    (at 10185.000000 (not (comm-window)))
    (at 12885.000000 (comm-window))
    (at 14085.000000 (not (comm-window)))
    (at 296.000000 (available image-h1))
    (at 3808.000000 (not (available image-h1)))
    (at 1079.000000 (available image-o4))
    (at 1320.000000 (not (available image-o4)))
    (at 1619.000000 (available image-n6))
    (at 2088.000000 (not (available image-n6)))
  )
  (:goal (and
    (sent image-h1)
    (sent image-h2)
    (sent image-o3)
    (sent image-o4)
    (sent image-n5)
    (sent image-n6)
  ))
  (:metric minimize (total-time))
)
