(define (problem planetary-11)
  (:domain planetary)
  (:objects
    here - location
    image-h2 - image
    image-o3 - image
    place-h2 - location
    place-n4-drop - location
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
    (available image-h2)
    (available image-o3)
    (camera-idle)
    (comm-window)
    (holding sample-n4)
    (picked sample-n4)
    (radio-idle)
    (sample-at sample-n6 place-n6)
    (sample-at sample-n7 place-n7)
    (target image-h2 place-h2)
    (target image-o3 place-o3)
    (= (battery) 225139.000000)
    (= (reserve) 20000.000000)
    (at 577.835285 (not (comm-window)))
    (at 3277.835285 (comm-window))
    (at 4477.835285 (not (comm-window)))
    (at 7177.835285 (comm-window))
    (at 8377.835285 (not (comm-window)))
    (at 11077.835285 (comm-window))
    (at 12277.835285 (not (comm-window)))
  )
  (:goal (and
    (sent image-h2)
    (sent image-o3)
    (picked sample-n6)
    (dropped sample-n6 place-n6-drop)
    (picked sample-n7)
    (dropped sample-n7 place-n7-drop)
    (dropped sample-n4 place-n4-drop)
  ))
  (:metric minimize (total-time))
)
