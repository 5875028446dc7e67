"""The frictionless mirror: the wall returns the normal velocity, and nothing else happens, at the wall or on the floor."""

from __future__ import annotations

from carom.kernel import Vec, kernel
from carom.laws.card import Card
from carom.laws.contact import contact, slip_velocity

__all__ = ["CARD", "mirror_reflection"]

CARD = Card(
    name="mirror",
    summary="A frictionless world: the normal velocity comes back e times, spin and the rest go on as they were.",
    assumptions=("no friction at the wall, so the spin never matters", "no friction on the floor, before or after"),
    valid="Point billiards, ice, a first guess. A real ball rubs: on a rough floor its spin bends the path after the wall.",
    equations="(19)",
    citation="The law of reflection; the paper's closing remark that it is true only in a frictionless world.",
)


@kernel
def mirror_reflection(v: Vec, w: Vec, n: Vec, a: float, e: float) -> tuple[Vec, Vec, Vec]:
    """Velocity, spin, impulse per mass: one contact with mu = 0."""
    un, ut = slip_velocity(v, w, n, a)
    pn, _f, _required, _regime = contact(un, ut, 1, 1, e, 0, 0)
    j = (pn * n[0], pn * n[1], pn * n[2])
    return (v[0] + j[0], v[1] + j[1], v[2] + j[2]), w, j
