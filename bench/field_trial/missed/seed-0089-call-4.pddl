(define (problem planetary-4)
  (:domain planetary)
  (:objects
    here - location
    image-h1 - image
    image-h2 - image
    image-n4 - image
    place-h1 - location
    place-h2 - location
    place-n4 - location
    place-n5 - location
    place-n6 - location
    place-n6-drop - location
    sample-n5 - sample
    sample-n6 - sample
    sample-o3 - sample
  )
  (:init
    (arm-at stow)
    (at here)
    (available image-h1)
    (camera-idle)
    (holding sample-o3)
    (picked sample-o3)
    (radio-idle)
    (sample-at sample-n5 place-n5)
    (sample-at sample-n6 place-n6)
    (target image-h1 place-h1)
    (target image-h2 place-h2)
    (target image-n4 place-n4)
    (= (battery) 801525.000000)
    (= (reserve) 20000.000000)
    (at 3518.000000 (comm-window))
    (at 4718.000000 (not (comm-window)))
    (at 7418.000000 (comm-window))
    (at 8618.000000 (not (comm-window)))
    (at 11318.000000 (comm-window))
    (at 12518.000000 (not (comm-window)))
    (at 502.000000 (available image-h2))
    (at 5525.000000 (not (available image-h2)))
    (at 4084.000000 (available image-n4))
    (at 4508.000000 (not (available image-n4)))
  )
  (:goal (and
    (sent image-h1)
    (sent image-h2)
    (sent image-n4)
    (picked sample-n5)
    (picked sample-n6)
    (dropped sample-n6 place-n6-drop)
  ))
  (:metric minimize (total-time))
)
