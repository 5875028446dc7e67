"""carom: a ball meets a wall; what does it do next, and which law of impact is right?

    import carom
    ball = carom.Ball(radius=0.02625, mass=0.1406)
    hit = carom.two_step(ball, carom.rolling(ball, velocity=(-1.0, 1.0)))
    hit.reflection_angle, hit.flight.height

Names are imported when first used, so that ``import carom`` is quick.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"

if TYPE_CHECKING:
    from carom.ball import Ball as Ball
    from carom.ball import Disc as Disc
    from carom.cards import CARDS as CARDS
    from carom.comparison import Comparison as Comparison
    from carom.comparison import Verdict as Verdict
    from carom.comparison import compare as compare
    from carom.comparison import incoming as incoming
    from carom.errors import CaromError as CaromError
    from carom.law import LAWS as LAWS
    from carom.law import Law as Law
    from carom.law import Meeting as Meeting
    from carom.law import wall_law as wall_law
    from carom.laws.card import Card as Card
    from carom.pairs import Collision as Collision
    from carom.pairs import Scattering as Scattering
    from carom.pairs import collide as collide
    from carom.pairs import domenech as domenech
    from carom.reflections import conventional as conventional
    from carom.reflections import mirror as mirror
    from carom.reflections import no_slip as no_slip
    from carom.scene.balls import SceneBall as SceneBall
    from carom.scene.model import BallContact as BallContact
    from carom.scene.model import Floor as Floor
    from carom.scene.model import Run as Run
    from carom.scene.model import Scene as Scene
    from carom.scene.toml import load_scene as load_scene
    from carom.scene.toml import new_scene as new_scene
    from carom.simulation import ManyRuns as ManyRuns
    from carom.simulation import simulate as simulate
    from carom.simulation import simulate_many as simulate_many
    from carom.state import State as State
    from carom.state import kinetic_energy as kinetic_energy
    from carom.state import rolling as rolling
    from carom.state import slip as slip
    from carom.storage import load_trajectory as load_trajectory
    from carom.surface import Surface as Surface
    from carom.trajectory import Event as Event
    from carom.trajectory import Events as Events
    from carom.trajectory import Trajectory as Trajectory
    from carom.verbs import (
        Flight as Flight,
    )
    from carom.verbs import (
        Impact as Impact,
    )
    from carom.verbs import (
        Settled as Settled,
    )
    from carom.verbs import (
        TwoStep as TwoStep,
    )
    from carom.verbs import (
        impact as impact,
    )
    from carom.verbs import (
        impact_into as impact_into,
    )
    from carom.verbs import (
        settle as settle,
    )
    from carom.verbs import (
        two_step as two_step,
    )
    from carom.verbs import (
        two_step_into as two_step_into,
    )


HOME = {
    "Ball": "ball", "Disc": "ball", "CaromError": "errors",
    "State": "state", "kinetic_energy": "state", "rolling": "state", "slip": "state", "Surface": "surface",
    "Flight": "verbs", "Impact": "verbs", "TwoStep": "verbs", "impact": "verbs", "impact_into": "verbs",
    "Settled": "verbs", "settle": "verbs", "two_step": "verbs", "two_step_into": "verbs",
    "conventional": "reflections", "mirror": "reflections", "no_slip": "reflections",
    "Collision": "pairs", "Scattering": "pairs", "collide": "pairs", "domenech": "pairs",
    "Comparison": "comparison", "Verdict": "comparison", "compare": "comparison", "incoming": "comparison",
    "SceneBall": "scene.balls", "BallContact": "scene.model", "Floor": "scene.model", "Run": "scene.model",
    "Scene": "scene.model", "load_scene": "scene.toml", "new_scene": "scene.toml",
    "ManyRuns": "simulation", "simulate": "simulation", "simulate_many": "simulation",
    "Event": "trajectory", "Events": "trajectory", "Trajectory": "trajectory", "load_trajectory": "storage",
    "CARDS": "cards", "LAWS": "law", "Law": "law", "Meeting": "law", "wall_law": "law", "Card": "laws.card",
}  # fmt: skip
ROOMS = ("compiled", "datasets", "derive", "euler", "gas", "kernel", "laws", "orbits", "plot", "predict", "scene")

__all__ = [*HOME, *ROOMS]  # noqa: PLE0604


def __getattr__(name: str) -> Any:
    if name in HOME:
        value = getattr(importlib.import_module(f"carom.{HOME[name]}"), name)
        globals()[name] = value
        return value
    if name in ROOMS:
        return importlib.import_module(f"carom.{name}")
    raise AttributeError(f"module 'carom' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
