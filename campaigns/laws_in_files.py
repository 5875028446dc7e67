"""Laws in every text field: no file of any kind, given to any of its readers, runs a Python file that it names.

    python campaigns/laws_in_files.py [N] [--only KIND]

Scenes, gases, sweeps and their stores, saved runs, checkpoints, starts, shots of pooltool's, films of all formats and tables, with
"evil.py:law" in the place of each of their texts in turn and in a key ``law`` of each table, to every command and function that
reads them; with N, the first N cases of each kind. Of texts whose places differ in a number, all (the tests take the first).
Counts how often a reader answered and refused. A fault is a law that ran, a file that is left after a refusal, and any other
exception. Ends with 1 if there is a fault.
"""

from __future__ import annotations

import itertools
import tempfile
import warnings
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from campaign import campaign
from reference.laws_in_files import KINDS, cases, tried

GOOD = ("answered", "refused")
ALL = 1_000_000


def main(words: Sequence[str] | None = None) -> int:
    """Count answers by kind; 1 if one is a fault."""
    faults = 0
    with campaign("laws_in_files", __doc__, words, count=ALL, small=2) as run, tempfile.TemporaryDirectory() as folder:
        for kind in KINDS:
            if not run.wants(kind, KINDS):
                continue
            found, bad = Counter[str](), Counter[str]()
            files = 0
            for case in itertools.islice(cases(kind, every=not run.small), run.count):
                files += 1
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    for one in tried(case, Path(folder) / "here"):
                        found[one.answer if one.answer in GOOD else "fault"] += 1
                        if one.answer not in GOOD:
                            bad[f"{one.reader}, {case.kind}, {case.place}: {one.answer}"] += 1
            run.say(
                f"{kind:11} {files:5,} files, {found['answered']:6,} times answered, {found['refused']:6,} refused,"
                f" {found['fault']:,} faults"
            )
            for line in list(bad)[:10]:
                run.say(f"    {line}")
            faults += found["fault"]
    return 1 if faults else 0


if __name__ == "__main__":
    raise SystemExit(main())
