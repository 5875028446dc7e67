"""A fitted law as a surface, as a law, and as a scene that simulates."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from carom.bodies import Surface
from carom.core.jit.kernel import Vec, kernel
from carom.errors import CaromError, Fault
from carom.fitting.kernels import LEAST_STIFFNESS, of_impact
from carom.fitting.model import model_of
from carom.fitting.parameters import ALONG_FORMS, INDEX, PLACES, RESTITUTION_FORMS
from carom.fitting.smooth import parameter_at
from carom.laws.law import CALLED_WALL, Card, Law
from carom.laws.registry import law_named
from carom.scene import Floor, Plane, Run, Scene, SceneBall, Table
from carom.scene.paths import replaced

__all__ = ["law_of", "scene_of", "surface_of"]

ON_SURFACE = {"restitution": 0.0, "friction": 0.0, "tangential_restitution": -1.0}  # with the least value of a surface
TABLE = (2.84, 1.42)  # m, of a scene for balls on a table: a carom table's


def surface_of(fit: Any, x: Any) -> Surface:
    """Return the fitted surface at impacts x (N, 3); numbers where no parameter depends on the impact."""
    model = model_of(fit.law, fit.problem)
    found: dict[str, Any] = {}
    for name, least in ON_SURFACE.items():
        values = np.maximum(parameter_at(name, model, fit.numbers, x), least)
        found[name] = float(values[0]) if (values == values[0]).all() else values
    return Surface(**found)


def law_of(fit: Any) -> Law:
    """Return the law with its friction, and tangential restitution or stiffness ratio, as fitted functions of the impact.

    A wall's restitution stays as the scene has it; what it has for the others is not read.
    """
    law, code = law_named(fit.law.name), model_of(fit.law, fit.problem).form // RESTITUTION_FORMS
    if not code:
        return law
    if law.kernel is None or law.last not in PLACES:
        raise CaromError(
            Fault("", f"law {law.name}", "a law of one contact, whose parameters depend on the impact", "another")
        )
    first, base, stiff = code % ALONG_FORMS, law.kernel, law.last == "stiffness_ratio"
    last, least = code // ALONG_FORMS, LEAST_STIFFNESS if stiff else -1.0
    mu0, mu1, mu2 = (float(fit.numbers[i]) for i in PLACES["friction"])
    p0, p1, p2 = (float(fit.numbers[i]) for i in PLACES[law.last])
    most = 100.0 if stiff else 1.0

    @kernel
    def of_fit(v: Vec, w: Vec, n: Vec, a: float, kappa: float, e: float, _mu: float, _last: float) -> tuple[Vec, Vec]:
        friction = max(of_impact(first, (mu0, mu1, mu2), v, w, n, a), 0 * a)
        along = min(max(of_impact(last, (p0, p1, p2), v, w, n, a), least + 0 * a), most + 0 * a)
        return base(v, w, n, a, kappa, e, friction, along)

    words = ", ".join(f"{name} {form['form']} in {form['variable']}" for name, form in fit.forms.items())
    card = Card(
        f"{law.name}-fitted", f"{law.name} with {words}.", (), "The impacts of the fit.", "carom.fitting", "carom"
    )
    return replace(law, card=card, kernel=of_fit, response=CALLED_WALL, pinned={})


def scene_of(fit: Any) -> Scene:
    """Return a scene with the fitted wall, the ball, and the median impact of the rows; gravity acts on balls on a table alone."""
    setting, law = fit.problem.setting, fit.law
    if fit.restitution is None:
        raise CaromError(
            Fault("", "restitution", "a form that scenes have", "line", "fit polynomial or exponential instead")
        )
    a = setting.radius
    v_n, v_t, spin = (float(x) for x in np.nan_to_num(np.nanmedian(fit.problem.x, axis=0)))
    wall: dict[str, Any] = {"restitution": fit.restitution, "friction": float(fit.numbers[INDEX["friction"]]),
                            "tangential_restitution": float(fit.numbers[INDEX["tangential_restitution"]]),
                            "stiffness_ratio": float(fit.numbers[INDEX["stiffness_ratio"]])}  # fmt: skip
    # (of a law that holds the restitution fixed in scenes, the fit is of the contact that it is a case of)
    name = "contact" if "restitution" in law_named(law.name).pinned else law.name
    run = Run(law=name if not fit.forms else law_of(fit), duration=1.0)
    ball: dict[str, Any] = {"radius": a, "mass": 1.0, "inertia": setting.kappa}
    if law.kind == "planar":
        at = (a + 0.2 * v_n, 0.0, 0.0)
        one = SceneBall(position=at, velocity=(-v_n, v_t, 0.0), spin=(0.0, 0.0, spin), **ball)
        plane = Plane(point=(0.0, 0.0, 0.0), normal=(1.0, 0.0, 0.0), **wall)
        return Scene(gravity=(0.0, 0.0, 0.0), walls=(plane,), balls=(one,), run=run)
    height = setting.contact_height or 1.0
    nose = None if law.upright or height == 1 else height * a
    rolls = {"rolling": True, "spin_z": spin} if setting.roll == 1 else {"spin": (0.0, 0.0, spin)}
    one = SceneBall(position=(0.3 - TABLE[0] / 2, 0.0), velocity=(-v_n, v_t), **rolls, **ball)
    table = Table(length=TABLE[0], width=TABLE[1], center=(0.0, 0.0), nose_height=nose, **wall)
    mu = float(fit.numbers[INDEX["floor_friction"]])
    run = replaced(run, {"law": law.engine.law, "floor_contact": law.engine.floor_contact}) if law.engine else run
    return Scene(floor=Floor(friction=mu, restitution=setting.floor_restitution), walls=(table,), balls=(one,), run=run)
