(define (problem planetary-3)
  (:domain planetary)
  (:objects
    here - location
    image-h1 - image
    image-h2 - image
    image-n5 - image
    image-o3 - image
    image-o4 - image
    place-h1 - location
    place-h2 - location
    place-n5 - location
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
    (target image-o3 place-o3)
    (target image-o4 place-o4)
    (= (battery) 876065.000000)
    (= (reserve) 20000.000000)
    (at 1124.498500 (comm-window))
    (at 2324.498500 (not (comm-window)))
    (at 5024.498500 (comm-window))
    (at 6224.498500 (not (comm-window)))
    (at 8924.498500 (comm-window))
    (at 10124.498500 (not (comm-window)))
    (at 12824.498500 (comm-window))
    (at 14024.498500 (not (comm-window)))
    (at 235.498500 (available image-h1))
    (at 3747.498500 (not (available image-h1)))
    (at 1018.498500 (available image-o4))
    (at 1259.498500 (not (available image-o4)))
  )
  (:goal (and
    (sent image-h1)
    (sent image-h2)
    (sent image-o3)
    (sent image-o4)
    (sent image-n5)
  ))
  (:metric minimize (total-time))
)
