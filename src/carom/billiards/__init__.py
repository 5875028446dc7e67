"""Single-particle billiards: one ball in a table, bounce by bounce, one orbit or thousands at once.

    from carom import billiards
    table = billiards.circle(radius=1.0)
    found = billiards.orbit(table, ((0.2, 0.1), (0.8, 0.3), 0.5), bounces=200)
    found.arc, found.phase, billiards.caustics(found)

- Tables: `circle`, `ellipse`, `stadium`, `polygon`, `strip`, `wedge`, `sinai`, `torus`, `sphere`, `box`, `cylinder` and others.
- Orbits: `orbit`, `final`, `reverse`; initial states from the invariant measure: `starts`.
- Analysis: `period`, `caustics`, `section`, `drift`, `escape`, `uniformity`.
- Transport: `mean_flight`, `diffusion`, `corridors`, `recurrence`; `escape(...).decay()`.
- Stability: `tangent_map`, `lyapunov`; periodic orbits: `periodic_orbits`, `continue_orbit`.
- Symbols: `itinerary`, `words`, `codes`.
- Rolling on surfaces: `roll`, `surfaces`.
"""

from carom.public.guard import attach_public as _attach_public

__getattr__, __dir__, __all__ = _attach_public(__name__, __file__)
