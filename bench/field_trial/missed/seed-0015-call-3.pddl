(define (problem planetary-3)
  (:domain planetary)
  (:objects
    here - location
    image-n3 - image
    image-o2 - image
    place-h1-drop - location
    place-n3 - location
    place-n4 - location
    place-n4-drop - location
    place-o2 - location
    sample-h1 - sample
    sample-n4 - sample
  )
  (:init
    (arm-at stow)
    (at here)
    (available image-o2)
    (camera-idle)
    (holding sample-h1)
    (picked sample-h1)
    (radio-idle)
    (sample-at sample-n4 place-n4)
    (target image-n3 place-n3)
    (target image-o2 place-o2)
    (= (battery) 151276.000000)
    (= (reserve) 20000.000000)
    (at 616.000000 (comm-window))
    (at 1816.000000 (not (comm-window)))
    (at 4516.000000 (comm-window))
    (at 5716.000000 (not (comm-window)))
    (at 8416.000000 (comm-window))
    (at 9616.000000 (not (comm-window)))
    (at 12316.000000 (comm-window))
    (at 13516.000000 (not (comm-window)))
    (at 485.000000 (available image-n3))
    (at 817.000000 (not (available image-n3)))
  )
  (:goal (and
    (dropped sample-h1 place-h1-drop)
    (sent image-o2)
    (sent image-n3)
    (picked sample-n4)
    (dropped sample-n4 place-n4-drop)
  ))
  (:metric minimize (total-time))
)
