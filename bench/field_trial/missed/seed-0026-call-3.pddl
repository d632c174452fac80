(define (problem planetary-3)
  (:domain planetary)
  (:objects
    here - location
    image-h1 - image
    image-o2 - image
    place-h1 - location
    place-n3 - location
    place-n3-drop - location
    place-n4 - location
    place-o2 - location
    sample-n3 - sample
    sample-n4 - sample
  )
  (:init
    (arm-at stow)
    (at here)
    (available image-h1)
    (camera-idle)
    (gripper-empty)
    (have-image image-h1)
    (radio-idle)
    (sample-at sample-n3 place-n3)
    (sample-at sample-n4 place-n4)
    (target image-h1 place-h1)
    (target image-o2 place-o2)
    (= (battery) 169967.000000)
    (= (reserve) 20000.000000)
    (at 596.498500 (comm-window))
    (at 1796.498500 (not (comm-window)))
    (at 4496.498500 (comm-window))
    (at 5696.498500 (not (comm-window)))
    (at 8396.498500 (comm-window))
    (at 9596.498500 (not (comm-window)))
    (at 12296.498500 (comm-window))
    (at 13496.498500 (not (comm-window)))
    (at 850.498500 (available image-o2))
    (at 968.498500 (not (available image-o2)))
  )
  (:goal (and
    (sent image-h1)
    (sent image-o2)
    (picked sample-n3)
    (dropped sample-n3 place-n3-drop)
    (picked sample-n4)
  ))
  (:metric minimize (total-time))
)
