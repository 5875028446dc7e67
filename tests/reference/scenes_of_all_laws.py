"""Random scenes of all shapes, with every law and every form of restitution at walls, floor and balls."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from reference.brute_force_scene import random_scene

import carom
from carom.laws.maw import CHI
from carom.laws.registry import laws
from carom.scene.scene import plain_model

__all__ = ["may_call_libm", "scene_of_all_laws", "with_infinities"]

FORMS: tuple[dict[str, Any], ...] = (
    {"form": "polynomial", "coefficients": [0.9, -0.1, 0.005]},
    {"form": "han-2005"},
    {"form": "power", "at_rest": 0.95, "speed": 0.1, "exponent": 0.25},
    {"form": "viscoelastic", "c": 0.2},
    {"form": "exponential", "at_rest": 0.95, "at_speed": 0.5, "speed": 2.0},
)
# Of random scenes: those in which walls have laws of their own, and restitutions that depend on the speed.
OWN_LAWS, OWN_FORMS = 0.5, 0.2


def scene_of_all_laws(seed: int) -> carom.Scene:
    """Return a scene; the same for the same seed. Every other one has other laws than ``random_scene`` gives it."""
    rng = np.random.default_rng([seed, 18])
    plain = random_scene(seed)
    if rng.random() > OWN_LAWS:
        return plain
    known = [law.name for law in laws().values() if law.kernel is not None and law.name != "conventional"]
    table = with_infinities(plain_model(plain))
    # (maw is tabulated for a range of stiffness_ratio (1 + 1/kappa)/2)
    shares = [(1 + 1 / ball.ball.kappa) / 2 for ball in plain.balls]
    stiff = 1.001 * max(CHI[0] / share for share in shares), 0.999 * min(CHI[1] / share for share in shares)
    for wall in table["walls"]:
        wall["law"] = str(rng.choice([*known, "maw", "stronge"]))
        if laws()[wall["law"]].last == "stiffness_ratio":
            wall["tangential_restitution"] = 0.0
            wall["stiffness_ratio"] = float(rng.uniform(*stiff))
        if rng.random() < OWN_FORMS:
            wall["restitution"] = FORMS[rng.integers(len(FORMS))]
    if rng.random() < OWN_FORMS:
        table["ball_contact"]["restitution"] = FORMS[rng.integers(len(FORMS))]
    if table["floor"] and rng.random() < OWN_FORMS:
        table["floor"]["restitution"] = FORMS[rng.integers(len(FORMS))]
    if rng.random() < OWN_FORMS:
        table["run"]["floor_contact"] = "after"
    return carom.Scene(**table)


def with_infinities(value: Any) -> Any:
    """Return JSON's data with infinities for the texts "inf" and "-inf"."""
    if isinstance(value, dict):
        return {key: with_infinities(one) for key, one in value.items()}
    if isinstance(value, list):
        return [with_infinities(one) for one in value]
    return {"inf": math.inf, "-inf": -math.inf}.get(value, value) if isinstance(value, str) else value


def may_call_libm(scene: carom.Scene) -> bool:
    """Return whether a run of a scene may call sin, cos, acos, atan2, exp, log or pow (docs/design.md)."""
    if {law.last for law in scene.laws} & {"stiffness_ratio"}:
        return True
    surfaces = [wall.restitution for wall in scene.walls] + [scene.ball_contact.restitution]
    surfaces += [scene.floor.restitution] if scene.floor else []
    if {getattr(one, "form", "constant") for one in surfaces} & {"power", "viscoelastic", "exponential"}:
        return True
    names = {law.name for law in scene.laws}
    at_once = scene.floor is not None and scene.run.floor_contact == "with"
    return "mathavan2010" in names or (at_once and "two-step" in names)
