"""To which law does a contact of finite stiffness tend, as the floor grows stiffer (or softer) than the wall?

Prints tables in Markdown: the speed off the wall along x, and the greatest difference of any component of velocity
and spin from the law, for a ball of mass 1 and radius 1. The integration is the tests' own (``tests/reference/stiff_springs.py``).

    python campaigns/stiff_limit.py
"""

import math
from collections.abc import Sequence

import numpy as np
from campaign import campaign
from reference.stiff_springs import spring_contact

import carom

CUSHION = (math.sqrt(0.84), 0.0, -0.4)
UPRIGHT = (1.0, 0.0, 0.0)
SHOTS = {
    "rolling, upright wall (lifted)": ((-1.0, 1.0, 0.0), (-1.0, -1.0, 0.0), UPRIGHT),
    "backspin, upright wall (pressed)": ((-1.0, 0.5, 0.0), (-0.5, 2.0, 0.3), UPRIGHT),
    "rolling, cushion at 7/5 (pressed)": ((-1.0, 1.0, 0.0), (-1.0, -1.0, 0.0), CUSHION),
    "stunned with side spin, cushion (pressed)": ((-1.0, 0.5, 0.0), (0.0, 0.0, 1.0), CUSHION),
}
FRICTIONS = ((0.05, 0.2), (0.2, 0.2), (0.5, 0.2), (0.2, 0.8), (1.0, 0.2), (5.0, 0.2))
RATIOS = (1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6)


def law(shot, wall_mu, floor_mu, floor_contact):
    velocity, spin, normal = shot
    after = carom.two_step(
        carom.Ball(radius=1.0, mass=1.0, inertia=0.4),
        carom.State(velocity=velocity, spin=spin),
        wall=carom.Surface(restitution=0.85, friction=wall_mu),
        floor=carom.Surface(restitution=0.0, friction=floor_mu),
        normal=normal,
        floor_contact=floor_contact,
    ).after_wall
    return np.concatenate([after.velocity, after.spin])


def main(words: Sequence[str] | None = None) -> None:
    """A table a shot."""
    with campaign("stiff_limit", __doc__, words) as run:
        for name, shot in SHOTS.items():
            if not run.wants(name, SHOTS):
                continue
            run.say(f"{name}: v = {shot[0]}, spin = {shot[1]}, e = 0.85, damped floor")
            run.say("| mu wall | mu floor | law: with | law: after |", " | ".join(f"r = {r:g}" for r in RATIOS), "|")
            for wall_mu, floor_mu in FRICTIONS[:1] if run.small else FRICTIONS:
                with_floor, alone = (law(shot, wall_mu, floor_mu, kind) for kind in ("with", "after"))
                cells = []
                for ratio in RATIOS[:4] if run.small else RATIOS:
                    out = spring_contact(
                        0.4, *shot, wall_e=0.85, wall_mu=wall_mu, floor_mu=floor_mu, ratio=ratio, floor_damping=3.0
                    ).state
                    nearer = with_floor if ratio >= 1.0 else alone
                    cells.append(f"{out[0]:.5f} ({np.max(np.abs(out - nearer)):.0e})")
                run.say(f"| {wall_mu} | {floor_mu} | {with_floor[0]:.5f} | {alone[0]:.5f} |", " | ".join(cells), "|")
        run.say(
            "In brackets: the distance from the law, 'with' the floor for r >= 1, wall alone and then floor for r < 1."
        )


if __name__ == "__main__":
    main()
