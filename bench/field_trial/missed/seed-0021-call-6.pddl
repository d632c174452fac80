(define (problem planetary-6)
  (:domain planetary)
  (:objects
    here - location
    image-n5 - image
    image-n6 - image
    place-h2 - location
    place-n5 - location
    place-n6 - location
    place-o3 - location
    place-o4 - location
    place-o4-drop - location
    sample-h2 - sample
    sample-o3 - sample
    sample-o4 - sample
  )
  (:init
    (arm-at stow)
    (at here)
    (camera-idle)
    (comm-window)
    (gripper-empty)
    (radio-idle)
    (sample-at sample-h2 place-h2)
    (sample-at sample-o3 place-o3)
    (sample-at sample-o4 place-o4)
    (target image-n5 place-n5)
    (target image-n6 place-n6)
    (= (battery) 745481.000000)
    (= (reserve) 20000.000000)
    (at 325.000000 (not (comm-window)))
    (at 3025.000000 (comm-window))
    (at 4225.000000 (not (comm-window)))
    (at 6925.000000 (comm-window))
    (at 8125.000000 (not (comm-window)))
    (at 10825.000000 (comm-window))
    (at 12025.000000 (not (comm-window)))
    (at 395.000000 (available image-n5))
    (at 831.000000 (not (available image-n5)))
    (at 3432.000000 (available image-n6))
    (at 3918.000000 (not (available image-n6)))
  )
  (:goal (and
    (picked sample-h2)
    (picked sample-o3)
    (picked sample-o4)
    (dropped sample-o4 place-o4-drop)
    (sent image-n5)
    (sent image-n6)
  ))
  (:metric minimize (total-time))
)
