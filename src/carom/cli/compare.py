"""``carom compare``: predictions of laws for one incoming ball, as a table and one sentence per law."""

from __future__ import annotations

import math
import textwrap
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from carom.cli.options import OUTPUT, comma_separated, option, require_outputs, shared, tick, wrote
from carom.cli.parameters import Given, of_library
from carom.cli.streams import say_json, say_notes
from carom.formatting import format_length, format_number
from carom.public.own_laws import with_own_laws

if TYPE_CHECKING:
    from carom.laws.comparison import Comparison, Verdict

MIN_WIDTH_WITH_SPIN = 116  # columns of the terminal from which the table has room for the spin


@of_library("laws.comparison:incoming")
def compare(
    *,
    given: Given,
    laws: Annotated[
        list[str] | None,
        option(OUTPUT, "Compare only these laws, or custom ones, my_law.py:law; may be repeated.", metavar="NAME,NAME"),
    ] = None,
    as_json: Annotated[bool, shared("json")] = False,
    plot: Annotated[Path | None, shared("plot")] = None,
) -> None:
    """Compare the predictions of laws for one incoming ball, and say which are admissible.

    The defaults are the paper's example.
    """
    from carom.laws import comparison as library
    from carom.laws.registry import find_law
    from carom.scene.openings import ball_notes

    # all errors at once, before anything is written
    found = given.faults
    require_outputs(found, {"--plot": plot})
    names = [name for text in laws or [] for name in comma_separated(text)]
    if laws and not names:
        found.add("--laws", "names of laws, NAME,NAME", "none", "omit the option to compare all laws")
    chosen = [found.attempt(find_law, with_own_laws(name)) for name in names] or None
    meeting = found.attempt(lambda: library.incoming(**given))
    found.raise_if_any()
    assert meeting is not None
    ball, speed = meeting.ball, math.hypot(*meeting.state.velocity[:2])
    say_notes(ball_notes("ball", ball.radius, ball.mass, speed, meeting.gravity))
    comparison = library.compare(meeting, chosen)
    if plot is not None:
        from carom import plot as pictures

        pictures.save(pictures.compare(comparison), plot)
        wrote(plot)
    if as_json:
        say_json(comparison.as_dict())
    else:
        show(comparison)


def show(comparison: Comparison) -> None:
    """Print the incoming ball, the table, and one sentence per law: why it may not apply, or what happens."""
    from rich.text import Text

    from carom.cli.console import out

    console = out()
    console.print(Text(_incoming(comparison)))
    console.table(comparison.table(console.width >= MIN_WIDTH_WITH_SPIN, (tick(console, True), tick(console, False))))
    laws: dict[tuple[bool, str], list[str]] = {}
    for verdict in comparison.verdicts:
        laws.setdefault((verdict.admissible, _sentence(verdict)), []).append(verdict.law)
    for (good, sentence), names in laws.items():
        head = f"{tick(console, good)} {', '.join(names)}:"
        lines = textwrap.wrap(f"{head} {sentence}", max(console.width, 40), subsequent_indent="  ")
        text = Text("\n".join(lines))
        text.stylize("bold green" if good else "bold red", 0, len(head))
        console.print(text)


def _incoming(comparison: Comparison) -> str:
    m = comparison.meeting
    v = m.state.velocity
    spin = ", ".join(format_number(0.0 if abs(x) < 1e-12 else x) for x in map(float, m.state.spin))
    lines = [
        f"State: {format_number(math.hypot(v[0], v[1]))} m/s at {comparison.incident_angle_deg:.2f}° from the wall's normal,"
        f" spin ({spin}) rad/s",
        f"Ball:  radius {format_length(m.ball.radius, 4)}, mass {format_number(m.ball.mass, 4)} kg,"
        f" I = {format_number(m.ball.kappa)} m a²",
        f"Wall:  restitution {format_number(m.wall.restitution)}, friction {format_number(m.wall.friction)}{_more(comparison)}",
        f"Floor: restitution {format_number(m.floor.restitution)}, friction {format_number(m.floor.friction)}",
    ]
    if v[2] != 0 or m.height > 0:
        lines[0] += (
            f"\n       {format_length(float(m.height))} above the floor, {format_number(float(v[2]))} m/s upwards"
        )
    return "\n".join(lines)


def _more(comparison: Comparison) -> str:
    m = comparison.meeting
    beta = m.wall.tangential_restitution
    more = f", tangential restitution {format_number(beta)}" if beta != 0 else ""
    if m.normal[2] != 0:
        more += f", touching {format_number(1 + m.height / m.ball.radius - float(m.normal[2]))} radii above the floor"
    return more


def _sentence(verdict: Verdict) -> str:
    if verdict.admissible:
        return "; ".join(verdict.remarks) or "no objection"
    parts = [*verdict.why]
    if verdict.after_wall is not None and verdict.final is None:
        parts += verdict.remarks[-1:]  # why the ball never rolls
    return "; ".join(parts)
