"""Write the table of names: each quantity with its name in scenes, tables, fits and Python.

    python docs/dev/names.py             # writes docs/reference/names.md
    python docs/dev/names.py --check     # exit status 1 if that page is not of today's declarations

Names are read from the declarations (fields of scenes, columns of tables, parameters of fits, arguments of functions); the rows
below say which of them are one quantity. Each name of a declaration stands in one row, or in CHOICES.
"""

from __future__ import annotations

import dataclasses
import inspect
import re
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

import carom
from carom.data.headers import STATE_COLUMNS
from carom.data.rebounds import COLUMNS, NAMED
from carom.fitting import Setting
from carom.fitting.laws import ALONG, PARAMETERS
from carom.fitting.rows import FORM_PARAMETERS
from carom.fitting.tracks.model import FLOOR as TRACK_PARAMETERS
from carom.scene.air import SceneAir
from carom.scene.ball import BallContact, CueStrike, SceneBall, SceneCue
from carom.scene.floor import Floor
from carom.scene.restitution import Exponential, Polynomial, Viscoelastic
from carom.scene.scene import Run, Scene
from carom.scene.shapes import Table
from carom.scene.shapes.table import Pockets
from carom.sweeps import ImpactCase
from carom.tracks import Settings
from carom.tracks.films import FLOOR as FILM_COLUMNS

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "reference" / "names.md"
SCENE = {
    "": Scene, "run.": Run, "balls[].": SceneBall, "balls[].strike.": CueStrike, "balls[].strike.cue.": SceneCue, "floor.": Floor,
    "air.": SceneAir,
    "ball_contact.": BallContact, "walls[].": Table, "walls[].corner_pockets.": Pockets, "walls[].restitution.": (
        Polynomial, Viscoelastic, Exponential),
}  # fmt: skip
FUNCTIONS = (
    carom.Ball, carom.Surface, carom.State, carom.incoming, carom.predict, carom.fit, carom.design, carom.measure_tracks, Setting,
    Settings, ImpactCase,
)  # fmt: skip
# Scenes' parts, and arguments that are no quantities: files, choices, counts, and how to run.
_CHOICES = (
    "after air angles_deg ball_contact balls bootstrap bound bounds by center chained corner_pockets cue contacts down duration "
    "every_contact file files film fine fit fix fixed floor floor_contact form format forms hard hops kind law laws max_events "
    "name odds out overlap preset profiles progress rack rate robust rolling run say scale scatter seed "
    "shape side_pockets sides shot slides sliding speeds spin_prior spins stage strict strike suffix table truth view wall "
    "walls where whole "
)
CHOICES = set(_CHOICES.split())
HEAD = """# Names

One quantity, one name: in a scene, as a column of a table, as a parameter of a fit and as an argument in Python (options of the
command line are the arguments, with hyphens). A part of a scene is the beginning of a name elsewhere: `floor.friction` is
`floor_friction`. In brackets: where a name is used (a column of a table, a parameter of a fit, an argument in Python),
and other headers that are read. Where a quantity has several names, or two quantities look like one, the
last column says why. `python docs/dev/names.py` writes this page.

"""


class Quantity(NamedTuple):
    """A row: the quantity, its symbol in the papers, its unit, its names, and a remark."""

    title: str
    symbol: str
    unit: str
    names: str
    """All names, of scenes with their path."""
    remark: str = ""
    family: bool = False
    """Whether its names are those of several numbers."""


ROWS = {
    "The ball": (
        Quantity("radius", "a", "m", "balls[].radius radius"),
        Quantity("mass", "m", "kg", "balls[].mass mass"),
        Quantity("moment of inertia over m a²", "I/(m a²), κ", "1", "balls[].inertia inertia kappa",
                 "`inertia` takes solid, hollow or the number; `kappa` is the number"),
        Quantity("position of the centre", "x, y, z", "m", "balls[].position position"),
        Quantity("velocity of the centre", "ẋ, ẏ, ż", "m/s", "balls[].velocity velocity velocity_x velocity_y velocity_z"),
        Quantity("spin (angular velocity)", "ω", "rad/s", "balls[].spin spin spin_x spin_y spin_in spin_out",
                 "`spin` of `carom.predict`, `fit` and `design` is the assumption where none was measured"),
        Quantity("spin about the vertical", "ω_z", "rad/s", "balls[].spin_z spin_z spin_z_in spin_z_out"),
        Quantity("speed before the wall", "", "m/s", "speed"),
        Quantity("angle of incidence from the normal", "", "degrees", "incidence angle_deg angle",
                 "the column is named with its unit, `incidence_deg`; `angle` of an ImpactCase is in degrees, as its outcomes are"),
        Quantity("velocity along the normal", "ẋ₀, ẋ₁", "m/s", "v_n_in v_n_out",
                 "towards the wall before, away from it after: positive both times"),
        Quantity("velocity along the wall", "ẏ₀, ẏ₁", "m/s", "v_t_in v_t_out"),
        Quantity("vertical velocity before the wall", "ż₀", "m/s", "vertical_speed"),
        Quantity("height above the floor before the wall", "", "m", "height", "`walls[].height` is another: the top of a cushion"),
        Quantity("slip before the wall", "", "m/s", "sliding", "of `carom.incoming`: velocity less that of rolling"),
        Quantity("air drag", "k", "1/m", "drag_per_metre", "it slows a ball of speed v down by k v²"),
    ),
    "The wall": (
        Quantity("restitution", "e", "1", "walls[].restitution restitution"),
        Quantity("restitution as a polynomial of speed", "r₀, r₁, r₂", "s/m, ...",
                 "walls[].restitution.coefficients restitution_0 restitution_1 restitution_2",
                 "a scene has the list, a fit the three numbers"),
        Quantity("slope of a line v_out = slope v + offset", "", "1", "restitution_slope", "of fits alone, as its offset is"),
        Quantity("offset of that line", "", "m/s", "restitution_offset"),
        Quantity("restitution of a viscoelastic ball", "c", "(s/m)^(1/5)", "walls[].restitution.c restitution_c"),
        Quantity("restitution at rest", "", "1", "walls[].restitution.at_rest restitution_at_rest"),
        Quantity("restitution at high speed", "", "1", "walls[].restitution.at_speed restitution_at_speed"),
        Quantity("speed over which it falls", "", "m/s", "walls[].restitution.speed restitution_speed"),
        Quantity("exponent of a power law", "", "1", "restitution_exponent"),
        Quantity("friction", "μ", "1", "walls[].friction friction"),
        Quantity("tangential restitution", "β", "1", "walls[].tangential_restitution tangential_restitution"),
        Quantity("tangential over normal stiffness", "", "1", "walls[].stiffness_ratio stiffness_ratio"),
        *(
            Quantity(f"{name.replace('_', ' ')} as a form of slip, slip/v_n or a speed", "", "",
                     " ".join(f"{name}_{field}" for field in ("0", "1", "at_rest", "at_speed", "speed")),
                     "of fits alone: constant and slope of a line; at rest, far from rest, and where it changes", True)
            for name in ALONG
        ),
        Quantity("further numbers of a form, in the record of a fit", "", "", "friction_2 last_1 last_2",
                 "within the fit alone", True),
        Quantity("contact time of a ball alone", "T", "s", "walls[].contact_time"),
        Quantity("depth at which a ball turns, over its speed along the normal", "", "s", "walls[].yield_time"),
        Quantity("normal", "n", "1", "normal normal_x normal_y normal_z"),
        Quantity("height of the contact point", "", "radii of the ball", "contact_height",
                 "not the height of the nose: over a nose below its centre the ball meets the wall level with the centre, at 1"),
        Quantity("height of the nose, a cushion's edge", "", "m", "walls[].nose_height",
                 "`contact_height` is this over the radius, for a ball whose centre is lower"),
        Quantity("top of a cushion", "", "m", "walls[].height"),
        Quantity("length of a table", "", "m", "walls[].length", "between the noses"),
        Quantity("width of a table", "", "m", "walls[].width", "between the noses"),
    ),
    "The air": (
        Quantity("density of the air", "ρ", "kg/m³", "air.density", "left out: by `air.temperature` and `air.pressure`"),
        Quantity("temperature of the air", "T", "K", "air.temperature"),
        Quantity("pressure of the air", "p", "Pa", "air.pressure"),
        Quantity("viscosity of the air", "η", "Pa s", "air.viscosity"),
        Quantity("wind", "", "m/s", "air.wind"),
        Quantity("whether the air bears its own weight", "", "", "air.buoyancy"),
        Quantity("coefficient of drag", "C_D", "1", "balls[].drag"),
        Quantity("coefficient of lift", "C_L", "1", "balls[].lift"),
        Quantity("decay of a spin in flight", "λ", "1", "balls[].spin_decay"),
    ),
    "The floor": (
        Quantity("friction", "μ", "1", "floor.friction floor_friction"),
        Quantity("restitution", "e", "1", "floor.restitution floor_restitution"),
        Quantity("tangential restitution", "β", "1", "floor.tangential_restitution floor_tangential_restitution"),
        Quantity("rolling resistance: deceleration over g", "", "1", "floor.rolling_resistance rolling_resistance",
                 "no beginning `floor_`: a wall has none"),
        Quantity("friction of a spin about the vertical", "", "1", "floor.spin_friction"),
        Quantity("rise of the rolling resistance with the speed", "", "s/m", "floor.rolling_drag",
                 "the resistance is `floor.rolling_resistance` + `floor.rolling_drag` v"),
        Quantity("damping of a spin about the vertical", "", "1/s", "floor.spin_damping", "more than `floor.spin_friction` takes"),
        Quantity("loss of a spin about the vertical on the way", "", "rad/m", "floor.spin_drag", "of a ball that rolls"),
        Quantity("slope of the floor", "", "1", "floor.slope", "how far it falls per metre along x and y: the sine of the angle"),
        Quantity("deceleration of a spin about the vertical", "", "rad/s²", "spin_loss", "g `floor.spin_friction` / (κ a)"),
        Quantity("deceleration of a sliding ball", "", "m/s²", "mu_g", "`floor_friction` times g, in the fit of a contact"),
        Quantity("deceleration of a rolling ball", "", "m/s²", "c_g", "`rolling_resistance` times g, as `mu_g`"),
        Quantity("gravity", "g", "m/s²", "gravity"),
    ),
    "Two balls": (
        Quantity("restitution", "e", "1", "ball_contact.restitution"),
        Quantity("friction", "μ", "1", "ball_contact.friction"),
        Quantity("tangential restitution", "β", "1", "ball_contact.tangential_restitution"),
        Quantity("tangential over normal stiffness", "", "1", "ball_contact.stiffness_ratio"),
        Quantity("Young's modulus", "E", "Pa", "ball_contact.young"),
        Quantity("Poisson's ratio", "ν", "1", "ball_contact.poisson"),
    ),
    "Cue and pockets": (
        Quantity("speed of the cue", "", "m/s", "balls[].strike.speed"),
        Quantity("direction of the cue", "", "degrees", "balls[].strike.azimuth"),
        Quantity("elevation of the cue", "", "degrees", "balls[].strike.elevation"),
        Quantity("place of the strike", "", "radii of the ball", "balls[].strike.offset"),
        Quantity("mass of the cue", "", "kg", "balls[].strike.cue.mass"),
        Quantity("effective mass of its end", "", "kg", "balls[].strike.cue.end_mass"),
        Quantity("friction of the tip", "μ", "1", "balls[].strike.cue.friction"),
        Quantity("restitution of the tip", "e", "1", "balls[].strike.cue.restitution"),
        *(
            Quantity(f"{part} of a pocket", "", unit, f"walls[].corner_pockets.{part.replace(' ', '_')}")
            for part, unit in (("mouth", "m"), ("shelf", "m"), ("radius", "m"), ("jaw radius", "m"), ("jaw angle", "degrees"))
        ),
    ),
    "Measurements": (
        Quantity("mean of unmeasured spins", "", "v_t/a", "spin_mean"),
        Quantity("standard deviation of unmeasured spins", "", "v/a", "spin_width"),
        Quantity("part of rolling before the wall", "", "1", "roll", "horizontal spin over that of rolling"),
        Quantity("error of speeds", "σ", "m/s", "sigma_v", "of all rows; the columns `sigma_v_n_in` ... have errors of each"),
        Quantity("error of spins", "σ", "rad/s", "sigma_spin"),
        Quantity("error of a coordinate in a frame", "", "m", "noise"),
        Quantity("time that a fit uses before and after a contact", "", "s", "window"),
        Quantity("time that it excludes before and after a contact", "", "s", "blind"),
    ),
}  # fmt: skip


def declared() -> dict[str, dict[str, str]]:
    """Return the declared names of scenes, tables, fits and Python; each with other headers that are read, in brackets."""
    scene: dict[str, str] = {}
    for path, models in SCENE.items():
        for model in models if isinstance(models, tuple) else (models,):
            scene |= {f"{path}{name}": "" for name in model.model_fields}
    aliases: dict[str, str] = {}
    for name, (_dimension, others) in STATE_COLUMNS.items():
        aliases[name] = ", ".join(f"`{other}`" for other in others)
    for name in (*COLUMNS["planar"], *COLUMNS["table"]):
        aliases.setdefault(name, ", ".join(f"`{other}`" for other in NAMED.names[name][1]))
    columns = aliases | {label.replace(" ", "_"): "" for label, _inner, _prefix in FILM_COLUMNS}
    fits = {one.name: "" for one in (*PARAMETERS, *FORM_PARAMETERS, *TRACK_PARAMETERS)}
    fits |= {inner: "" for _label, inner, _prefix in FILM_COLUMNS}
    python: dict[str, str] = {}
    for one in FUNCTIONS:
        fields = getattr(one, "model_fields", None)
        names: Iterable[str] = fields or inspect.signature(one).parameters
        if dataclasses.is_dataclass(one) and not fields:
            names = [field.name for field in dataclasses.fields(one) if field.init] or names
        python |= dict.fromkeys(names, "")
    if "planar" in python:
        del python["planar"]
    return {"in a scene": scene, "column of a table": columns, "parameter of a fit": fits, "argument in Python": python}


def canonical(name: str) -> str:
    """Return a name without its place in a scene, its axis, or before and after: all of ``v_n_in``, ``v_n_out`` are v_n."""
    name = re.sub(r"^(?:balls|walls)\[\]\.|^balls\[\]\.strike\.|^ball_contact\.", "", name).replace(".", "_")
    return re.sub(r"_(?:[xy]|in|out|deg)$", "", name if name.startswith(("spin_z", "v_")) else re.sub(r"_z$", "", name))


def names_of(row: Quantity) -> list[str]:
    """Return the different names of a quantity: one, where all is well."""
    return list(dict.fromkeys(canonical(name) for name in row.names.split()))


def page() -> str:
    """Return the page."""
    scene, *others = declared().values()
    text = [HEAD]
    for heading, rows in ROWS.items():
        text.append(f"## {heading}\n\n| quantity | symbol | unit | in a scene | elsewhere | remark |\n|{'---|' * 6}\n")
        for row in rows:
            names = row.names.split()
            placed = ", ".join(f"`{name}`" for name in names if name in scene and _in_scene(name))
            found = []
            for name in names:
                kinds = [kind for kind, known in zip(("table", "fit", "Python"), others, strict=True) if name in known]
                read = others[0].get(name, "")
                if kinds:
                    found.append(f"`{name}` ({', '.join(kinds)}{f'; {read}' if read else ''})")
            several = "**several names**: " if len(names_of(row)) > 1 and not row.family else ""
            text.append(
                f"| {row.title} | {row.symbol} | {row.unit} | {placed} | {', '.join(found)} | {several}{row.remark} |\n"
            )
        text.append("\n")
    return "".join(text).rstrip("\n") + "\n"


def _in_scene(name: str) -> bool:
    """Whether a name is one of a scene: with its path, or of the scene itself."""
    return "." in name or name in Scene.model_fields


if __name__ == "__main__":
    if "--check" in sys.argv[1:]:
        sys.exit(PAGE.read_text(encoding="utf-8") != page())
    PAGE.write_text(page(), encoding="utf-8")
