(define (problem planetary-2)
  (:domain planetary)
  (:objects
    image-h1 - image
    image-h2 - image
    image-n6 - image
    image-o3 - image
    place-h1 - location
    place-h2 - location
    place-n5 - location
    place-n5-drop - location
    place-n6 - location
    place-o3 - location
    place-o4 - location
    sample-n5 - sample
    sample-o4 - sample
  )
  (:init
    (arm-at stow)
    (at place-h1)
    (available image-h2)
    (available image-o3)
    (camera-idle)
    (comm-window)
    (gripper-empty)
    (have-image image-o3)
    (radio-idle)
    (sample-at sample-n5 place-n5)
    (sample-at sample-o4 place-o4)
    (target image-h1 place-h1)
    (target image-h2 place-h2)
    (target image-n6 place-n6)
    (target image-o3 place-o3)
    (= (battery) 856184.000000)
    (= (reserve) 20000.000000)
    (at 16.000000 (not (comm-window)))
    (at 2716.000000 (comm-window))
    (at 3916.000000 (not (comm-window)))
    (at 6616.000000 (comm-window))
    (at 7816.000000 (not (comm-window)))
    (at 10516.000000 (comm-window))
    (at 11716.000000 (not (comm-window)))
    (at 1814.000000 (available image-h1))
    (at 6813.000000 (not (available image-h1)))
    (at 2598.000000 (available image-n6))
    (at 3020.000000 (not (available image-n6)))
  )
  (:goal (and
    (sent image-h1)
    (sent image-h2)
    (sent image-o3)
    (picked sample-o4)
    (picked sample-n5)
    (dropped sample-n5 place-n5-drop)
    (sent image-n6)
  ))
  (:metric minimize (total-time))
)
