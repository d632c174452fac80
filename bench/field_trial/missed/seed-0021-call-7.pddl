(define (problem planetary-7)
  (:domain planetary)
  (:objects
    here - location
    image-n5 - image
    place-h2 - location
    place-n5 - location
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
    (= (battery) 744641.000000)
    (= (reserve) 20000.000000)
    (at 264.498500 (not (comm-window)))
    (at 2964.498500 (comm-window))
    (at 4164.498500 (not (comm-window)))
    (at 6864.498500 (comm-window))
    (at 8064.498500 (not (comm-window)))
    (at 10764.498500 (comm-window))
    (at 11964.498500 (not (comm-window)))
    (at 334.498500 (available image-n5))
    (at 770.498500 (not (available image-n5)))
  )
  (:goal (and
    (picked sample-h2)
    (picked sample-o3)
    (picked sample-o4)
    (dropped sample-o4 place-o4-drop)
    (sent image-n5)
  ))
  (:metric minimize (total-time))
)
