"""Read scenes from TOML files, and write a first one."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from importlib.resources import files
from numbers import Integral
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

from carom.errors import CaromError, Fault, did_you_mean, near_name, require_type, shortened_list, shown
from carom.files import as_path, atomic_path, require_writable
from carom.formatting import json_value
from carom.laws.law import Law
from carom.scene.ball import SceneBall
from carom.scene.openings import table_scene
from carom.scene.presets import parse_toml, presets, read_toml, wall_fields
from carom.scene.restitution import Constant
from carom.scene.scene import Scene
from carom.scene.schema import Model, from_file


def load_scene(path: str | Path, *, allow_own_laws: bool = False) -> Scene:
    """Read a scene from a TOML file.

    Parameters
    ----------
    path : str or Path
        The file; or the name of a real table, such as "pool-9ft" (:func:`new_scene`), where there is no file of that name; or the
        text of a scene file, with its line breaks.
    allow_own_laws : bool, optional
        Whether a custom law in it, ``law = "file.py:name"``, is looked up in the file's folder and run. Default: it is refused, so
        that opening a file runs no code.

    Returns
    -------
    Scene. Raises CaromError with one line for each problem: where, what was expected, what was found, how to fix it.

    Examples
    --------
    >>> import carom, pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = pathlib.Path(folder) / "scene.toml"
    ...     _ = file.write_text(carom.scene_text(), encoding="utf-8")
    ...     scene = carom.load_scene(file)
    >>> len(scene.balls)
    1
    """
    if isinstance(path, str) and "\n" in path:
        name, table = "scene", parse_toml("scene", path)
    else:
        path = as_path("load_scene", path)
        name, table = str(path), _by_name(path) or read_toml(path, _remedy(path))
        _beside(table, path.parent)
    if strange := sorted({"container", "species"} & set(table)):
        raise CaromError(
            Fault(f"{name}", "", "a scene of single balls", f"a gas, with {' and '.join(strange)}", f"carom gas {name}")
        )
    return from_file(name, Scene, table, allow_own_laws=allow_own_laws)


def _by_name(path: Path) -> dict[str, Any] | None:
    """Return the table of a real table's opening; None where a file has that name, or no table."""
    return None if path.exists() or str(path) not in presets() else tomllib.loads(table_scene(str(path)))


def _remedy(path: Path) -> str:
    """Return the name of a real table that was meant, which stands for its scene, or the command that writes the file."""
    near = near_name(path, presets())
    if near:
        return f"did you mean {near!r}?"
    if not path.suffix and path.name == str(path):
        return f"a file's name ends with .toml; tables have the names {', '.join(presets())}"
    return f"carom scene new {path} writes one"


def save_scene(scene: Scene, path: str | Path) -> Path:
    """Write a scene to a TOML file, from which :func:`load_scene` makes an equal one.

    Parameters
    ----------
    scene : Scene
        One made in Python, or read from another program.
    path : str or Path
        A name that ends with .toml; a file of that name is replaced.

    Returns
    -------
    Path. Raises CaromError, one line, for a place that cannot be written to, and for a carom.Law, which a file cannot hold.

    Examples
    --------
    >>> import carom, pathlib, tempfile
    >>> scene = carom.load_scene("pool-9ft")
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = carom.save_scene(scene, pathlib.Path(folder) / "pool.toml")
    ...     carom.load_scene(file) == scene
    True
    """
    require_type("save_scene", "scene", scene, Scene)
    path = as_path("save_scene", path)
    require_writable(path, (".toml",))
    text = toml_text("save_scene", scene)
    with atomic_path(path) as part:
        part.write_text(text, encoding="utf-8")
    return path


def plain_table(where: str, value: Any, *, whole: bool = False, at: str = "") -> Any:
    """Return a model as a file has it, from which :func:`carom.scene.schema.from_file` makes an equal one, bit for bit.

    What is not given is left out, and what is as by default unless ``whole``. Raises CaromError for what no file can hold: a
    carom.Law, a Python function. (The one way from a scene to any file.)
    """
    if isinstance(value, Constant):
        return value.value
    if isinstance(value, Model):
        preset = presets().get(getattr(value, "preset", None) or "")
        usual = {name: field.default for name, field in type(value).model_fields.items()}
        usual |= wall_fields(preset) if preset else {}
        return {
            name: plain_table(where, one, whole=whole, at=f"{at}.{name}" if at else name)
            for name in type(value).model_fields
            # (as texts: 0.0 is not -0.0)
            if (one := getattr(value, name)) is not None
            and (whole or name == value.tag or repr(one) != repr(usual[name]))
        }
    if isinstance(value, tuple):
        return [plain_table(where, one, whole=whole, at=f"{at}[{i}]") for i, one in enumerate(value)]
    if isinstance(value, str | float | int):
        return value
    if isinstance(value, Law):
        advice = "put it into a Python file and name it in the scene as 'file.py:name'"
        raise CaromError(
            Fault(
                where,
                at,
                "a law with a name or a file",
                f"the carom.Law {value.name!r}, which a file cannot hold",
                advice,
            )
        )
    got = "Python function" if callable(value) else type(value).__name__
    raise CaromError(
        Fault(where, at, "a text or numbers", f"a {got}, which a file cannot hold", "give a formula as a text")
    )


def stored_model(where: str, model: Model) -> dict[str, Any]:
    """Return a model as JSON in other files has it: every field that is given or has a default, infinity as the text "inf".

    It is read back at once, as by who opens the file. Raises CaromError for what no file can hold.
    """
    found: dict[str, Any] = json_value(plain_table(where, model, whole=True), infinite=True)
    from_file(where, type(model), found)
    return found


def toml_text(where: str, model: Model) -> str:
    """Return a model as the text of a TOML file."""
    import tomli_w

    return tomli_w.dumps(plain_table(where, model))


def _beside(table: dict[str, Any], folder: Path) -> None:
    """Make the paths of custom laws relative to the scene's folder."""
    walls = table.get("walls")
    for part in [table.get("run"), table.get("ball_contact"), *(walls if isinstance(walls, list) else [])]:
        law = part.get("law") if isinstance(part, dict) else None
        if isinstance(part, dict) and isinstance(law, str) and ".py:" in law:
            part["law"] = str(folder / law)


def new_scene(table: str | None = None, *, rack: str | None = None, break_speed: float | str | None = None) -> Scene:
    """Return a scene that can be run as it is: one ball on a carom table, or a real table with its balls.

    Parameters
    ----------
    table : str, optional
        A real table by name, such as "snooker" (:class:`carom.Table`): its balls as they lie when a game begins, its cushions and
        cloth.
    rack : str, optional
        The rack of a pool table: "8-ball", "9-ball" or "10-ball". Default: fifteen balls in the order of their numbers.
    break_speed : float or str, optional
        Speed of the cue ball in the break on a pool table, m/s, or with its unit, "20 mph". Default: 9.5.

    Returns
    -------
    Scene
        :func:`scene_text` returns the commented text of its file.

    Raises CaromError, a line for each name that no table or rack has, and for a rack or a break on another table.

    Examples
    --------
    >>> import carom
    >>> carom.new_scene().ball_names
    ('ball 0',)
    >>> len(carom.new_scene("pool-9ft").balls)
    16
    >>> carom.new_scene("pool-8ft", rack="9-ball", break_speed=8).rack.balls
    ('1', '2', '3', '4', '9', '5', '6', '7', '8')
    """
    return from_file("scene", Scene, parse_toml("scene", scene_text(table, rack=rack, break_speed=break_speed)))


def scene_text(
    scene: Scene | str | None = None, *, rack: str | None = None, break_speed: float | str | None = None
) -> str:
    """Return the text of a scene file.

    Parameters
    ----------
    scene : Scene or str, optional
        A scene, which is written as :func:`save_scene` does; or the name of a real table, such as "snooker": a commented file,
        each number with its source. Default: a commented first scene, one ball on a carom table.
    rack, break_speed : optional
        Of a pool table, as in :func:`new_scene`.

    Returns
    -------
    str
        TOML, from which :func:`load_scene` makes a scene.

    Raises CaromError, one line, for a name that no table has, and for a carom.Law, which a file cannot hold.

    Examples
    --------
    >>> import carom
    >>> carom.scene_text().splitlines()[0].startswith("#")
    True
    >>> print(carom.scene_text("pool-9ft").splitlines()[0])
    # A pool table of 9 feet. The break: white meets the rack from the head string.
    >>> carom.load_scene(carom.scene_text(carom.new_scene())) == carom.new_scene()
    True
    """
    if not isinstance(scene, str) and (rack, break_speed) != (None, None):
        raise CaromError(
            f"scene_text: {'rack' if rack is not None else 'break_speed'}: expected a pool table by name with it, such as"
            f" 'pool-9ft', got {'no table' if scene is None else type(scene).__name__}"
        )
    if scene is None:
        return files("carom.scene").joinpath("new.toml").read_text(encoding="utf-8")
    if isinstance(scene, str):
        return table_scene(scene, rack, break_speed)
    require_type("scene_text", "scene", scene, Scene)
    return toml_text("scene_text", scene)


# ----------------------------------------------------------------------------------------------------
# Paths to the numbers of a scene, such as ``balls.0.velocity`` and ``walls.*.friction``: look them up, and replace them.
#
# The parts of a path are the names of fields, separated by dots. Of several balls or walls one is chosen by its number or its
# name,
# all of them by ``*``; a component of a vector by ``x``, ``y``, ``z`` or its number.


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
