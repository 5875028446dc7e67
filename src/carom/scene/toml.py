"""Read scenes from TOML files, and write a first one."""

from __future__ import annotations

import tomllib
from importlib.resources import files
from pathlib import Path
from typing import Any

from carom.errors import CaromError, Fault, near_name, require_type
from carom.files import as_path, atomic_path, require_writable
from carom.formatting import json_value
from carom.laws.law import Law
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
    """Return the name of a real table that was meant, or the command that writes the file."""
    near = near_name(path, presets())
    if near and not path.suffix:
        return f"did you mean {near!r}?"
    if near:
        return f"carom scene new `table` {near} FILE.toml writes one"
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
