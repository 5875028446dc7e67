"""Output of ``carom tracks show`` with --balls: the contacts of balls with each other, and the same as JSON."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from rich.console import Console

from carom.cli.tracks_output import MAX_ROWS, tell_counts, uncertain
from carom.formatting import json_value

if TYPE_CHECKING:
    from carom.tracks.pair_contacts import PairContact

__all__ = ["pair_facts", "tell_pairs"]


def pair_facts(one: PairContact) -> dict[str, Any]:
    """Return a contact of two balls as JSON."""
    from carom.tracks.pair_model import PAIR_OUTPUTS

    found: dict[str, Any] = {"group": one.group, "striking": one.striking, "struck": one.struck, "t": json_value(one.time),
                             "why_not": one.why}  # fmt: skip
    if one.fit is not None:
        found |= {
            "restitution": list(one.restitution), "friction": list(one.friction), "chi2": one.fit.chi2, "dof": one.fit.dof,
            "names": list(PAIR_OUTPUTS), "values": json_value(one.fit.value), "covariance": json_value(one.fit.covariance),
        }  # fmt: skip
    return found


def tell_pairs(console: Console, films: Sequence[tuple[str, Sequence[PairContact]]]) -> None:
    """Print the contacts of balls with each other of some films, each with its name, and why the others were not measured."""
    from rich.table import Table

    table = Table(box=None, padding=(0, 1, 0, 0), header_style="dim")
    for i, head in enumerate(("ball", "strikes", "t, s", "v_n in", "v_t in", "v_n out", "out/in", "friction")):
        table.add_column(head, justify="left" if i < 2 else "right", no_wrap=True)
    whys, total, shown = [], 0, 0
    for film, contacts in films:
        total += len(contacts)
        whys += [one.why for one in contacts if one.fit is None]
        for one in contacts:
            fit = one.fit
            if fit is None or (shown := shown + 1) > MAX_ROWS:
                continue
            label = " ".join(filter(None, (film, one.group, one.striking)))
            parts = uncertain(fit["v1n_out"] - fit["v2n_out"], 2 * fit.error("jn"))
            before = (uncertain(sign * fit[name], fit.error(name)) for sign, name in ((-1, "vn_in"), (1, "vt_in")))
            table.add_row(
                label,
                one.struck,
                f"{one.time:.4f}",
                *before,
                parts,
                uncertain(*one.restitution),
                uncertain(*one.friction),
            )
    console.print(
        "\nBalls that strike balls at rest, m/s: v_n along the line of centres, relative, before (towards each other) and after"
        " (apart), v_t across it; out/in: restitution; friction: impulse across the line over that along it",
        soft_wrap=True,
    )
    tell_counts(console, table, shown, total, whys)
