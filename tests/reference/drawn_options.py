"""Models drawn from the schema itself: every class, every field, every choice of the scenes, the gases and the subjects of sweeps.

A field is drawn by its type and its bounds, so that a field, a shape or a form that is added is drawn, too. What a draw gives may
be refused (a ball in a wall); it is then drawn again.
"""

from __future__ import annotations

import math
import types
from typing import Annotated, Any, Literal, Union, get_args, get_origin

import numpy as np

import carom
from carom.gas import GasScene
from carom.gas.containers import CONTAINERS
from carom.gas.drives import Thermostat
from carom.laws.registry import laws, laws_of_pairs
from carom.scene.figures.figure import FIGURES, CellFigure, Figure, PlaneFigure
from carom.scene.presets import presets
from carom.scene.schema import Components, Model, Number, Whole
from carom.scene.shapes import SHAPES
from carom.sweeps import ImpactCase, OrbitCase

__all__ = [
    "FORMULAS", "fields_of", "laws_of_walls", "models_of", "random_gas", "random_impact", "random_orbit_case", "random_scene",
]  # fmt: skip

Rng = np.random.Generator
FORMULAS: tuple[dict[str, Any], ...] = (
    {"r": "1 + 0.1*cos(3*theta)"}, {"x": "1.2*cos(s)", "y": "sin(s) + 0.1*cos(2*s)"},
    {"points": [[1.0, 0.0], [0.2, 1.1], [-1.0, 0.1], [0.0, -0.9]]},
)  # fmt: skip
# Where bounds alone would give what is no scene: numbers of the usual size, by the name of the field.
USUAL: dict[str, tuple[float, float]] = {
    "radius": (0.02, 0.04), "mass": (0.05, 0.3), "speed": (0.5, 3.0), "young": (1e9, 1e10), "exponent": (0.1, 0.5),
    "friction": (0.0, 0.5), "floor_friction": (0.0, 0.5), "at_rest": (0.6, 1.0), "at_speed": (0.1, 0.5), "c": (0.05, 0.3),
    "end_mass": (0.005, 0.01), "azimuth": (-180, 180), "elevation": (0, 40), "rolling_resistance": (0, 0.05),
    "spin_friction": (0, 0.05), "rolling_drag": (0, 0.02), "spin_damping": (0, 1), "spin_drag": (0, 5), "duration": (0.5, 2),
    "contact_time": (0, 2e-3), "yield_time": (0, 1e-3), "stiffness_ratio": (0.8, 1.2), "spin_z": (-20, 20), "angle": (-90, 90),
    "temperature": (0.5, 2), "temperature_rotational": (0.5, 2), "rate": (0.1, 1), "density": (0.5, 2), "gravity": (0, 10),
    "contact_height": (0.9, 1.2), "kappa": (0.2, 0.5), "ball_radius": (0.02, 0.04), "from_time": (0.1, 0.5), "sigma": (0.05, 0.1),
}  # fmt: skip


def models_of(*roots: type[Model]) -> list[type[Model]]:
    """Return all models that some models hold, by their types; of bases the classes that have a tag."""
    found: dict[type[Model], None] = {}
    left: list[Any] = list(roots)
    while left:
        one = left.pop()
        if isinstance(one, type) and issubclass(one, Model):
            if one not in found:
                found[one] = None
                left += [info.annotation for info in one.model_fields.values()]
                left += FIGURES.values() if one is Figure else ()
        else:
            left += get_args(one)
    return list(found)


def fields_of(*roots: type[Model]) -> list[tuple[type[Model], str]]:
    """Return every field of every model."""
    return [(one, name) for one in models_of(*roots) for name in one.model_fields]


def laws_of_walls() -> list[str]:
    """Return the laws that a wall may have."""
    return [law.name for law in laws().values() if law.kernel is not None]


# --- a value by its type -------------------------------------------------------------------------------------------


def value_of(rng: Rng, name: str, annotation: Any, metadata: list[Any]) -> Any:
    """Return a value for a field, by its type and the validators beside it; None where there is none for it."""
    while get_origin(annotation) is Annotated:
        annotation, *more = get_args(annotation)
        metadata = [*metadata, *more]
    checks = [check for one in metadata if (check := getattr(one, "func", None)) is not None]
    of_names: dict[str, tuple[Any, ...]] = {
        "law": tuple(laws_of_walls()), "inertia": (0.4, 0.3, "solid", "hollow"), "name": ("one", "two", "3"),
        "friction": (0.0, 0.2, {"at_rest": 0.3, "at_speed": 0.1, "speed": 0.5}),
    }  # fmt: skip
    for check in checks:
        if isinstance(check, Number | Whole):
            return _number(rng, name, check)
        if isinstance(check, Components):
            length, kinds = int(rng.choice(list(check.counts)[:3])), get_args(annotation)
            kinds = kinds[:1] * length if kinds[-1] is ... else kinds
            return [value_of(rng, name, kind, []) for kind in kinds]
    if name in of_names:
        return of_names[name][rng.integers(len(of_names[name]))]
    found = None
    if get_origin(annotation) is Literal:
        found = get_args(annotation)[rng.integers(len(get_args(annotation)))]
    elif get_origin(annotation) in (Union, types.UnionType):
        kinds = tuple(one for one in get_args(annotation) if one is not type(None))
        found = value_of(rng, name, kinds[rng.integers(len(kinds))], [])
    elif annotation is bool:
        found = bool(rng.random() < 0.5)
    elif isinstance(annotation, type) and issubclass(annotation, Model):
        found = table_of(rng, annotation)
    return found


def _number(rng: Rng, name: str, check: Number | Whole) -> float:
    if isinstance(check, Whole):
        return int(rng.integers(check.least, check.least + 5))
    if check.infinite and rng.random() < 0.3:
        return math.inf
    low, high = USUAL.get(name, (-1.0, 1.0))
    low, high = max(low, check.least + (1e-3 if check.above else 0.0)), min(high, check.most)
    return float(rng.uniform(low, high)) if low <= high else float(check.least + rng.uniform(0.01, 1))


def table_of(rng: Rng, model: type[Model], share: float = 0.5) -> dict[str, Any]:
    """Return the fields of a model: those that it needs, and a share of the others."""
    found: dict[str, Any] = {}
    for name, info in model.model_fields.items():
        if name == model.tag:
            found[name] = info.default
        elif info.is_required() or rng.random() < share:
            value = value_of(rng, name, info.annotation, list(info.metadata))
            if value is not None:
                found[name] = value
    return found


# --- scenes --------------------------------------------------------------------------------------------------------

SIZES: dict[str, dict[str, Any]] = {
    "plane": {"point": (0, 0, 0), "normal": (1, 0, 0)}, "segment": {"start": (0, -1), "end": (0.2, 1)},
    "polygon": {"points": [(0, 0), (2, 0), (1.5, 1.5), (0, 1)]}, "table": {"length": 2.0, "width": 1.0},
    "box": {"center": (0, 0, 0.5), "size": (2, 1, 1)}, "strip": {"point": (0, 0, 0), "normal": (1, 0.2, 0), "width": 2},
    "wedge": {"apex": (0, 0, 0), "from_angle": 0, "to_angle": 100}, "cylinder": {"point": (0, 0, 0), "radius": 1.0},
    "arc": {"center": (0, 0), "radius": 1, "from_angle": 20, "to_angle": 200}, "sphere": {"center": (0, 0, 0.3), "radius": 0.9},
    "outline": {"pieces": [[0, 0, -0.5, 1, 0, 0.5, 0, 0.5, -0.5, 0], [1, 0, -0.5, 0, 1, 0.5, 0, -0.5, -0.5, 0]]},
}  # fmt: skip


def _sizes(rng: Rng, shape: str) -> dict[str, Any]:
    if shape == "curve":
        return FORMULAS[rng.integers(len(FORMULAS))]
    return dict(FIGURES[shape].usual if shape in FIGURES and shape not in SIZES else SIZES[shape])


def _wall(rng: Rng, shape: str) -> dict[str, Any]:
    """Return a wall of a shape: its sizes are usual ones, the other fields drawn."""
    kind = SHAPES[shape]
    own = set(kind.of.model_fields) if hasattr(kind, "of") else set()
    drawn = {name: value for name, value in table_of(rng, kind, 0.4).items() if name not in own | {"preset"}}
    required = {name for name, info in kind.model_fields.items() if info.is_required()}
    found = {**drawn, **{k: v for k, v in drawn.items() if k not in required}, **_sizes(rng, shape), "shape": shape}
    found["restitution"] = found.get("restitution", float(rng.uniform(0.5, 1)))
    found["friction"] = found.get("friction", float(rng.uniform(0, 0.5)))
    if shape == "table":
        pocket = {"mouth": 0.12, "jaw_angle": 135, "jaw_radius": 0.01, "shelf": 0.03, "radius": 0.06}
        found.update({part: pocket for part in ("corner_pockets", "side_pockets") if part in found})
        found.update({"side_pockets": {**pocket, "jaw_angle": 100}} if "side_pockets" in found else {})
        found.update({"nose_height": 0.037} if "nose_height" in found else {})
        found.update({"height": 0.06} if "height" in found else {})
        if rng.random() < 0.3:
            found = {k: v for k, v in found.items() if k not in ("length", "width")} | {
                "preset": str(rng.choice(list(presets())))
            }
    for low, high in (("low", "height"), ("from_angle", "to_angle")):
        if low in found and high in found and not found[low] < found[high]:
            found[low], found[high] = found[high] - 1.0, found[low] + 1.0
    if "corner" in found and "center" in found:
        del found["center" if rng.random() < 0.5 else "corner"]
    return found


def _ball(rng: Rng, size: float, floor: bool) -> dict[str, Any]:
    kind = carom.SceneBall
    drawn = table_of(rng, kind, 0.4)
    found = {"radius": drawn["radius"], "mass": drawn["mass"], "inertia": drawn.get("inertia", "solid")}
    found["position"] = rng.uniform(-size, size, 2).tolist() + ([] if floor else [float(rng.uniform(0.1, 0.5))])
    found["velocity"] = rng.normal(0, 1.5, 2 if floor and rng.random() < 0.8 else 3).tolist()
    way = rng.integers(4) if floor and len(found["velocity"]) == 2 else rng.integers(2)
    if way == 1:
        found["spin"] = rng.normal(0, 20, 3).tolist()
    elif way == 2:
        found |= {"rolling": True, "spin_z": float(rng.normal(0, 10))}
    elif way == 3:
        strike = drawn.get("strike") or {"speed": 2.0}
        strike["offset"] = rng.uniform(-0.3, 0.3, 2).tolist()
        del found["velocity"]
        found["strike"] = strike
    return found


def _with_needs(rng: Rng, table: dict[str, Any]) -> dict[str, Any]:
    """Give a wall or a contact what its law needs."""
    law = laws().get(table.get("law", ""))
    if law is not None and law.last == "stiffness_ratio":
        table |= {"tangential_restitution": 0.0, "stiffness_ratio": float(rng.uniform(0.8, 1.1))}
    return table


def random_scene(seed: int, shape: str = "") -> carom.Scene:
    """Return a scene with a wall of a shape (default: that of the number), and whatever else it may have."""
    rng = np.random.default_rng([seed, 59])
    shape = shape or list(SHAPES)[seed % len(SHAPES)]
    while True:
        table: dict[str, Any] = {"walls": [_with_needs(rng, _wall(rng, shape))]}
        floor = shape == "table" or rng.random() < 0.7
        if floor:
            table["floor"] = {"friction": float(rng.uniform(0.05, 0.4)), **table_of(rng, carom.Floor, 0.3)}
            table["floor"].pop("slope", None)
            if rng.random() < 0.2:
                table["floor"] = {"friction": 0.2, "slope": rng.uniform(-0.05, 0.05, 2).tolist()}
        if not floor or rng.random() < 0.3:
            table["gravity"] = [0.0, float(rng.uniform(0, 9)), [0.1, -0.2, -9.0]][rng.integers(2 if floor else 3)]
        if rng.random() < 0.3:
            other = {"plane": {"point": (-5, 0, 0), "normal": (1, 0, 0)}}
            other["sphere"] = {"center": [*rng.uniform(-0.6, 0.6, 2).tolist(), 0.03], "radius": 0.1, "inside": False}
            kind = str(rng.choice(list(other)))
            table["walls"].append(_with_needs(rng, _wall(rng, kind)) | other[kind])
        table["balls"] = [_ball(rng, 0.8, floor) for _ in range(1 if rng.random() < 0.4 else int(rng.integers(2, 4)))]
        if rng.random() < 0.5:
            table["ball_contact"] = table_of(rng, carom.BallContact, 0.4)
            table["ball_contact"].pop("law", None)
            if rng.random() < 0.4:
                table["ball_contact"]["law"] = str(rng.choice(laws_of_pairs()))
                table["ball_contact"].pop("tangential_restitution", None)
        table["run"] = {"duration": float(rng.uniform(0.5, 2.0)), "max_events": int(rng.integers(5, 40))}
        if rng.random() < 0.2:
            table["run"]["floor_contact"] = "after"
        if rng.random() < 0.5:
            table["run"]["law"] = str(rng.choice(laws_of_walls()))
        if rng.random() < 0.1 and shape == "table":
            for k, ball in enumerate(table["balls"]):
                ball["name"] = str(k)
            radius = table["balls"][0]["radius"]
            table["balls"] = [{**ball, "radius": radius} for ball in table["balls"]][:3]
            if len(table["balls"]) == 3:
                table["rack"] = {
                    "balls": ["0", "1", "2"],
                    "gap": 1e-4,
                    "gap_spread": 5e-5,
                    "seed": int(rng.integers(5)),
                }
        try:
            return carom.Scene(**table)
        except carom.CaromError:
            continue


# --- gases ---------------------------------------------------------------------------------------------------------


def _container(rng: Rng, shape: str) -> dict[str, Any]:
    kind = CONTAINERS[shape]
    axes = int(rng.integers(2, 4))
    if shape in ("box", "periodic"):
        found: dict[str, Any] = {"size": [6.0, 5.0, 7.0][:axes]}
        if shape == "box" and rng.random() < 0.5:
            found["periodic"] = ["x"]
        if rng.random() < 0.3:
            found["obstacles"] = [[3.0, 2.5, 0.5]]
        if rng.random() < 0.3 and axes == 2:
            found["plates"] = [[1.0, 1.0, 2.0, 1.3]]
    elif shape == "sphere":
        found = {"radius": 4.0}
    elif shape == "cylinder":
        found = {"radius": 3.0, "height": 5.0}
    elif shape == "polygon":
        found = {"points": [(0, 0), (8, 0), (6, 6), (0, 4)]}
    elif shape == "curve":
        found = [{"r": "4 + 0.4*cos(3*theta)"}, {"x": "5*cos(s)", "y": "4*sin(s)"},
                 {"points": [[4.0, 0.0], [0.8, 4.4], [-4.0, 0.4], [0.0, -3.6]]}][rng.integers(3)]  # fmt: skip
    else:
        usual = FIGURES[shape].usual
        long = {"radius", "distance", "stem", "size", "half_axes", "radii", "straight", "side"}
        found = {
            name: ([8 * one for one in value] if isinstance(value, (tuple, list)) else 8 * value) if name in long else value
            for name, value in usual.items()
        }  # fmt: skip
    if "height" in kind.model_fields and shape != "cylinder" and rng.random() < 0.4:
        found["height"] = 5.0
        if rng.random() < 0.5:
            found["periodic"] = ["z"]
    if rng.random() < 0.3 and "plates" not in found:
        found["bounds"] = "centre"
    return {"shape": shape, **found}


BOUNCES: tuple[Any, ...] = (
    0.9, {"form": "viscoelastic", "c": 0.1}, {"form": "uniform", "low": 0.8, "high": 0.9}, {"form": "han-2005"},
    {"form": "power", "at_rest": 0.9, "speed": 1.0}, {"form": "normal", "mean": 0.9, "deviation": 0.02},
    {"form": "polynomial", "coefficients": [0.9, -0.01, 0.0]},
    {"form": "exponential", "at_rest": 0.95, "at_speed": 0.8, "speed": 2.0},
)  # fmt: skip


def random_gas(seed: int, shape: str = "") -> GasScene:
    """Return a small gas in a container of a shape (default: that of the number)."""
    rng = np.random.default_rng([seed, 60])
    shape = shape or list(CONTAINERS)[seed % len(CONTAINERS)]
    while True:
        species: list[dict[str, Any]] = [{"name": "a", "count": int(rng.integers(4, 9)), "radius": 0.1}]
        if rng.random() < 0.5:
            species[0] |= {
                "radius": {"distribution": "lognormal", "median": 0.1, "sigma": 0.1, "seed": int(rng.integers(5))}
            }
        if rng.random() < 0.5:
            species.append({"name": "b", "count": 3, "radius": 0.15})
        for one in species:
            for name in ("temperature", "temperature_rotational", "inertia"):
                if rng.random() < 0.3:
                    one[name] = 0.3 if name == "inertia" else float(rng.uniform(0.5, 2))
            one.update([{}, {"mass": 0.7}, {"density": 30.0}][rng.integers(3)])
        contact = {"between": ("*", "*"), "restitution": BOUNCES[rng.integers(len(BOUNCES))]}
        contact["friction"] = [0.0, 0.2, math.inf, {"at_rest": 0.3, "at_speed": 0.1, "speed": 0.5}][rng.integers(4)]
        if rng.random() < 0.4:
            contact["tangential_restitution"] = float(rng.uniform(-1, 1))
        table: dict[str, Any] = {"container": _container(rng, shape), "species": species, "contacts": [contact]}
        if rng.random() < 0.3:
            table["contacts"].append({"between": ("a", "wall"), "restitution": 0.8, "friction": 0.1})
        if rng.random() < 0.3:
            table["thermostat"] = table_of(rng, Thermostat)
        if rng.random() < 0.3:
            table["gravity"] = [1.0, [0.2, -0.5], [0.1, 0.2, -0.4]][rng.integers(3)]
        if rng.random() < 0.2:
            table["contact_time"] = 1e-3
        if rng.random() < 0.3 and shape == "periodic":
            table["shear_rate"] = 0.1
        if shape in WALLS and rng.random() < 0.5:
            number = rng.integers(len(DRIVES)) if shape in ("box", "rectangle") else rng.integers(2)
            table["drives"] = [{"wall": WALLS[shape], **DRIVES[number]}]
        table["run"] = {
            "max_events": int(rng.integers(20, 60)),
            "seed": int(rng.integers(100)),
            "equilibrate": int(rng.integers(20)),
        }
        if rng.random() < 0.2:
            table["run"] |= {"duration": 50.0}
        if rng.random() < 0.2:
            table["run"] |= {"start": "random"}
        if rng.random() < 0.1:
            table["run"] |= {"from_time": 0.1}
        try:
            return GasScene(**table)
        except carom.CaromError:
            continue


WALLS = {
    "box": "bottom",
    "rectangle": "left",
    "circle": "side",
    "sphere": "side",
    "cylinder": "side",
    "polygon": "edge1",
}
DRIVES: tuple[dict[str, Any], ...] = (
    {"temperature": 1.2}, {"temperature": 1.0, "temperature_rotational": 0.4}, {"amplitude": 0.05, "frequency": 3.0, "phase": 0.2},
    {"mass": 5.0, "force": 1.0}, {"surface_velocity": (0.5, 0.0)}, {"surface_velocity": (0.5, 0.0, 0.0)},
)  # fmt: skip


# --- impacts and orbits --------------------------------------------------------------------------------------------


def random_impact(seed: int) -> ImpactCase:
    """Return an impact."""
    rng = np.random.default_rng([seed, 61])
    while True:
        table = table_of(rng, ImpactCase)
        table["angle"] = float(rng.uniform(5, 80))
        table.setdefault("restitution", 0.8)
        try:
            return ImpactCase(**table)
        except carom.CaromError:
            continue


def random_orbit_case(seed: int) -> OrbitCase:
    """Return a billiard with its figure."""
    rng = np.random.default_rng([seed, 62])
    names = [name for name, kind in FIGURES.items() if issubclass(kind, PlaneFigure | CellFigure)]
    while True:
        name = names[seed % len(names)]
        sizes = SIZES["polygon"] if name == "polygon" else _sizes(rng, name)
        table = table_of(rng, OrbitCase, 0.3) | {"table": {"shape": name, **sizes}, "bounces": 20, "orbits": 2}
        table["law"] = str(rng.choice(["no-slip", "mirror", "contact"]))
        table.pop("ball_radius", None)
        try:
            return OrbitCase(**table)
        except carom.CaromError:
            continue
