"""One ball in a table, for mathematicians: no-slip and other billiards, orbit by orbit or thousands at once.

    from carom import orbits
    table = orbits.circle(radius=1.0)
    found = orbits.orbit(table, ((0.2, 0.1), (0.8, 0.3), 0.5), bounces=200)
    found.arc, found.phase, orbits.caustics(found)

Tables, then verbs: `orbit`, `final`, `starts`, `reverse`; `period`, `caustics`, `section`, `drift`, `escape`,
`uniformity`; `tangent_map`, `lyapunov`.
"""

from carom.orbits.arrays import ENDS
from carom.orbits.result import Orbit
from carom.orbits.setup import LAWS, Start
from carom.orbits.tables import (
    Table,
    box,
    circle,
    cylinder,
    ellipse,
    periodic_strip,
    plates,
    polygon,
    rectangle,
    regular,
    sinai,
    sphere,
    stadium,
    strip,
    torus,
    wedge,
)
from carom.orbits.verbs import final, orbit, reverse, starts

__all__ = [
    "ENDS",
    "LAWS",
    "Orbit",
    "Start",
    "Table",
    "box",
    "circle",
    "cylinder",
    "ellipse",
    "final",
    "orbit",
    "periodic_strip",
    "plates",
    "polygon",
    "rectangle",
    "regular",
    "reverse",
    "sinai",
    "sphere",
    "stadium",
    "starts",
    "strip",
    "torus",
    "wedge",
]
