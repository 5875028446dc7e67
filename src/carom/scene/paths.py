"""Paths to the numbers of a scene, such as ``balls.0.velocity`` and ``walls.*.friction``: look them up, and replace them.

The parts of a path are the names of fields, separated by dots. Of several balls or walls one is chosen by its number or its name,
all of them by ``*``; a component of a vector by ``x``, ``y``, ``z`` or its number.
"""

from __future__ import annotations

from collections.abc import Mapping
from numbers import Integral
from typing import Any, NamedTuple, TypeVar

from carom.errors import CaromError, Fault, did_you_mean, near_name, shortened_list, shown
from carom.scene.ball import SceneBall
from carom.scene.scene import Scene
from carom.scene.schema import Model

AnyModel = TypeVar("AnyModel", bound=Model)
Keys = tuple[str | int, ...]
COMPONENTS = ("x", "y", "z")


def ball_index(scene: Scene, ball: int | str, where: str = "ball") -> int:
    """Return the number of a ball that is given by its name or its number; a text of digits is a name first, then a number.

    CaromError, which begins with ``where``, for a ball that is not there.
    """
    names = scene.ball_names
    if isinstance(ball, str) and ball in names:
        return names.index(ball)
    whole = ball.isdecimal() if isinstance(ball, str) else isinstance(ball, Integral) and not isinstance(ball, bool)
    number = int(ball) if whole else -1
    if not 0 <= number < len(names):
        hint = did_you_mean(ball, names) if isinstance(ball, str) else ""
        known = f"a ball of {shortened_list(names, 16)}, or a number from 0 to {len(names) - 1}"
        raise CaromError(Fault(where, "", known, shown(ball, 60), hint))
    return number


class PathMatch(NamedTuple):
    """Target of a path: the places that it names, and the value at each."""

    path: str
    places: tuple[Keys, ...]
    """Field names and numbers, one tuple for each place; several only where the path has a ``*``."""
    values: tuple[Any, ...]


def path_match(model: Model, path: str, where: str = "path") -> PathMatch:
    """Look up a path in a scene, or in another model.

    Parameters
    ----------
    model : Model
        A :class:`carom.Scene`, or a part of one.
    path : str
    where : str, optional
        What a message begins with.

    Raises CaromError, one line with the nearest name, for a path that leads nowhere.

    Examples
    --------
    >>> import carom
    >>> wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.85, friction=0.2)
    >>> scene = carom.Scene(gravity=0, walls=[wall], balls=[{"radius": 0.03, "mass": 0.2, "position": (1, 0, 0)}])
    >>> path_match(scene, "walls.*.friction")
    PathMatch(path='walls.*.friction', places=(('walls', 0, 'friction'),), values=(0.2,))
    """
    if not isinstance(path, str) or not path or "" in path.split("."):
        raise CaromError(Fault(where, "", "a path such as 'balls.0.velocity' or 'walls.*.friction'", shown(path, 60)))
    found: list[tuple[Keys, Any]] = [((), model)]
    names = path.split(".")
    for depth, name in enumerate(names):
        next_found = []
        for keys, value in found:
            next_found += [((*keys, key), _item(value, key)) for key in _chosen(value, name)]
        if not next_found:
            known = list(dict.fromkeys(name for _keys, value in found for name in _known(value)))
            raise CaromError(_nowhere(where, path, names[:depth], name, known))
        found = next_found
    return PathMatch(path, tuple(keys for keys, _value in found), tuple(value for _keys, value in found))


def _item(value: Any, key: str | int) -> Any:
    return value[key] if isinstance(key, int) else getattr(value, key)


def _chosen(value: Any, name: str) -> list[str | int]:
    """Return the keys by which a part of a path goes on: none where it leads nowhere."""
    if isinstance(value, Model):
        return [name] if name in type(value).model_fields else []
    if not isinstance(value, tuple):
        return []
    if name == "*":
        return list(range(len(value)))
    if named := [i for i, one in enumerate(value) if isinstance(one, Model) and getattr(one, "name", None) == name]:
        return list(named)  # (a name may be of digits)
    if name.isdecimal():
        return [int(name)] if int(name) < len(value) else []
    return [COMPONENTS.index(name)] if name in COMPONENTS[: len(value)] else []


def _known(value: Any) -> list[str]:
    """Return the names by which a path can go on from a value."""
    if isinstance(value, Model):
        return list(type(value).model_fields)
    if not isinstance(value, tuple):
        return []
    if value and isinstance(value[0], Model):
        named = [getattr(one, "name", None) or str(i) for i, one in enumerate(value)]
        return ["*", *named]
    return list(COMPONENTS[: len(value)])


def _nowhere(where: str, path: str, before: list[str], name: str, known: list[str]) -> Fault:
    here = ".".join(before)
    if not known:
        got = f"{name!r} after {here or 'nothing'}, which has no fields here"
        advice = f"give it whole: {here} = {{{name} = ...}}" if before[-1:] == ["strike"] else ""
        return Fault(where, path, "a path to a number", got, advice)
    near = near_name(name, known)
    advice = f"did you mean {'.'.join([*before, near])!r}?" if near else "take one of these"
    return Fault(where, path, f"{shortened_list(known, 12)}{f' in {here}' if here else ''}", repr(name), advice)


def overlapping_paths(matches: list[PathMatch]) -> list[tuple[str, str]]:
    """Return the pairs of paths that stand for the same place, or of which one stands for a part of the other."""
    owners: dict[Keys, str] = {}
    found = []
    for match in matches:
        for place in match.places:
            for other, path in owners.items():
                shorter = min(len(place), len(other))
                if path != match.path and place[:shorter] == other[:shorter]:
                    found.append((path, match.path))
            owners[place] = match.path
    return list(dict.fromkeys(found))


def replaced(model: AnyModel, changes: Mapping[str, Any]) -> AnyModel:
    """Return a copy of a scene with other values at some paths; the copy is validated as a whole.

    Parameters
    ----------
    model : Scene or GasScene, or a part of one
    changes : mapping of paths to values
        Such as "balls.white.velocity". A path with a ``*`` gives all of its places the same value. A ball's strike replaces its
        velocity and spin, and either of these its strike.

    Raises CaromError, one line per problem: for a path that leads nowhere, and for what the scene refuses.

    Examples
    --------
    >>> import carom
    >>> ball = carom.SceneBall(name="white", radius=0.03, mass=0.2, position=(1, 0, 0), velocity=(-2, 1, 0))
    >>> scene = carom.Scene(gravity=0, balls=[ball])
    >>> carom.replaced(scene, {"balls.white.velocity": (-3, 0), "balls.0.mass": "250 g"}).balls[0].velocity
    (-3.0, 0.0, 0.0)
    """
    tree: dict[str | int, Any] = {}
    for path, value in changes.items():
        for place in path_match(model, path).places:
            if place[-1] == "preset":
                raise CaromError(
                    Fault(
                        "path",
                        f"{path}",
                        "a field that stands by itself",
                        "the name that filled the others when the table was made",
                        "make another scene",
                    )
                )
            here = tree
            for key in place[:-1]:
                here = here.setdefault(key, {})
            here[place[-1]] = _Leaf(value)
    made = type(model)(**_fields(model, tree))
    balls = tree.get("balls")
    if isinstance(made, Scene) and made.rack is not None and isinstance(balls, dict):
        for i, change in balls.items():
            if made.rack.lays(name := made.ball_names[i]) and isinstance(change, dict) and "position" in change:
                got = f"a ball of the rack, {name!r}, whose place follows from rack.gap"
                raise CaromError(Fault("path", f"balls.{name}.position", "a ball that is placed by itself", got))
    return made


# A strike takes the place of a ball's motion, and a motion that of a strike.
AT_REST: dict[str, Any] = {"velocity": (0.0, 0.0, 0.0), "rolling": False, "spin": None, "spin_z": None}


class _Leaf(NamedTuple):
    value: Any


def _fields(model: Model, changes: dict[str | int, Any]) -> dict[str, Any]:
    fields = {name: getattr(model, name) for name in type(model).model_fields}
    made = fields | {str(name): _changed(fields[str(name)], change) for name, change in changes.items()}
    if (
        isinstance(model, SceneBall)
        and "radius" in changes
        and "position" not in changes
        and model.center[2] == model.radius
    ):
        made["position"] = model.position[:2]  # (a ball that lies on the floor still does)
    if isinstance(model, SceneBall) and "strike" in changes and model.strike is None:
        made |= {name: rest for name, rest in AT_REST.items() if name not in changes}
    elif isinstance(model, SceneBall) and "strike" not in changes and not changes.keys().isdisjoint(AT_REST):
        made["strike"] = None
    return made


def _changed(value: Any, changes: dict[str | int, Any] | _Leaf) -> Any:
    if isinstance(changes, _Leaf):
        return changes.value
    if isinstance(value, Model):  # (as a dict: the scene then says where in it a value is wrong)
        return _fields(value, changes)
    return tuple(_changed(one, changes[i]) if i in changes else one for i, one in enumerate(value))
