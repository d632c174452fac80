(define (problem planetary-2)
  (:domain planetary)
  (:objects
    here - location
    image-h2 - image
    image-o4 - image
    place-h1 - location
    place-h1-drop - location
    place-h2 - location
    place-o4 - location
    sample-h1 - sample
  )
  (:init
    (arm-at stow)
    (at here)
    (available image-h2)
    (available image-o4)
    (camera-idle)
    (gripper-empty)
    (radio-idle)
    (sample-at sample-h1 place-h1)
    (target image-h2 place-h2)
    (target image-o4 place-o4)
    (= (battery) 284905.000000)
    (= (reserve) 20000.000000)
    (at 1424.498500 (comm-window))
    (at 2624.498500 (not (comm-window)))
    (at 5324.498500 (comm-window))
    (at 6524.498500 (not (comm-window)))
    (at 9224.498500 (comm-window))
    (at 10424.498500 (not (comm-window)))
    (at 13124.498500 (comm-window))
    (at 14324.498500 (not (comm-window)))
  )
  (:goal (and
    (picked sample-h1)
    (dropped sample-h1 place-h1-drop)
    (sent image-h2)
    (sent image-o4)
  ))
  (:metric minimize (total-time))
)
