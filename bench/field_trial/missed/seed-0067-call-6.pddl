(define (problem planetary-6)
  (:domain planetary)
  (:objects
    here - location
    image-h1 - image
    image-h2 - image
    image-n5 - image
    image-o3 - image
    place-h1 - location
    place-h2 - location
    place-n4 - location
    place-n4-drop - location
    place-n5 - location
    place-n6 - location
    place-n6-drop - location
    place-n7 - location
    place-n7-drop - location
    place-o3 - location
    sample-n4 - sample
    sample-n6 - sample
    sample-n7 - sample
  )
  (:init
    (arm-at stow)
    (at here)
    (available image-h1)
    (available image-h2)
    (available image-o3)
    (camera-idle)
    (gripper-empty)
    (radio-idle)
    (sample-at sample-n4 place-n4)
    (sample-at sample-n6 place-n6)
    (sample-at sample-n7 place-n7)
    (target image-h1 place-h1)
    (target image-h2 place-h2)
    (target image-n5 place-n5)
    (target image-o3 place-o3)
    (= (battery) 337195.000000)
    (= (reserve) 20000.000000)
    (at 1108.000000 (comm-window))
    (at 2308.000000 (not (comm-window)))
    (at 5008.000000 (comm-window))
    (at 6208.000000 (not (comm-window)))
    (at 8908.000000 (comm-window))
    (at 10108.000000 (not (comm-window)))
    (at 12808.000000 (comm-window))
    (at 14008.000000 (not (comm-window)))
    (at 3724.000000 (available image-n5))
    (at 4201.000000 (not (available image-n5)))
  )
  (:goal (and
    (sent image-h1)
    (sent image-h2)
    (sent image-o3)
    (picked sample-n6)
    (dropped sample-n6 place-n6-drop)
    (picked sample-n7)
    (dropped sample-n7 place-n7-drop)
    (picked sample-n4)
    (dropped sample-n4 place-n4-drop)
    (sent image-n5)
  ))
  (:metric minimize (total-time))
)
