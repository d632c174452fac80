(define (problem planetary-1)
  (:domain planetary)
  (:objects
    here - location
    image-h1 - image
    image-o3 - image
    place-h1 - location
    place-o2 - location
    place-o2-drop - location
    place-o3 - location
    sample-o2 - sample
  )
  (:init
    (arm-at stow)
    (at here)
    (available image-h1)
    (available image-o3)
    (camera-idle)
    (gripper-empty)
    (radio-idle)
    (sample-at sample-o2 place-o2)
    (target image-h1 place-h1)
    (target image-o3 place-o3)
    (= (battery) 158946.000000)
    (= (reserve) 20000.000000)
    (at 1485.000000 (comm-window))
    (at 2685.000000 (not (comm-window)))
    (at 5385.000000 (comm-window))
    (at 6585.000000 (not (comm-window)))
    (at 9285.000000 (comm-window))
    (at 10485.000000 (not (comm-window)))
    (at 13185.000000 (comm-window))
    (at 14385.000000 (not (comm-window)))
  )
  (:goal (and
    (sent image-h1)
    (picked sample-o2)
    (dropped sample-o2 place-o2-drop)
    (sent image-o3)
  ))
  (:metric minimize (total-time))
)
