; An arm on a rail rearranges the modules of a satellite (Stellar, section 3.2 and figure 2; R38, R55). Modules sit
; in slots of a lattice. This file never changes during a mission (R8). Times are in seconds, energy is in joules.
; The arm finds a slot precisely only in light, and only for as long as it stays there. A module that the tool places is
; latched by the slot. Nothing is carried but in the tool, and one module at a time.
(define (domain orbital)
  (:requirements :typing :durative-actions :numeric-fluents :timed-initial-literals :derived-predicates :adl)

  (:types
    slot module role mode - object
    socket - slot)                   ; a slot that can take a module; the arm's other poses are slots without a socket

  (:modules
    (:module ef_orbitalrarmplanner
      (:function (ra_move_dur ?from ?to - slot))
      (:function (ra_move_energy ?to - slot))
      (:function (ra_carry_dur ?from ?to - slot))
      (:function (ra_carry_energy ?to - slot))))

  (:predicates
    (arm-at ?s - slot)
    (localized ?s - slot)            ; the arm knows where it is to the millimetre
    (tool-ready)
    (holding ?m - module)
    (loaded)                         ; it holds some module
    (at-slot ?m - module ?s - slot)  ; it lies there, latched or not
    (installed ?m - module ?s - slot); it is latched there, and its plugs are connected
    (free ?s - slot)
    (works ?m - module)
    (damaged ?m - module)
    (array-ready)
    (sunlit)                         ; the sun shines on the satellite

    ; What never changes in a mission.
    (serves ?m - module ?r - role)   ; what the module is for
    (seat ?m - module ?s - slot)     ; where it does so
    (needs ?c - mode ?r - role ?s - slot)  ; in that mode a module with that role works there

    ; What goals ask for.
    (wanted ?m - module ?s - slot)
    (allowed ?m - module ?s - slot)  ; the window in which it is wanted there, if it has one, is open
    (to-replace ?m - module)
    (replacing ?m - module)          ; the window in which it is to be replaced, if it has one, is open
    (to-configure ?c - mode)
    (configuring ?c - mode)          ; likewise

    ; What was so when the plan was asked for, and says what may be of use to it.
    (arm-first ?s - slot)
    (held-first ?m - module)
    (lay-first ?m - module ?s - slot)
    (free-first ?s - slot)
    (asked ?r - role ?s - slot)
    (fits ?m - module ?s - slot)
    (aim ?m - module ?s - slot)
    (target ?s - slot)
    (mover ?m - module)
    (bound ?m - module)
    (of-use ?s - slot)
    (leave ?s - slot)
    (may-lie ?m - module ?s - slot))

  (:functions (battery) (reserve) (capacity))

  ; A module may go to where a goal wants it, and to where a goal asks for a role that it has: in place of one that is to
  ; be replaced, or because a mode needs it there.
  (:derived (asked ?r - role ?s - slot)
    (or (exists (?d - module) (and (to-replace ?d) (seat ?d ?s) (serves ?d ?r)))
        (exists (?c - mode) (and (to-configure ?c) (needs ?c ?r ?s)))))
  (:derived (fits ?m - module ?s - slot) (exists (?r - role) (and (asked ?r ?s) (serves ?m ?r))))
  (:derived (aim ?m - module ?s - slot) (or (wanted ?m ?s) (fits ?m ?s)))
  (:derived (target ?s - slot) (or (exists (?m - module) (wanted ?m ?s)) (exists (?r - role) (asked ?r ?s))))
  ; These alone are moved: what has an aim, what lies in another's way, and what the tool holds.
  (:derived (mover ?m - module)
    (or (held-first ?m)
        (exists (?s - slot) (aim ?m ?s))
        (exists (?s - slot) (and (lay-first ?m ?s) (target ?s)))))
  (:derived (bound ?m - module) (exists (?s - slot) (wanted ?m ?s)))
  (:derived (of-use ?s - slot)
    (or (target ?s) (free-first ?s) (exists (?m - module) (and (mover ?m) (lay-first ?m ?s)))))
  (:derived (leave ?s - slot) (or (of-use ?s) (arm-first ?s)))
  ; A module that a goal wants somewhere is parked in slots that were free; any other one wherever there will be room.
  (:derived (may-lie ?m - module ?s - slot)
    (or (wanted ?m ?s)
        (and (mover ?m) (free-first ?s))
        (and (mover ?m) (not (bound ?m)) (of-use ?s))))

  (:durative-action localize
    :parameters (?s - socket)
    :duration (= ?duration 30)
    :condition (and
      (at start (of-use ?s))
      (at start (tool-ready))
      (over all (arm-at ?s))
      (over all (sunlit))
      (at start (>= (battery) (+ (reserve) 3000))))
    :effect (and
      (at start (not (tool-ready)))
      (at start (decrease (battery) 3000))
      (at end (tool-ready))
      (at end (localized ?s))))

  (:durative-action move
    :parameters (?from - slot ?to - socket)
    :duration (= ?duration (ra_move_dur ?from ?to))
    :condition (and
      (at start (leave ?from))
      (at start (of-use ?to))
      (at start (not (= ?from ?to)))
      (at start (arm-at ?from))
      (at start (tool-ready))
      (over all (not (loaded)))
      (at start (>= (battery) (+ (reserve) (ra_move_energy ?to)))))
    :effect (and
      (at start (not (arm-at ?from)))
      (at start (not (localized ?from)))
      (at start (decrease (battery) (ra_move_energy ?to)))
      (at end (arm-at ?to))))

  (:durative-action grasp
    :parameters (?m - module ?s - socket)
    :duration (= ?duration 45)
    :condition (and
      (at start (mover ?m))
      (at start (at-slot ?m ?s))
      (at start (not (loaded)))
      (at start (tool-ready))
      (at start (localized ?s))
      (over all (arm-at ?s))
      (at start (>= (battery) (+ (reserve) 4500))))
    :effect (and
      (at start (not (tool-ready)))
      (at start (not (installed ?m ?s)))
      (at start (decrease (battery) 4500))
      (at end (not (at-slot ?m ?s)))
      (at end (free ?s))
      (at end (holding ?m))
      (at end (loaded))
      (at end (tool-ready))))

  (:durative-action carry
    :parameters (?from - slot ?to - socket)
    :duration (= ?duration (ra_carry_dur ?from ?to))
    :condition (and
      (at start (leave ?from))
      (at start (of-use ?to))
      (at start (not (= ?from ?to)))
      (at start (arm-at ?from))
      (at start (tool-ready))
      (at start (loaded))
      (at start (>= (battery) (+ (reserve) (ra_carry_energy ?to)))))
    :effect (and
      (at start (not (arm-at ?from)))
      (at start (not (localized ?from)))
      (at start (decrease (battery) (ra_carry_energy ?to)))
      (at end (arm-at ?to))))

  (:durative-action place
    :parameters (?m - module ?s - socket)
    :duration (= ?duration 60)
    :condition (and
      (at start (may-lie ?m ?s))
      (at start (holding ?m))
      (at start (free ?s))
      (at start (tool-ready))
      (at start (localized ?s))
      (over all (arm-at ?s))
      (over all (or (not (wanted ?m ?s)) (allowed ?m ?s)))
      (over all
        (forall (?d - module ?r - role)
          (or (not (to-replace ?d)) (not (seat ?d ?s)) (not (serves ?d ?r)) (not (serves ?m ?r)) (replacing ?d))))
      (over all
        (forall (?c - mode ?r - role)
          (or (not (to-configure ?c)) (not (needs ?c ?r ?s)) (not (serves ?m ?r)) (configuring ?c))))
      (at start (>= (battery) (+ (reserve) 6000))))
    :effect (and
      (at start (not (tool-ready)))
      (at start (not (free ?s)))
      (at start (decrease (battery) 6000))
      (at end (not (holding ?m)))
      (at end (not (loaded)))
      (at end (at-slot ?m ?s))
      (at end (installed ?m ?s))
      (at end (tool-ready))))

  ; The arm rests while the arrays fill the battery.
  (:durative-action charge
    :parameters ()
    :duration (= ?duration 300)
    :condition (and
      (at start (tool-ready))
      (at start (array-ready))
      (over all (sunlit))
      (at start (<= (+ (battery) 30000) (capacity))))
    :effect (and
      (at start (not (tool-ready)))
      (at start (not (array-ready)))
      (at end (increase (battery) 30000))
      (at end (tool-ready))
      (at end (array-ready))))
)
