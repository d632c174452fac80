(define (problem planetary-2)
  (:domain planetary)
  (:objects
    here - location
    image-h1 - image
    image-n4 - image
    image-o3 - image
    place-h1 - location
    place-n4 - location
    place-o2 - location
    place-o2-drop - location
    place-o3 - location
    sample-o2 - sample
  )
  (:init
    (arm-at stow)
    (at here)
    (available image-n4)
    (available image-o3)
    (camera-idle)
    (comm-window)
    (gripper-empty)
    (have-image image-o3)
    (radio-idle)
    (sample-at sample-o2 place-o2)
    (target image-h1 place-h1)
    (target image-n4 place-n4)
    (target image-o3 place-o3)
    (= (battery) 158793.000000)
    (= (reserve) 20000.000000)
    (at 650.000000 (not (comm-window)))
    (at 3350.000000 (comm-window))
    (at 4550.000000 (not (comm-window)))
    (at 7250.000000 (comm-window))
    (at 8450.000000 (not (comm-window)))
    (at 11150.000000 (comm-window))
    (at 12350.000000 (not (comm-window)))
    (at 778.000000 (available image-h1))
    (at 5722.000000 (not (available image-h1)))
    (at 238.000000 (not (available image-o3)))
  )
  (:goal (and
    (sent image-h1)
    (picked sample-o2)
    (dropped sample-o2 place-o2-drop)
    (sent image-o3)
    (sent image-n4)
  ))
  (:metric minimize (total-time))
)
