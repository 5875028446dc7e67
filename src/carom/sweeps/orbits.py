"""Sweeps over single-particle billiards: exponents and phase portraits over families of tables."""

from __future__ import annotations

import functools
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, PlainValidator
from pydantic_core.core_schema import ValidationInfo

from carom.billiards.orbits import orbit
from carom.billiards.sampling import starts
from carom.billiards.setup import default_ball, needs_surface
from carom.billiards.stability import lyapunov
from carom.billiards.table_records import ENDS
from carom.billiards.tables import Table, table
from carom.bodies import Ball, Disc, Surface
from carom.core.random import threefry
from carom.errors import shown, suggestion
from carom.laws.registry import laws
from carom.scene.figures import AnyFigure
from carom.scene.schema import Count, Friction, Model, Number, Share, Spring, refused
from carom.scene.wall import permitted_law
from carom.sweeps.outcomes import Outcome, require_outcomes
from carom.sweeps.points import PointByPoint

__all__ = ["OrbitCase", "Orbits"]

_SIZE = Number("a length in m, > 0", "m", least=0, above=True)
Extent = Annotated[float, BeforeValidator(_SIZE)]
WORD = 0xFFFFFFFF


def _orbit_law(value: Any, info: ValidationInfo) -> str:
    """Validate the law of a billiard's wall."""
    if isinstance(value, str) and ".py" in value:
        return permitted_law(value, info)
    known = [name for law in laws().values() if law.kernel is not None for name in (law.name, *law.aliases)]
    if value not in known:
        raise refused(f"one of {', '.join(known)}, or file.py:name", shown(value), suggestion(str(value), known))
    return str(value)


class OrbitCase(Model):
    """Orbits of a ball in a table, from initial states drawn from the invariant measure: the options of ``carom orbit``.

    Parameters
    ----------
    table : the figure, as :func:`carom.scene.figures.figure` takes it: a text such as "stadium:straight=2,radius=1", or a table of
        its fields; its sizes are swept by their paths, such as ``table.straight``
    bounds : "centre" or "surface" of the ball
    law : "no-slip", "mirror", "contact", "rolling"
    kappa : I/(m a^2), in the plane any above 0; default: 0.5, in space 0.4
    restitution, friction, tangential_restitution : of the law "contact"
    bounces : of every orbit; default: 1000
    orbits : how many, at every point; default: 1

    Examples
    --------
    >>> import carom
    >>> case = carom.sweeps.OrbitCase(table="sinai", law="mirror", bounces=500)
    >>> space = carom.Space(case, {"table.radius": [0.2, 0.4]})
    >>> found = carom.sweep(space, keep=["lyapunov.largest"]).run()["lyapunov.largest"].values
    >>> bool((found > 0.3).all())
    True
    """

    table: AnyFigure
    bounds: Literal["centre", "surface"] = "centre"
    law: Annotated[str, PlainValidator(_orbit_law)] = "no-slip"
    kappa: Annotated[float, BeforeValidator(Number("kappa = I/(m a^2), > 0", least=0, above=True))] | None = None
    ball_radius: Extent | None = None
    restitution: Share = 1.0
    friction: Friction = float("inf")
    tangential_restitution: Spring = 0.0
    bounces: Count = 1000
    orbits: Count = 1

    @functools.cached_property
    def made(self) -> Table:
        """The table."""
        return table(self.table, bounds=self.bounds)

    @property
    def options(self) -> dict[str, Any]:
        """Ball, law and surface, as :func:`carom.billiards.orbit` takes them."""
        usual = default_ball(self.made)
        make = Disc if self.made.dimension == 2 else Ball
        ball = make(self.ball_radius or usual.radius, 1.0, self.kappa or usual.kappa)
        surface = Surface(self.restitution, self.friction, self.tangential_restitution)
        return {"ball": ball, "law": self.law, "surface": surface if needs_surface(self.law) else None}


OUTCOMES = {
    "lyapunov.largest": Outcome("lyapunov.largest"),
    "lyapunov.error": Outcome("lyapunov.error"),
    "lyapunov.spectrum": Outcome("lyapunov.spectrum", dims={"exponent": tuple(range(4))}),
    "bounces.count": Outcome("bounces.count"),
    "ended": Outcome("ended", "i1", meanings=ENDS),
    "time": Outcome("time", units="s"),
}


class Orbits(PointByPoint):
    """A sweep's subject: orbits in tables."""

    kind = "orbit"

    def outcomes(self, names: tuple[str, ...]) -> list[Outcome]:
        """Return the outcomes of some names. CaromError with the nearest name."""
        require_outcomes(names, list(OUTCOMES))
        self._names = names
        return [OUTCOMES[name] for name in names]

    def compute(self, model: OrbitCase, seed: int, index: int) -> dict[str, Any]:
        """Return the outcomes of a point: means over its orbits, the initial states drawn for its index."""
        options = model.options
        number = threefry(seed, 0, index & WORD, index >> 32)[0]
        begin = starts(model.made, model.orbits, number, ball=options["ball"], law=options["law"])
        found: dict[str, Any] = {}
        if any(name.startswith("lyapunov") for name in self._names):
            spectrum = lyapunov(model.made, begin, model.bounces, **options)
            largest = spectrum.per_bounce[..., 0]
            found["lyapunov.largest"] = np.nanmean(largest) if np.isfinite(largest).any() else np.nan
            spread = (
                np.nanstd(largest) / np.sqrt(max(model.orbits - 1, 1))
                if model.orbits > 1
                else spectrum.error[..., 0].max()
            )
            found["lyapunov.error"] = spread
            found["lyapunov.spectrum"] = spectrum.per_bounce.reshape(model.orbits, -1)[:, :4].mean(axis=0)
        if not all(name.startswith("lyapunov") for name in self._names):
            run = orbit(model.made, begin, model.bounces, **options)
            found["bounces.count"] = np.mean(run.count)
            found["ended"] = np.bincount(np.ravel(run.ending)).argmax()
            found["time"] = np.mean(run.last[..., 0])
        return found
