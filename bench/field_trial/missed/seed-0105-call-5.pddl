(define (problem planetary-5)
  (:domain planetary)
  (:objects
    here - location
    image-h1 - image
    image-h2 - image
    image-n8 - image
    place-h1 - location
    place-h2 - location
    place-n5 - location
    place-n5-drop - location
    place-n6 - location
    place-n6-drop - location
    place-n8 - location
    sample-n5 - sample
    sample-n6 - sample
  )
  (:init
    (arm-at stow)
    (at here)
    (available image-h1)
    (available image-h2)
    (available image-n8)
    (camera-idle)
    (gripper-empty)
    (radio-idle)
    (sample-at sample-n5 place-n5)
    (sample-at sample-n6 place-n6)
    (target image-h1 place-h1)
    (target image-h2 place-h2)
    (target image-n8 place-n8)
    (= (battery) 639882.000000)
    (= (reserve) 20000.000000)
    (at 1875.000000 (comm-window))
    (at 3075.000000 (not (comm-window)))
    (at 5775.000000 (comm-window))
    (at 6975.000000 (not (comm-window)))
    (at 9675.000000 (comm-window))
    (at 10875.000000 (not (comm-window)))
    (at 4642.000000 (not (available image-h2)))
  )
  (:goal (and
    (sent image-h1)
    (sent image-h2)
    (sent image-n8)
    (picked sample-n5)
    (dropped sample-n5 place-n5-drop)
    (picked sample-n6)
    (dropped sample-n6 place-n6-drop)
  ))
  (:metric minimize (total-time))
)
