(define (problem planetary-2)
  (:domain planetary)
  (:objects
    here - location
    image-n4 - image
    image-o3 - image
    place-h1 - location
    place-h2 - location
    place-h2-drop - location
    place-n4 - location
    place-o3 - location
    sample-h1 - sample
    sample-h2 - sample
  )
  (:init
    (arm-at stow)
    (at here)
    (available image-o3)
    (camera-idle)
    (gripper-empty)
    (radio-idle)
    (sample-at sample-h1 place-h1)
    (sample-at sample-h2 place-h2)
    (target image-n4 place-n4)
    (target image-o3 place-o3)
    (= (battery) 888507.000000)
    (= (reserve) 20000.000000)
    (at 1314.000000 (comm-window))
    (at 2514.000000 (not (comm-window)))
    (at 5214.000000 (comm-window))
    (at 6414.000000 (not (comm-window)))
    (at 9114.000000 (comm-window))
    (at 10314.000000 (not (comm-window)))
    (at 13014.000000 (comm-window))
    (at 14214.000000 (not (comm-window)))
    (at 1659.000000 (available image-n4))
    (at 1927.000000 (not (available image-n4)))
  )
  (:goal (and
    (picked sample-h1)
    (picked sample-h2)
    (dropped sample-h2 place-h2-drop)
    (sent image-o3)
    (sent image-n4)
  ))
  (:metric minimize (total-time))
)
