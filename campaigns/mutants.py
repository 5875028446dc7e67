"""Mutants: one place of the code changed at random; do the tests of its room notice?

    python campaigns/mutants.py [N] [--first 0] [--only ROOM] [--rows FILE] [--again] [--work FOLDER]

N mutants (25) of each room, from the number ``first`` on. A mutant is the package with one operator, comparison, condition, sign
or number changed; it is killed if a test of its room fails, or takes ten times as long. First the tests of each room run without
a mutant: they must pass, and it is noted which functions each of them reaches, and how long it takes, with kernels as plain
Python and compiled. Then each mutant is shown to the tests that reach its function, the shortest first: those that are quick as
plain Python, then the others, with the loops compiled anew that it changes, and only these. What survives and is judged to mean
the same stands, with the reason, in campaigns/equivalent_mutants.txt; every other survivor is a test that is missing. ``--again``
shows survivors to the tests anew.
"""

from __future__ import annotations

import ast
import sys
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path

from campaign import ROOT, Campaign, Row, campaign
from mutation.places import draw
from mutation.runs import Copy, NotGreenError

# The tests that a mutant of a room is shown to: its own, and what else tests it.
ROOMS = {
    "laws": ("laws",),
    "core": ("core", "laws", "simulation", "billiards"),
    "simulation": ("simulation", "cli/test_cli_simulate.py"),
    "billiards": ("billiards",),
    "scene": ("scene", "simulation"),
    "gas": ("gas",),
    "tracks": ("tracks",),
    "fitting": ("fitting",),
}
EQUIVALENT = Path(__file__).with_name("equivalent_mutants.txt")


def judged_equivalent() -> set[str]:
    """Return the mutants that mean the same, as "path | line of code | before -> after"."""
    lines = EQUIVALENT.read_text(encoding="utf-8").splitlines()
    return {line.rsplit(" | ", 1)[0] for line in lines if line and not line.startswith("#")}


def main(words: Sequence[str] | None = None) -> None:
    """A line a room, and one for each survivor."""
    again = {"action": "store_true", "help": "try survivors anew"}
    first = {"type": int, "default": 0, "help": "number of the first mutant of each room"}
    work = {"type": Path, "default": ROOT / "build" / "mutants", "help": "folder for the copy and for what is compiled"}
    with campaign("mutants", __doc__, words, count=25, small=1, again=again, first=first, work=work) as run:
        rooms = [room for room in ROOMS if run.wants(room, ROOMS)]
        if run.small:
            only_drawn(run, rooms)
        else:
            try:
                with closing(Copy(ROOT, run.given.work)) as copied:
                    try_all(run, rooms, copied)
            except NotGreenError as error:
                sys.exit(f"carom: mutants: {error}")
            for room in rooms:
                report(run, room)


def numbers(run: Campaign) -> range:
    """Return the numbers of the mutants of each room."""
    return range(run.given.first, run.given.first + run.count)


def only_drawn(run: Campaign, rooms: Sequence[str]) -> None:
    """Say which mutants there would be."""
    for room in rooms:
        for number in numbers(run):
            mutant = draw(ROOT / "src" / "carom", room, number)
            ast.parse(mutant.source)
            run.say(f"{room}: {mutant.about}")


def try_all(run: Campaign, rooms: Sequence[str], copied: Copy) -> None:
    """Try mutants that are not known yet, one of each room in turn."""

    def one(room: str, number: int) -> Row:
        mutant, tests = draw(copied.package, room, number), copied.baseline(ROOMS[room])
        copied.control(mutant, tests)
        fate = copied.try_mutant(mutant, tests)
        print(f"{room} {number}: {mutant.about}: {fate}", file=sys.stderr, flush=True)
        return {"mutant": mutant.about, "text": mutant.text, "fate": fate}

    wanted = [(room, number) for number in numbers(run) for room in rooms]
    run.go_through(wanted, one, again=lambda row: bool(run.given.again) and row["fate"] == "survived")


def report(run: Campaign, room: str) -> None:
    """A line for a room, and one for each survivor."""
    known = judged_equivalent()
    rows = [run.rows.known[room, number] for number in numbers(run) if (room, number) in run.rows.known]
    survived = [row for row in rows if row["fate"] == "survived"]
    left = [row["mutant"] for row in survived if identity(row) not in known]
    killed, same = len(rows) - len(survived), len(survived) - len(left)
    share = 100 * killed / max(len(rows) - same, 1)
    run.say(f"{room:12} {len(rows)} mutants: {killed} killed, {same} equivalent, {len(left)} survived ({share:.0f} %)")
    for about in left:
        run.say(f"    {about}")


def identity(row: Row) -> str:
    """Return what a mutant changes, and in which line of code: its number would not last."""
    path, _line, change = row["mutant"].split(":", 2)
    return f"{path} | {row.get('text', '')} | {change.strip()}"


if __name__ == "__main__":
    main()
