"""Tables of rebounds as people write them, as components: speed and angle, ratios, heights, times, x and y, normalised spin.

Each quantity has a name, with other names that are in use (:data:`WRITTEN`); an error bar is a column ``sigma_...`` of it, or
stands in the cell. What a form says is converted to components before and after the contact. A form that says only the ratio of
speeds, as laws with constants need no more, gets a speed of 1 m/s before the wall. Spins have the sign of carom: slip is
v_t - a spin.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.data.headers import WRITTEN_COLUMNS, ColumnNames
from carom.errors import FaultList, shortened_list
from carom.public.defaults import GRAVITY

Array = NDArray[np.float64]
Measured = Mapping[str, Array]
ANGLE_WORDS = re.compile(r"theta|angle|[\[(](?:deg(?:rees)?|rad|°)[\])]", re.IGNORECASE)
SPEED_WORDS = re.compile(r"speed|veloc|[\[(](?:[cm]?m ?/ ?s|ft/s|in/s|m s\^?-1|km/?h|kph|mph)[\])]", re.IGNORECASE)
WRITTEN = ColumnNames(
    WRITTEN_COLUMNS | {f"sigma_{name}": (kind, tuple(f"{prefix}_{other}" for other in (name, *others) for prefix in ("sigma", "u")
                                                 if (prefix, other) != ("sigma", name)))
                   for name, (kind, others) in WRITTEN_COLUMNS.items()}
)  # fmt: skip
_FORMS = (
    ("speed_in", "speed_out", "incidence", "reflection", "incidence_from_surface", "reflection_from_surface"),
    ("e_n", "e_t", "e_x", "beta"), ("drop_height", "rebound_height", "peak_height"), ("time_before", "time_after", "flight_time"),
    ("vx_in", "vy_in", "vx_out", "vy_out"), ("normalised_spin_in", "normalised_spin_out"),
)  # fmt: skip
# The components that a quantity gives: where one of these has a column, the quantity is passed on unread
TARGETS = {
    **dict.fromkeys(("speed_in", "drop_height", "peak_height", "time_before", "flight_time", "vx_in", "vy_in"), ("v_n_in",)),
    **dict.fromkeys(("speed_out", "e_n", "rebound_height", "time_after", "vx_out", "vy_out"), ("v_n_out",)),
    **dict.fromkeys(("incidence", "incidence_from_surface"), ("v_t_in",)),
    **dict.fromkeys(("reflection", "reflection_from_surface", "e_t", "e_x", "beta"), ("v_t_out",)),
    "normalised_spin_in": ("spin_in", "spin_z_in"), "normalised_spin_out": ("spin_out", "spin_z_out"),
}  # fmt: skip
SEQUENCE = ("ball", "drop", "film", "shot", "surface")  # columns that divide times in a row into sequences
# Series of one ball (:func:`carom.data.headers.series_headings`): the quantities before and after the contact between two of it
SERIES = {
    "height": ("drop_height", "rebound_height"), "speed": ("speed_in", "speed_out"),
    "flight time": ("time_before", "time_after"), "angle": ("incidence", "reflection"),
}  # fmt: skip
MOST_RISING = 0.1  # of the values of a series: of more, each column is another measurement of one bounce


@dataclass
class WrittenComponents:
    """Columns of :func:`carom.data.make_rebounds`, with what was assumed."""

    columns: dict[str, Array]
    notes: list[str] = field(default_factory=list)
    planar: bool = False
    """Whether the form alone says that the ball was in flight."""
    rows: NDArray[np.int64] | None = None
    """Rows of the table from which the rebounds come, if they are not all."""
    extra: dict[str, NDArray[Any]] = field(default_factory=dict)
    """(N,) which rebounds are bounces of one ball in a row."""
    directions: NDArray[np.bool_] | None = None
    """(N,) rows of which only the direction after is known, whose v_t_out is in units of the speed after; None: none."""


def components(
    measured: Measured, ball: tuple[float, float] | None, extra: Mapping[str, Any], faults: FaultList
) -> WrittenComponents:
    """Return measured quantities as components.

    Parameters
    ----------
    measured : mapping
        (N,) by name, SI: columns of rebounds, and those of :data:`WRITTEN`, ``sigma_...`` among them.
    ball : (radius, kappa), optional
        Which normalised spins and ratios of slips need.
    extra : mapping
        Other columns, as text.
    faults : FaultList
        Takes what is missing or contradicts itself.
    """
    found = _Conversion(dict(measured), ball, faults, WrittenComponents({}))
    if not any(name in measured for form in _FORMS for name in form) and not any(" " in name for name in measured):
        if measured and not any(name.removeprefix("sigma_").startswith("v_") for name in measured):
            faults.add(
                "columns", "a velocity before the wall", "spins alone",
                "where a ball slides its spin changes by friction (1 + restitution) v_n_in / (kappa a): with v_n_in and v_t_in"
                " spins identify that product, without them nothing",
            )  # fmt: skip
        return WrittenComponents(dict(measured))
    found.series()
    found.surface_angles()
    found.plane()
    found.heights(extra)
    found.times(extra)
    found.polar(extra)
    found.ratios()
    found.spins()
    columns = {
        name: column for name, column in found.have.items() if name.removeprefix("sigma_") not in WRITTEN_COLUMNS
    }
    if not any(name in columns for name in ("v_n_in", "v_t_in")):
        given = shortened_list([name for name in measured if not name.startswith("sigma_")])
        faults.add(
            "columns",
            "a velocity before the wall (v_n_in, or speed_in and incidence, or a ratio e_n with incidence)",
            given,
        )
    found.result.columns = columns
    return found.result


class _Conversion:
    """Quantities so far, each with its error bar; a step takes those of a form away and adds components."""

    def __init__(
        self, have: dict[str, Array], ball: tuple[float, float] | None, faults: FaultList, result: WrittenComponents
    ) -> None:
        self.have, self.ball, self.faults, self.result = have, ball, faults, result
        self.taken, self.ways = "", {name: name for name in have}

    def take(self, name: str) -> tuple[Array, Array] | None:
        """Return a quantity with its error bar (NaN: none), and remove it; None where it was not measured."""
        if name not in self.have:
            return None
        value, self.taken = self.have.pop(name), name
        return value, self.have.pop(f"sigma_{name}", np.full(len(value), np.nan))

    def put(self, name: str, value: Array, sigma: Array) -> None:
        """Add a component, with an error bar where one is known."""
        if name in self.have:
            ways = f"{self.ways[name]} and {self.taken}"
            self.faults.add("columns", f"one way to {name}", f"two, {ways}", "leave one of them out")
            return
        self.have[name], self.ways[name] = value, self.taken
        known = np.isfinite(sigma) & (sigma > 0)
        if known.any():
            self.have[f"sigma_{name}"] = np.where(
                np.isnan(value), np.nan, np.where(known, sigma, np.median(sigma[known]))
            )

    def series(self) -> None:
        """Take a series of one ball as pairs: a value is that after a contact, and that before the next."""
        for kind, (before, after) in SERIES.items():
            numbers = sorted(int(name.rpartition(" ")[2]) for name in self.have if name.rpartition(" ")[0] == kind)
            if not numbers:
                continue
            names = [f"{kind} {k}" for k in numbers]
            value, sigma = (np.stack(part, axis=-1) for part in zip(*map(self.take, names), strict=True))
            others = [name for name in self.have if not name.startswith("sigma_")]
            with np.errstate(invalid="ignore"):
                rising = int((value[:, 1:] > value[:, :-1]).sum())
            if len(names) > 2 and (kind == "angle" or others):
                got = f"{len(names)} of them" + f" beside {shortened_list(others)}" * bool(others)
                self.faults.add(
                    f"columns {kind}", "two, before and after one contact, or a series of a ball alone", got
                )
                return
            if kind != "angle" and rising > MOST_RISING * np.isfinite(value[:, 1:]).sum():
                got = f"{rising} that rise"
                self.faults.add(f"columns {kind}", "values that fall from bounce to bounce of one ball", got,
                                "write measurements of one bounce as rows")  # fmt: skip
            pairs = np.isfinite(value[:, :-1] + value[:, 1:]) | (len(names) == 2)
            rows, which = np.nonzero(pairs)
            self.have = {name: column[rows] for name, column in self.have.items()} | {
                before: value[rows, which], f"sigma_{before}": sigma[rows, which],
                after: value[rows, which + 1], f"sigma_{after}": sigma[rows, which + 1],
            }  # fmt: skip
            self.ways |= {before: names[0], after: names[-1]}
            if len(names) > 2:
                self.result.rows, self.result.planar = rows, True
                self.result.extra = {"drop": rows + 1, "bounce": np.array(numbers)[which] - numbers[0] + 1}
                said = f"{names[0]} to {numbers[-1]}: taken as those of one ball from bounce to bounce, {len(rows)} bounces"
                self.result.notes.append(said)

    def surface_angles(self) -> None:
        """Take angles from the surface as 90 degrees less those from the normal."""
        for name in ("incidence", "reflection"):
            if (angle := self.take(f"{name}_from_surface")) is not None:
                self.put(name, math.pi / 2 - angle[0], angle[1])

    def plane(self) -> None:
        """Take x and y: the wall is normal to the component that changes its sign in all rows (y = 0 where neither or both do)."""
        parts = {name: part for name in _FORMS[4] if (part := self.take(name)) is not None}
        if not parts:
            return
        if missing := [name for name in _FORMS[4] if name not in parts]:
            self.faults.add(f"columns {', '.join(missing)}", "vx_in, vy_in, vx_out and vy_out", "only some of them")
            return
        turns = {k: bool((parts[f"v{k}_in"][0] * parts[f"v{k}_out"][0] < 0).all()) for k in "xy"}
        normal, along = ("x", "y") if turns["x"] and not turns["y"] else ("y", "x")
        into, away = parts[f"v{normal}_in"], parts[f"v{normal}_out"]
        toward = np.where(into[0] < 0, -1.0, 1.0)
        self.put("v_n_in", toward * into[0], into[1])
        self.put("v_n_out", -toward * away[0], away[1])
        for side in ("in", "out"):
            self.put(f"v_t_{side}", *parts[f"v{along}_{side}"])
        self.result.notes.append(
            f"the wall is taken as {normal} = 0: v{normal} is normal to it, v{along} is along it; slip is v_t - a spin"
        )

    def _in_a_row(self, what: str, each: tuple[Array, Array], sides: tuple[str, str], extra: Mapping[str, Any]) -> None:
        """Take values of one ball in a row, one for each flight, as those before and after the bounces between them."""
        labels = [tuple(extra[name][i] for name in SEQUENCE if name in extra) for i in range(len(each[0]))]
        pairs = np.array([i for i in range(len(labels) - 1) if labels[i] == labels[i + 1]], dtype=int)
        self.result.rows = pairs
        self.have = {name: column[pairs] for name, column in self.have.items()}
        for name, rows in zip(sides, (pairs, pairs + 1), strict=True):
            self.have[name], self.have[f"sigma_{name}"] = each[0][rows], each[1][rows]
        self.result.notes.append(f"{what} in a row are {len(pairs)} bounces")

    def heights(self, extra: Mapping[str, Any]) -> None:
        """Take the heights from which a ball fell and to which it rose, or heights in a row: v = (2 g h)^(1/2), without air."""
        if (peaks := self.take("peak_height")) is not None:
            self._in_a_row(f"height: {len(peaks[0])} heights", peaks, ("drop_height", "rebound_height"), extra)
        for name, to in (("drop_height", "v_n_in"), ("rebound_height", "v_n_out")):
            if (height := self.take(name)) is not None:
                if (height[0] < 0).any():
                    self.faults.add(f"column {name!r}", "heights of at least 0", f"{np.nanmin(height[0]):.4g} m")
                speed = np.sqrt(2 * GRAVITY * np.maximum(height[0], 0.0))
                self.put(to, speed, GRAVITY * height[1] / np.where(speed > 0, speed, 1.0))
                self._straight("heights")

    def times(self, extra: Mapping[str, Any]) -> None:
        """Take times of flight before and after a bounce, or times between bounces in a row: v = g t / 2, without air."""
        each = self.take("flight_time")
        if each is not None and any(name in self.have for name in ("v_n_in", "speed_in", "time_before")):
            # (of a ball whose speed before is known otherwise)
            self.have["time_after"], self.have["sigma_time_after"] = each
        elif each is not None:
            said = f"flight_time: {len(each[0])} times between bounces"
            self._in_a_row(said, each, ("time_before", "time_after"), extra)
        for name, to in (("time_before", "v_n_in"), ("time_after", "v_n_out")):
            if (time := self.take(name)) is not None:
                self.put(to, GRAVITY * time[0] / 2, GRAVITY * time[1] / 2)
                self._straight("times of flight")

    def _straight(self, what: str) -> None:
        self.result.planar = True
        note = f"{what}: taken as those of a ball that falls straight down on a level floor, without air"
        if note not in self.result.notes:
            self.result.notes.append(note)

    def polar(self, extra: Mapping[str, Any]) -> None:
        """Take speeds and angles from the normal; ``extra``: headers of columns that are not read."""
        angles = {side: self.take(name) for side, name in (("in", "incidence"), ("out", "reflection"))}
        for side, angle in angles.items():
            name = "incidence" if side == "in" else "reflection"
            if side == "out":
                self.normal_ratio(extra)
            speed = self.take(f"speed_{side}")
            self.taken = f"speed_{side}" if speed is not None else name
            if angle is None:
                if speed is not None:
                    self._speed_alone(side, speed, extra)
                continue
            self._check_angles(name, angle[0])
            cosine, sine = np.cos(angle[0]), np.sin(angle[0])
            if speed is None and f"v_n_{side}" in self.have:
                v_n = self.have[f"v_n_{side}"]
                self.put(f"v_t_{side}", v_n * sine / cosine, np.abs(v_n) / cosine**2 * angle[1])
                continue
            if speed is None:
                speed = np.ones(len(cosine)), np.full(len(cosine), np.nan)
                if side == "out":
                    speed[0][:] = np.nan
                else:
                    said = "taken as 1 m/s before the wall, which laws with constants do not depend on"
                    self._no_speed(said, extra)
            v, sigma_v, sigma_angle = speed[0], np.nan_to_num(speed[1]), np.nan_to_num(angle[1])
            unknown = np.isnan(speed[1]) & np.isnan(angle[1])
            alone = np.isnan(v) & np.isfinite(angle[0]) if side == "out" else np.zeros(len(v), bool)
            for part, to, turn in ((cosine, "n", sine), (sine, "t", cosine)):
                sigma = np.where(unknown, np.nan, np.hypot(part * sigma_v, v * turn * sigma_angle))
                if to == "t" and alone.any():
                    self._directions(alone)
                    self.put("v_t_out", np.where(alone, part, v * part), np.where(alone, turn * angle[1], sigma))
                elif not alone.all():
                    self.put(f"v_{to}_{side}", v * part, sigma)

    def _directions(self, alone: NDArray[np.bool_]) -> None:
        self.result.directions, self.result.planar = alone, True
        self.result.notes.append(
            f"no speed after the wall is given in {alone.sum()} of {len(alone)} rows, which are read as contacts of a ball in"
            " flight (of one on a table add its speed after): v_t_out is in units of the speed after, the sine of the angle"
        )

    def _speed_alone(self, side: str, speed: tuple[Array, Array], extra: Mapping[str, Any]) -> None:
        if (angle := next(filter(ANGLE_WORDS.search, extra), None)) is not None and side == "in":
            self.faults.add(
                f"column {angle!r}",
                "a name of an angle that is read (incidence_deg, reflection_deg, or incidence_from_surface_deg)", "another name",
                "rename it; without an angle the speed would be that along the wall's normal",
            )  # fmt: skip
        v, along = speed[0], self.have.get(f"v_t_{side}")
        if along is not None:
            v_n = np.sqrt(np.maximum(v * v - along * along, 0.0))
            self.put(f"v_n_{side}", v_n, speed[1] * v / np.where(v_n > 0, v_n, 1.0))
        elif side == "out" and ("v_n_in" not in self.have or np.nan_to_num(self.have.get("v_t_in", v * 0)).any()):
            self.faults.add("column 'speed_out'", "an angle beside it (reflection_deg)", repr(angle) if angle else "none",
                            "balls that came in obliquely have a speed along the wall")  # fmt: skip
        else:
            self.put(f"v_n_{side}", *speed)
            self.result.notes.append(f"speed_{side} without an angle: taken as normal to the wall")

    def _no_speed(self, said: str, extra: Mapping[str, Any]) -> None:
        """Note that a speed is taken; a fault where something else has a unit, such as spins."""
        absolute = [name for name in self.have if name.startswith(("spin", "v_", "speed"))]
        if absolute := [name for name in absolute if np.nan_to_num(self.have[name]).any()]:
            near = next(filter(SPEED_WORDS.search, extra), None)
            self.faults.add("columns", "a speed before the wall (speed_in)", f"none beside {shortened_list(absolute)}",
                            f"is it {near!r}? rename it" if near else "")  # fmt: skip
        self.result.notes.append(f"no speed is given: {said}")

    def _check_angles(self, name: str, angle: Array) -> None:
        most = math.pi / 2 if name == "incidence" else math.pi / 2 + 0.2
        if (np.abs(angle) > most).any():
            worst = math.degrees(float(np.nanmax(np.abs(angle))))
            self.faults.add(f"column {name!r}", "angles from the normal, below 90 degrees", f"{worst:.4g}",
                            f"angles from the surface are called {name}_from_surface")  # fmt: skip

    def normal_ratio(self, extra: Mapping[str, Any]) -> None:
        """Take the ratio of the normal speeds after and before."""
        if (normal := self.take("e_n")) is None:
            return
        if "v_n_in" not in self.have:
            count = len(normal[0])
            self._no_speed("taken as 1 m/s, normal to the wall, before it", extra)
            self.put("v_n_in", np.ones(count), np.full(count, np.nan))
        self.put("v_n_out", normal[0] * self.have["v_n_in"], normal[1] * self.have["v_n_in"])
        self.result.planar = True

    def ratios(self) -> None:
        """Take the other ratios of speeds after and before: e_t of the centre, e_x (Cross) and beta (Walton) of the slip."""
        along = self.take("e_t")
        if along is not None and "v_t_in" not in self.have:
            wanted = "v_t_in, or an angle of incidence, beside it"
            self.faults.add(
                "column 'e_t'",
                wanted,
                "none",
                "an angle from the normal is called incidence_deg, one from the surface incidence_from_surface_deg",
            )
        elif along is not None:
            # (v_t_out is 0 where v_t_in is)
            v_t = self.have["v_t_in"]
            self.put("v_t_out", along[0] * v_t, along[1] * np.abs(v_t))
            self.result.notes.append(
                "e_t: taken as v_t_out / v_t_in of the ball's centre; e_x and beta are ratios of the slip"
            )
        for name, who in (
            ("e_x", "Cross, Am. J. Phys. 70, 482 (2002)"),
            ("beta", "Walton & Braun, J. Rheol. 30, 949 (1986)"),
        ):
            if (ratio := self.take(name)) is None:
                continue
            if self.ball is None or "v_t_in" not in self.have:
                self.faults.add(f"column {name!r}", "the ball's radius and v_t_in, from which the slip follows", "none")
                continue
            # both: -(slip after) / (slip before), 1 for a superball; v_t + kappa a spin is conserved
            a, kappa = self.ball
            spin = a * self.have.get("spin_in", np.zeros(len(ratio[0])))
            slip = self.have["v_t_in"] - spin
            after = (self.have["v_t_in"] + kappa * spin - kappa * ratio[0] * slip) / (1 + kappa)
            self.put("v_t_out", after, np.abs(kappa / (1 + kappa) * slip) * ratio[1])
            self.result.notes.append(
                f"{name}: taken as -(slip after) / (slip before) ({who}): -1 is no friction, 0 sticks, 1 is a superball"
            )

    def spins(self) -> None:
        """Take spins as multiples of v/a, v the speed at the same side of the contact."""
        for side in ("in", "out"):
            if (spin := self.take(f"normalised_spin_{side}")) is None:
                continue
            if self.ball is None or f"v_n_{side}" not in self.have or f"v_t_{side}" not in self.have:
                self.faults.add(f"column 'normalised_spin_{side}'", "the ball's radius and its speed there", "none")
                continue
            unit = np.hypot(self.have[f"v_n_{side}"], self.have[f"v_t_{side}"]) / self.ball[0]
            self.put(f"spin_{side}", spin[0] * unit, spin[1] * unit)
