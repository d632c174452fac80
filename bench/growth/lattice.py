#!/usr/bin/env python3
"""Writes arm.urdf and poses.yaml of missions/orbital for a satellite with any number of slots (R55):

  lattice.py --slots 12 --out missions/orbital/arm

The slots lie in two rows on both sides of a rail along x; slot s0 stands at its beginning on the left, s1 opposite, s2 next
to s0. Lengths in m, masses in kg, angles in rad."""

import argparse
import pathlib

SPACING_M = 0.8  # from slot to slot along the rail
ROW_M = 0.8  # from the rail to the middle of a slot
MODULE_M = (0.5, 0.5, 0.36)
DECK_M = -0.40  # height of the deck on which the modules stand; the rail's upper edge is 0
SHOULDER_M, UPPER_M, FORE_M, WRIST_M, TOOL_M = 0.30, 0.75, 0.70, 0.12, 0.18

LINK = """  <link name="{name}">
    <inertial><origin xyz="{centre}"/><mass value="{mass}"/>
      <inertia ixx="{ixx}" ixy="0" ixz="0" iyy="{iyy}" iyz="0" izz="{izz}"/></inertial>
    <collision><origin xyz="{middle}"{rpy}/><geometry>{shape}</geometry></collision>
  </link>
"""
JOINT = """  <joint name="{name}" type="{kind}">
    <parent link="{parent}"/><child link="{child}"/><origin xyz="{origin}"/><axis xyz="{axis}"/>
    <limit lower="{lower}" upper="{upper}" velocity="{speed}" acceleration="{acceleration}" effort="{effort}"/>
    <dynamics friction="{friction}" damping="{damping}"/>
  </joint>

"""
LEAN = ' rpy="0 1.5707963267948966 0"'


def link(name, mass, centre, inertia, middle, shape, rpy=""):
    return LINK.format(name=name, mass=mass, centre=centre, ixx=inertia[0], iyy=inertia[1], izz=inertia[2], middle=middle,
                       shape=shape, rpy=rpy)


def joint(name, parent, child, origin, axis, lower, upper, speed, acceleration, effort, friction, kind="revolute"):
    return JOINT.format(name=name, kind=kind, parent=parent, child=child, origin=origin, axis=axis, lower=lower, upper=upper,
                        speed=speed, acceleration=acceleration, effort=effort, friction=friction, damping=friction)


def box(*edges):
    return '<box size="{} {} {}"/>'.format(*(f"{edge:g}" for edge in edges))


def cylinder(radius, length):
    return f'<cylinder radius="{radius}" length="{length:g}"/>'


def urdf(slots):
    columns = (slots + 1) // 2
    rail = columns * SPACING_M
    text = f"""<?xml version="1.0"?>
<!-- An arm of six joints on a rail along a satellite with {slots} slots, in weightlessness. Written by bench/growth/lattice.py.
     Root link `body`: origin at the beginning of the rail's upper edge, x along the rail, z away from the satellite. With every
     joint at 0 the arm points along the rail; positive shoulder, elbow and wrist angles lean it down to the deck. -->
<robot name="rail_arm">
  <link name="body">
    <collision><origin xyz="{rail / 2:g} 0 {DECK_M - 0.5:g}"/><geometry>{box(rail + 0.4, 2.4, 1.0)}</geometry></collision>
    <collision><origin xyz="{rail / 2:g} 0 {DECK_M / 2:g}"/><geometry>{box(rail + 0.2, 0.16, -DECK_M)}</geometry></collision>
  </link>

"""
    text += link("carriage", 25, "0 0 0.1", (0.6, 0.6, 0.6), "0 0 0.09", box(0.3, 0.24, 0.12))
    text += joint("rail", "body", "carriage", "0 0 0", "1 0 0", 0, f"{rail:g}", 0.12, 0.04, 150, 2, "prismatic")
    text += link("turret", 9, "0 0 0.06", (0.05, 0.05, 0.04), "0 0 0.06", cylinder(0.08, 0.12))
    text += joint("azimuth", "carriage", "turret", "0 0 0.16", "0 0 1", -3.1, 3.1, 0.20, 0.10, 160, 1.5)
    text += link("upper_arm", 11, f"{UPPER_M / 2:g} 0 0", (0.03, 0.55, 0.55), f"{UPPER_M / 2:g} 0 0", cylinder(0.06, UPPER_M - 0.2), LEAN)
    text += joint("shoulder", "turret", "upper_arm", f"0 0 {SHOULDER_M - 0.16:g}", "0 1 0", -2.4, 1.2, 0.18, 0.10, 160, 1.5)
    text += link("forearm", 8, f"{FORE_M / 2:g} 0 0", (0.02, 0.34, 0.34), f"{FORE_M / 2:g} 0 0", cylinder(0.05, FORE_M - 0.2), LEAN)
    text += joint("elbow", "upper_arm", "forearm", f"{UPPER_M:g} 0 0", "0 1 0", -2.6, 2.6, 0.22, 0.12, 120, 1.2)
    text += link("wrist_roll_link", 3, "0.04 0 0", (0.006, 0.008, 0.008), "0.03 0 0", cylinder(0.045, 0.06), LEAN)
    text += joint("wrist_roll", "forearm", "wrist_roll_link", f"{FORE_M:g} 0 0", "1 0 0", -3.1, 3.1, 0.35, 0.25, 60, 0.6)
    text += link("wrist_pitch_link", 2.5, "0.05 0 0", (0.005, 0.006, 0.006), "0.05 0 0", cylinder(0.045, 0.06), LEAN)
    text += joint("wrist_pitch", "wrist_roll_link", "wrist_pitch_link", f"{WRIST_M:g} 0 0", "0 1 0", -2.2, 2.2, 0.35, 0.25, 60, 0.6)
    text += link("grapple", 3, "0.08 0 0", (0.008, 0.010, 0.010), f"{TOOL_M / 2:g} 0 0", cylinder(0.05, TOOL_M - 0.06), LEAN)
    text += joint("tool_roll", "wrist_pitch_link", "grapple", "0.12 0 0", "1 0 0", -3.1, 3.1, 0.40, 0.30, 40, 0.4)
    text += f"""  <link name="grapple_face"/>
  <joint name="grapple_face_fix" type="fixed">
    <parent link="grapple"/><child link="grapple_face"/><origin xyz="{TOOL_M:g} 0 0"/>
  </joint>
</robot>
"""
    return text


def place(slot):
    """Middle of the upper face of the module that stands there."""
    return (SPACING_M * (slot // 2 + 0.5), ROW_M * (1 if slot % 2 == 0 else -1), DECK_M + MODULE_M[2] + 0.02)


def poses(slots):
    rail = (slots + 1) // 2 * SPACING_M
    lines = ["# Places of the arm that plans may name, and what its motions cost. Base frame: arm.urdf's root link `body`.",
             "# A slot's pose is that of the tool on the upper face of a module that stands there. Written by bench/growth/lattice.py.",
             "tip: grapple_face", "tool_axis: [1, 0, 0]", "margin: 0.01",
             "motor: {gravity: [0, 0, 0], idle: 40.0, efficiency: 0.6, full_effort_loss: 120.0}",
             "search: {iterations: 3000, shortcuts: 40}", "poses:",
             f"  home: {{joints: [{rail / 2:g}, 0.0, -1.6, 1.6, 0.0, 1.5, 0.0]}}"]
    for slot in range(slots):
        x, y, z = place(slot)
        lines.append(f"  s{slot}: {{position: [{x:.2f}, {y:.2f}, {z:.2f}], approach: [0, 0, -1], "
                     f"module: [{', '.join(f'{edge:g}' for edge in MODULE_M)}]}}")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--slots", type=int, default=12)
    parser.add_argument("--out", type=pathlib.Path, required=True, help="folder for arm.urdf and poses.yaml")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    (arguments.out / "arm.urdf").write_text(urdf(arguments.slots))
    (arguments.out / "poses.yaml").write_text(poses(arguments.slots))


if __name__ == "__main__":
    main()
