"""Format numbers, lengths and times for people: three significant digits, and the unit that suits the size; names as text."""

from __future__ import annotations

import html
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import is_dataclass
from typing import Any, Literal, NamedTuple, SupportsFloat

# What steers a terminal and is no text: C0 without tab and new line, C1, line separators, changes of the writing direction, and
# the halves of characters that stand for bytes of a file's name.
_CONTROLS = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff]")

# Cells of a column of numbers: also a dash, or nothing, where there is none.
_BEGINS_A_NUMBER = re.compile(r"[-−+±<>]?\d|[-−]?(inf|nan)|[-–—]?$")


def escape_controls(text: str) -> str:
    r"""Return a text in which control characters are written out, so that a name cannot steer the terminal.

    >>> print(escape_controls("\x1b[31mred"))
    \x1b[31mred
    """
    return _CONTROLS.sub(lambda found: ascii(found[0])[1:-1], text)


def json_value(value: Any, *, infinite: bool = False) -> Any:
    """Return a value as JSON has it: arrays as lists, records as dictionaries, undefined and infinite numbers as None.

    With ``infinite``, infinities are the texts "inf" and "-inf".

    >>> import numpy as np
    >>> json_value({"size": np.array([1.0, np.nan]), "friction": np.inf}, infinite=True)
    {'size': [1.0, None], 'friction': 'inf'}
    """
    if hasattr(value, "tolist"):  # an array, or a number of NumPy
        value = value.tolist()
    if isinstance(value, float):
        if math.isfinite(value):
            return float(value)
        return None if not infinite or math.isnan(value) else "inf" if value > 0 else "-inf"
    if is_dataclass(value) and not isinstance(value, type):
        value = vars(value)
    if isinstance(value, Mapping):
        return {key: json_value(one, infinite=infinite) for key, one in value.items()}
    return [json_value(one, infinite=infinite) for one in value] if isinstance(value, list | tuple) else value


def counted(number: int, noun: str) -> str:
    """Return a number with its noun, in the plural unless it is 1.

    >>> counted(1, "frame"), counted(4200, "frame")
    ('1 frame', '4,200 frames')
    """
    return f"{number:,} {noun}{'' if number == 1 else 's'}"


def called_ball(name: str) -> str:
    """Return how a sentence calls a ball.

    >>> called_ball("2"), called_ball("ball 2")
    ('ball 2', 'ball 2')
    """
    return name if name.startswith("ball") else f"ball {name}"


def format_number(x: SupportsFloat | None, digits: int = 3) -> str:
    """Return ``digits`` significant digits without trailing zeros, one less with an exponent, and all before the decimal point; a
    dash for None or NaN, the sign of infinity for infinity.

    >>> format_number(0.28571), format_number(-14999.8508), format_number(1.5e-7), format_number(None)
    ('0.286', '-15000', '1.5e-07', '–')
    """
    x = math.nan if x is None else float(x)
    if math.isnan(x):
        return "–"
    if math.isinf(x):
        return "∞" if x > 0 else "−∞"
    if x != 0 and not 1e-3 <= abs(x) < 1e7:  # (as with an error)
        return f"{x:.{digits - 1}g}"
    places = digits if x == 0 else max(0, digits - 1 - math.floor(math.log10(abs(x))))
    text = f"{x:.{places}f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def format_uncertain(x: float, error: float) -> str:
    """Return a number with its standard error in the last digits, two of them; without one if it is zero, or rounding.

    >>> format_uncertain(1.22918, 0.00123), format_uncertain(1512.3, 123.0), format_uncertain(4.5e-30, 2e-31)
    ('1.2292(12)', '1512(123)', '4.50(20)e-30')
    >>> format_uncertain(20000.0, 0.0), format_uncertain(float("nan"), 1.0)
    ('20,000', '–')
    """
    if not error > 1e-12 * abs(x) or math.isinf(error):
        return f"{x:,.0f}" if x.is_integer() and abs(x) < 1e15 else format_number(x, 6)
    size = max(abs(x), error)
    power = 0 if 1e-3 <= size < 1e7 else math.floor(math.log10(size))
    x, error = x / 10.0**power, error / 10.0**power
    places = max(1 - math.floor(math.log10(error)), 0)
    return f"{x:.{places}f}({error * 10**places:.0f})" + (f"e{power:+03d}" if power else "")


def format_length(x: SupportsFloat, digits: int = 3) -> str:
    """Return a length given in m as text in m, mm or µm.

    >>> format_length(0.02625, 4), format_length(-2.0)
    ('26.25 mm', '-2 m')
    """
    x = float(x)
    for size, unit, factor in ((1.0, "m", 1.0), (1e-3, "mm", 1e3), (0.0, "µm", 1e6)):
        if abs(x) >= size:
            return f"{format_number(x * factor, digits)} {unit}"
    return "0 m"


def format_time(x: SupportsFloat) -> str:
    """Return a time given in s as text in s or ms.

    >>> format_time(0.25), format_time(12.0)
    ('250 ms', '12 s')
    """
    x = float(x)
    return f"{format_number(x)} s" if x >= 1 else f"{format_number(x * 1e3)} ms"


def format_bytes(count: float) -> str:
    """Return a number of bytes with its unit.

    >>> format_bytes(65536), format_bytes(2.5e13)
    ('65.5 kB', '25 TB')
    """
    for unit in ("B", "kB", "MB", "GB"):
        if count < 1000:
            return f"{count:.3g} {unit}"
        count /= 1000
    return f"{count:,.3g} TB"


class Listing(NamedTuple):
    """A table of text with heads: what a result shows in a terminal, as its ``repr``, and in a notebook.

    >>> Listing(["law", "angle, deg"], [["<mirror>", "45"]], "One law.")
    law       angle, deg
    <mirror>          45
    One law.
    """

    heads: Sequence[str]
    rows: Sequence[Sequence[str]]
    note: str = ""

    @property
    def sides(self) -> list[Literal["left", "right"]]:
        """Where the cells of each column stand: numbers to the right, words to the left."""
        columns = list(zip(*self.rows, strict=True)) or [("",)] * len(self.heads)
        return ["right" if all(map(_BEGINS_A_NUMBER.match, column)) else "left" for column in columns]

    def __repr__(self) -> str:
        """Return it in columns."""
        heads = [head.split("\n") for head in self.heads]
        depth = max(map(len, heads))
        lines = [*zip(*([""] * (depth - len(head)) + head for head in heads), strict=True), *self.rows]
        widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
        sides = ["<" if side == "left" else ">" for side in self.sides]
        text = ["  ".join(map("{:{}{}}".format, line, sides, widths)).rstrip() for line in lines]
        return "\n".join([*text, *filter(None, [self.note])])

    def _repr_html_(self) -> str:
        sides = self.sides

        def row(cells: Sequence[str], tag: str) -> str:
            sided = zip(cells, sides, strict=True)
            inside = (f'<{tag} style="text-align: {side}">{html.escape(cell)}</{tag}>' for cell, side in sided)
            return f"<tr>{''.join(inside)}</tr>"

        body, note = "".join(row(cells, "td") for cells in self.rows), f"<p>{html.escape(self.note)}</p>"
        return f"<table><thead>{row(self.heads, 'th')}</thead><tbody>{body}</tbody></table>{note * bool(self.note)}"
