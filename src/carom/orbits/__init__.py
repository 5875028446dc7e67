"""One ball in a table, for mathematicians: no-slip and other billiards, orbit by orbit or thousands at once.

    from carom import orbits
    table = orbits.circle(radius=1.0)
    found = orbits.orbit(table, ((0.2, 0.1), (0.8, 0.3), 0.5), bounces=200)
    found.arc, found.phase, orbits.caustics(found)

Tables, then verbs: `orbit`, `final`, `starts`, `reverse`; `period`, `caustics`, `section`, `drift`, `escape`,
`uniformity`; `tangent_map`, `lyapunov`.
"""

from carom.orbits.analysis import (
    Caustics,
    Drift,
    Escape,
    Section,
    Uniformity,
    caustics,
    drift,
    escape,
    period,
    section,
    uniformity,
)
from carom.orbits.arrays import ENDS
from carom.orbits.draw import starts
from carom.orbits.result import Orbit
from carom.orbits.setup import LAWS, Start
from carom.orbits.solids import box, cylinder, plates, sphere
from carom.orbits.stability import Lyapunov, TangentMap, lyapunov, tangent_map
from carom.orbits.tables import (
    Table,
    circle,
    ellipse,
    periodic_strip,
    polygon,
    rectangle,
    regular,
    sinai,
    stadium,
    strip,
    torus,
    under,
    wedge,
)
from carom.orbits.verbs import final, orbit, reverse

__all__ = [
    "ENDS",
    "LAWS",
    "Caustics",
    "Drift",
    "Escape",
    "Lyapunov",
    "Orbit",
    "Section",
    "Start",
    "Table",
    "TangentMap",
    "Uniformity",
    "box",
    "caustics",
    "circle",
    "cylinder",
    "drift",
    "ellipse",
    "escape",
    "final",
    "lyapunov",
    "orbit",
    "period",
    "periodic_strip",
    "plates",
    "polygon",
    "rectangle",
    "regular",
    "reverse",
    "section",
    "sinai",
    "sphere",
    "stadium",
    "starts",
    "strip",
    "tangent_map",
    "torus",
    "under",
    "uniformity",
    "wedge",
]
