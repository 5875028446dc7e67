"""List every number that README, paper and the pages of the docs state, with the line that made it.

    python docs/dev/stated.py           # counts by kind and page, and the numbers without a source
    python docs/dev/stated.py --all     # every number: page, line, kind, source
    python docs/dev/stated.py --check   # exit status 1 if a statement below differs from what is computed now

A number is made by one of these, tried in this order:

- cell: it stands in a cell that runs as the docs are built, and the build fails where the cell fails;
- code: it is an argument in a command or in code, or stands in a name;
- checked: one of ``STATEMENTS`` below computes it, from the library or from docs/benchmarks.md, and tests/test_stated.py compares;
- formula: it is a coefficient or an exponent of typeset mathematics;
- name: year, volume or page of a source, number of an equation, section or version;
- said: its paragraph, or the table with the paragraph before it, names the test, script or page that gives it; on pages of
  measurements its section names the command, or is made by its cells;
- given: how many were counted, at which angle, or which share of an interval: a condition of a result, in its own words;
- count: a whole number up to 12 in a sentence (an order, an index, a number of contacts): an argument, no measurement;
- record: the same number stands in a record of a run (campaigns/results.md; benchmarks.md, validation and datasets in docs).

Whatever is left is printed as without a source: a constant in an argument, or a result that no cell, script or record gives.
"""

from __future__ import annotations

import argparse
import inspect
import math
import re
import sys
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.util import module_from_spec, spec_from_file_location
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np

import carom
from carom.data import read_rebounds
from carom.fitting import evidence
from carom.fitting import identify as identifiability
from carom.fitting import model as tabulated
from carom.fitting import spins as spin_quadrature
from carom.gas import initial, session
from carom.gas.edmd import calendar, collisions
from carom.gas.species import CLASSES
from carom.laws import pair as hertz
from carom.simulation import cluster_steps

ROOT = Path(__file__).parents[2]
# All pages but the lists of the reference; the records of runs are sources themselves.
PAGES = (
    "README.md",
    "paper.md",
    "CONTRIBUTING.md",
    *sorted(
        str(page.relative_to(ROOT))
        for page in (ROOT / "docs").rglob("*.md")
        if not {"_build", "reference"} & set(page.parts) and page.name != "benchmarks.md"
    ),
)
RECORDS = (
    "docs/benchmarks.md",
    "campaigns/results.md",
    "docs/validation/*.md",
    "docs/datasets.md",
)
KINDS = ("cell", "code", "checked", "formula", "name", "said", "given", "record", "count", "no source")
NOUNS = (
    "(?:tables|rows|rebounds|bounces|balls|shots|spins|draws|directions|films|spheres|orbits|layouts|racks|windows|neighbours"
    "|frames|pixels|degrees\\sof\\sfreedom)"
)
GIVEN = re.compile(
    rf"\b(?:[Oo]f|[Ii]n|[Ww]ith|[Ff]or|from|and|to|than) (?:some |only |the |another )?\d[\d,]*(?=\s(?:[*a-z]+\s)?{NOUNS}\b)"
    r"|\d[\d,]*(?=\s(?:frames per second|random [a-z]+)\b)"
    r"|(?:\b[Aa]t|[Aa]bove|[Bb]elow|of|angles?|than)\s\d+(?=°|\sdegrees)"
    r"|\d+(?=\s%\sinterval)|\b\d+(?= to 1\b)|\b(?:68|95)(?=\s(?:and\s95\s)?%)"
    r"|\d+(?=\s(?:per\ssecond|to\s[-−]?\d+\sdegrees|degrees))"
)
NUMBER = re.compile(r"(?<![\w.,])[-−]?\d+(?:,\d{3})*(?:\.\d+)?(?:e-?\d+)?(?![\w])")
FENCE = re.compile(r"^(`{3,}|:{3,}).*?^\1[ \t]*$", re.MULTILINE | re.DOTALL)
INLINE = re.compile(r"`[^`\n]+`|\]\([^)\s]*\)|<[^>\n]*>|https?://\S+|\[@\w+\]|\{#.*?\}|\b[\w.]+/[\w./]+")
FORMULA = re.compile(
    r"\\begin\{(?:equation|align|aligned|gather)\*?\}.+?\\end\{(?:equation|align|aligned|gather)\*?\}[^\n]*|\$\$.+?\$\$|(?<![\w$])\$[^$]+?\$",
    re.DOTALL,
)
NAME = re.compile(
    r"\(\d+[a-z]?\)(?: (?:to|and) \(\d+[a-z]?\))*"  # equations
    r"|\b(?:sections?|equations?|chapter|Fig\.|figure|Table|lemma|theorem|version|seed|commit|page|pp?\.) \d[\d.]*"
    r"|\b(?:Python|pooltool|Numba|NumPy) \d[\d.]*(?:(?: to | and |, |–)\d[\d.]*)*"
    r"|(?:[A-Z][a-z]\w*\.?|\b[A-Z])\*? (?:[A-Z]\*? )?\d+[A-Z]?,\s[LR\d]\d*(?:[–-]\d+)?(?:,\s\d+)?(?=[\s,);])"  # Phys. E 61, 5573
    r"|\b\d+[A-Z]?,\s(?:19|20)\d\d,\s\d+"  # 37, 1969, 88
    r"|\(\d{4}\), \d+\.\d+\b|\b(?:1[6-9]|20)\d\d(?:-\d\d-\d\d)?[a-z]?\b|\b\d{4}\.\d{5}\b|^#+ [^\n]*|^\d+\. |\A---\n.*?^---$",
    re.MULTILINE | re.DOTALL,
)
SOURCE = re.compile(
    r"(?:tests|campaigns|benchmarks|docs|src)/[\w/]+\.(?:py|md)|`carom [a-z][^`]*`"
    r"|\]\([^)\s]*\)|\ba test\b|\bthe tests\b|[Tt]he cells? (?:above|below)"
)
COMMAND = re.compile(r"`?(?:python |carom [a-z])[^`\n]*|\bcode-cell\b")
SECTION = re.compile(r"^#{1,2} .*?(?=^#{1,2} |\Z)", re.MULTILINE | re.DOTALL)
WORDS = (
    *("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve"),
    *("thirteen", "fourteen", "fifteen", "sixteen", "seventeen", "eighteen", "nineteen", "twenty"),
)


@dataclass(frozen=True)
class Statement:
    """A sentence of a page whose numbers, the groups of the pattern, are computed again; ``source`` says by what."""

    page: str
    pattern: str
    computed: Callable[[], Sequence[float]]
    source: str

    def printed(self) -> list[str]:
        """The numbers of the sentence as they stand, wherever its lines break."""
        found = self.search()
        return [] if found is None else list(found.groups())

    def search(self) -> re.Match[str] | None:
        return re.search(self.pattern.replace(" ", r"\s+"), text(self.page), re.DOTALL)

    def wrong(self) -> str:
        """What differs between the sentence and the computation; empty where they agree to the printed digits."""
        printed, computed = self.printed(), self.computed()
        if len(printed) != len(computed):
            return f"{self.page}: no sentence like: {self.pattern}"
        if all(agrees(a, b) for a, b in zip(printed, computed, strict=True)):
            return ""
        now = ", ".join(f"{x:.5g}" for x in computed)
        return f"{self.page}: {', '.join(printed)} printed in: {self.pattern}; {self.source} gives {now}"


def agrees(printed: str, value: float) -> bool:
    """Whether a number is the value rounded to the digits that are printed; a word of a count is that count."""
    plain = str(WORDS.index(printed) if printed in WORDS else printed).replace(",", "").replace("−", "-")
    digits = len(plain.partition(".")[2])
    return abs(float(plain) - value) <= 0.5 * 10.0**-digits * (1 + 1e-9)


@cache
def text(page: str) -> str:
    return (ROOT / page).read_text(encoding="utf-8")


# --- from the library -----------------------------------------------------------------------------------------------
def example() -> list[float]:
    """The paper's example: incidence, final angles of the conventional and the two-step law, degrees, and the hop, mm."""
    comparison = carom.compare()
    by_law = {one.law: one for one in comparison.verdicts}
    two = by_law["two-step"]
    return [
        comparison.incident_angle_deg,
        by_law["conventional"].reflection_angle_deg,
        two.reflection_angle_deg,
        1e3 * two.as_dict()["flight"]["height"],
    ]


def rack() -> list[float]:
    """Balls and events of the break that the table pool-9ft comes with."""
    scene = carom.load_scene("pool-9ft")
    return [len(scene.balls), len(carom.simulate(scene).events)]


def measured(name: str) -> list[float]:
    """Shots, least and largest measured value, RMS and largest deviation of a row of the README's table."""
    row = next(row for row in beside_measurements() if row[0] == name)
    return [float(x) for cell in row[2:] for x in cell.split(" to ")]


@cache
def beside_measurements() -> list[tuple[str, ...]]:
    """The table that docs/dev/measured.py prints; its pictures are not saved."""
    script = beside("measured")
    script.save = lambda figure, _name: script.plt.close(figure)
    return [*script.mathavan(), *script.kharaz()]


def beside(name: str) -> Any:
    """A script of this folder, as a module of its own."""
    spec = spec_from_file_location(f"stated_{name}", Path(__file__).with_name(f"{name}.py"))
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


# --- from the tables of the docs ----------------------------------------------------------------------------------
def rows(page: str) -> Iterator[list[str]]:
    """The cells of the page's tables, row by row."""
    for line in text(page).splitlines():
        if line.startswith("| "):
            yield [cell.strip() for cell in line.strip("|").split("|")]


def benchmark(work: str) -> tuple[float, float]:
    """carom's time, s, and how many times as long the peer takes, of a row of docs/benchmarks.md."""
    cells = next(row for row in rows("docs/benchmarks.md") if row[0] == work)
    size, unit = cells[1].split()[:2]
    ratio = cells[3].partition(" ")[0]
    times = float(ratio[2:]) if ratio.startswith("1/") else 1 / float(ratio) if ratio else math.nan
    return float(size) * {"ns": 1e-9, "µs": 1e-6, "ms": 1e-3}[unit], times


MIRROR = ("a shot, one ball, mirror", "a shot, three balls, mirror")
NOSES = ("a shot, one ball, two-step, nose at 37 mm", "a shot, three balls, two-step, nose at 37 mm")


def ratios() -> list[float]:
    """Least and largest of pooltool's times over carom's: among noses, among mirror cushions."""
    return [choose(benchmark(work)[1] for work in group) for group in (NOSES, MIRROR) for choose in (min, max)]


def shots() -> list[float]:
    """Least and largest time of a shot: carom's, µs, and pooltool's, ms."""
    both = [benchmark(work) for work in (*NOSES, *MIRROR)]
    ours, theirs = [1e6 * a for a, _ in both], [1e3 * a * b for a, b in both]
    return [min(ours), max(ours), min(theirs), max(theirs)]


def gas_ratios() -> list[float]:
    """Least and largest ratio to EDMD and to DynamO, least and most balls, of the table of docs/theory/gas.md."""
    table = [
        row for row in rows("docs/theory/gas.md") if {"smooth", "rough"} & set(row[1:3]) and row[0] != "balls"
    ]  # balls, gas, ...
    edmd = [float(row[4]) for row in table if row[1] == "smooth" and row[4]]
    dynamo, balls = [float(row[-1]) for row in table], [int(row[0].replace(",", "")) for row in table]
    return [min(edmd), max(edmd), min(dynamo), max(dynamo), min(balls), max(balls)]


def law_of_films(law: str, column: int) -> float:
    """A number of the table of results on docs/validation/which_law.md, by docs/dev/real_angles.py."""
    cells = next(row for row in rows("docs/validation/which_law.md") if row[0].startswith(law))
    return float(cells[column])


def fitted() -> list[float]:
    cells = next(row for row in rows("docs/validation/which_law.md") if row[0].startswith("two-step, wall and floor"))
    return [float(re.findall(rf"{name} ([\d.]+)", cells[1])[0]) for name in ("e", "friction")]


def speed_dependent() -> list[float]:
    """Gain in AICc of a restitution that depends on speed, least and most of three laws; odds of the best law over springs."""
    above: dict[str, list[float]] = {}
    for row in rows("docs/theory/cushions.md"):
        if len(row) == 5 and "e = " in row[1]:
            above.setdefault(row[0], []).append(float(row[3]))
    gains = [constant - falling for falling, constant in above.values()]
    return [min(gains), max(gains), math.exp(above["`stronge-cushion`"][0] / 2)]


def rebounds() -> list[float]:
    """Rebounds of filmed balls that the fits use, and those together with the row that is left out."""
    use = list(read_rebounds(ROOT / "docs" / "data" / "carom_tracks_rebounds.csv").extra["use"])
    return [use.count("yes"), use.count("yes") + use.count("reversed")]


def corner() -> list[float]:
    """The least friction that wedges a ball between the floor and a cushion that touches it at 7/5 of the radius."""
    return [math.sqrt((1 - 0.4) / (1 + 0.4))]


def pool_balls() -> list[float]:
    """How long two balls of pool touch at 1 and at 9.5 m/s, microseconds."""
    spring = hertz.stiffness(hertz.contact_modulus(5.84e9, 0.34), 0.028575, 0.028575)
    return [1e6 * hertz.contact_time(0.085, spring, speed) for speed in (1.0, 9.5)]


def cue() -> list[float]:
    """The default cue: mass in ounces, end mass in g, restitution, friction."""
    one = carom.Cue()
    return [one.mass / 28.349523e-3, 1e3 * one.end_mass, one.restitution, one.friction]


def tennis() -> list[float]:
    """Restitution by the heights of a tennis ball dropped from 1.5 m, k = 0.02 per metre, and the true one."""
    g, k, height, true = 9.80665, 0.02, 1.5, 0.75
    down = g / k * (1 - math.exp(-2 * k * height))
    return [math.sqrt(math.log(1 + k * true**2 * down / g) / (2 * k) / height), true]


def final_angles() -> list[float]:
    """Least and largest final angle of the paper's example, degrees."""
    angles = [one.reflection_angle_deg for one in carom.compare().verdicts if one.reflection_angle_deg is not None]
    return [min(angles), max(angles)]


def snooker() -> list[float]:
    """Speed after a snooker cushion over that before, %: least, largest and median measured; Han's law at e = 1, at most."""
    cushions = beside("cushions")
    columns = cushions.datasets.load("mathavan2009").columns
    ratio = 100 * columns["v_n_out_m_s"] / columns["v_n_in_m_s"]
    one = np.ones(1)
    most = max(cushions.snooker("han2005", one, one, friction)[0] for friction in (0.5, 1.0, 3.0))
    return [ratio.min(), ratio.max(), np.median(ratio), 100 * most]


def above_in(table: Sequence[str], law: str, column: int) -> float:
    """The least number in a column of the law's rows of a table on docs/theory/cushions.md, whose header begins as given."""
    found, inside, named = [], False, ""
    for cells in rows("docs/theory/cushions.md"):
        if cells[:1] == ["law"]:
            inside = cells[: len(table)] == list(table)
        elif inside:
            named = cells[0].strip("`") or named
            if named == law:
                found.append(float(cells[column].replace("−", "-")))
    return min(found)


def han_behind() -> list[float]:
    """How far Han's cushion is behind in AICc: of the snooker balls, and of the filmed shots."""
    square_on, filmed = ("law", "numbers", "RMS, m/s"), ("law", "numbers", "scatter, % of the speed")
    return [above_in(square_on, "han2005", 3) - above_in(square_on, "mathavan2010", 3), above_in(filmed, "han2005", 3)]


def few_spins() -> list[float]:
    """Coverage, %, of one and of 1.96 error bars of mean and width of n normal numbers: n = 20, n = 60, 20 without the factor."""
    from scipy import stats

    found: list[float] = []
    for n, factor in ((20, 1 + 0.75 / 20), (60, 1 + 0.75 / 60), (20, 1.0)):
        share = 1 / math.sqrt(2 * n)  # the width's error bar over the width
        of_mean = stats.t(n - 1, scale=1 / (factor * math.sqrt((n - 1) / n)))
        found += [100 * (2 * of_mean.cdf(k) - 1) for k in (1, 1.96)]
        of_square = stats.chi2(n - 1, scale=factor**2 / n)
        found += [
            100 * (of_square.cdf((1 - k * share) ** -2) - of_square.cdf((1 + k * share) ** -2)) for k in (1, 1.96)
        ]
    return found


COUNTS = "len(carom.LAWS), len(carom.compare().verdicts)"
TABLE, FILMS = "docs/benchmarks.md", "docs/validation/which_law.md"
STATEMENTS = (
    Statement("docs/howto/tracks.md", r"restitution of ([\d.]+) instead of ([\d.]+)\. It", tennis, "flights with drag"),
    Statement("docs/tutorials/first_steps.md", r"lie between (\d+) and (\d+) degrees", final_angles, "carom.compare"),
    Statement(
        "docs/howto/gas.md",
        r"More than (\d+) different radii are divided into (\d+) classes",
        lambda: 2 * [CLASSES],
        "carom.gas.species",
    ),
    Statement(
        "docs/howto/aim.md",
        r"([\d,]+) starts \(Sobol\)",
        lambda: [inspect.signature(carom.aim).parameters["starts"].default],
        "carom.aim",
    ),
    *(
        Statement(f"docs/theory/{page}.md", pattern, lambda value=value: [value], source)
        for page, pattern, value, source in (
            ("gas", r"takes some (\d+) samples", session.SAMPLES, "carom.gas.session"),
            ("gas", r"reset every (\d+) collisions per ball", initial.STAGE, "carom.gas.initial"),
            ("gas", r"a ball that has (\d+) contacts in a row", collisions.PATIENCE, "carom.gas.edmd.collisions"),
            ("pairs", r"and Kennedy\), (\d+) a contact", cluster_steps.STEPS, "carom.simulation.cluster_steps"),
            ("fitting", r"has risen by ([\d.]+) \(99", identifiability.FLAT_RISE, "carom.fitting.identify"),
            ("fitting", r"From (\d+) rows without spin on", tabulated.LEAST_ROWS, "carom.fitting.model"),
            ("fitting", r"normal prior by (\d+) to 1", evidence.DECIDED, "carom.fitting.evidence"),
            (
                "fitting",
                r"evaluated at (\d+) values",
                len(spin_quadrature.sigma_grid()),
                "carom.fitting.spins",
            ),
        )
    ),
    Statement(
        "docs/theory/cushions.md",
        r"come back with (\d+) to (\d+) % of their speed, half of them with more than (\d+) %\. .*? returns (\d+) % at most",
        snooker,
        "docs/dev/cushions.py",
    ),
    Statement(
        "docs/theory/cushions.md",
        r"by (\d+) in AICc .*? loses by (\d+) on another",
        han_behind,
        "the tables of the page",
    ),
    Statement(
        "docs/theory/cushions.md",
        r"normal, (\d+) % of the ball's",
        lambda: [100 * math.sqrt(0.84)],
        "the height of the nose",
    ),
    Statement(
        "docs/theory/fitting.md",
        r"the mean in ([\d.]+) and ([\d.]+) % and the width in ([\d.]+) and ([\d.]+) % .*? for 60 spins in ([\d.]+) and ([\d.]+),"
        r" ([\d.]+) and ([\d.]+) %\. .*? for 20 is ([\d.]+) and ([\d.]+), ([\d.]+) and ([\d.]+) %",
        few_spins,
        "SciPy's distributions",
    ),
    Statement(
        "docs/theory/pressed.md", r"1 for a vertical wall and ([\d.]+) for a cushion at 7/5", corner, "its formula"
    ),
    Statement(
        "docs/theory/two_step.md",
        r"which is 4/35 = ([\d.]+) for the solid ball and 4/15 = ([\d.]+) for",
        lambda: [4 / 35, 4 / 15],
        "its formula",
    ),
    Statement("docs/theory/pairs.md", r"0\.95\$ this is ([\d.]+) even", lambda: [2 / 7 / 1.95], "its formula"),
    Statement("docs/theory/pairs.md", r"for (\d+) µs at 1 m/s and (\d+) µs at 9\.5", pool_balls, "carom.laws.pair"),
    Statement(
        "docs/theory/pairs.md",
        r"default cue \((\d+) oz, end mass (\d+) g, tip \$e = ([\d.]+)\$, \$\\mu = ([\d.]+)\$",
        cue,
        "carom.Cue()",
    ),
    Statement(
        "docs/theory/gas.md", r"balls in the (\d+) \(discs: (\d+)\) cells", lambda: [3**3, 3**2], "3 to the dimensions"
    ),
    Statement(
        "docs/theory/gas.md", r"two pages, of (\d+) bins each", lambda: [calendar.PAGE], "carom.gas.edmd.calendar"
    ),
    Statement("README.md", r"takes ([\d.]+) to ([\d.]+) µs; pooltool 0\.6 needs ([\d.]+) to ([\d.]+) ms", shots, TABLE),
    *(
        Statement(page, pattern, ratios, TABLE)
        for page, pattern in (
            ("paper.md", r"takes (\d+) to (\d+) times as long as carom .*? real noses and (\d+) to (\d+) times"),
            ("docs/comparison.md", r"carom is (\d+) to (\d+) times as fast .*? real noses, and (\d+) to (\d+) times"),
        )
    ),
    Statement(
        "paper.md",
        r"orbit in a circle takes ([\d.]+) times as long",
        lambda: [1 / benchmark("one no-slip orbit, circle")[1]],
        TABLE,
    ),
    Statement(
        "paper.md",
        r"(\d+) to (\d+) times as fast as EDMD .*? and (\d+) to (\d+) times as fast as DynamO at (\d+) to ([\d,]+) balls",
        gas_ratios,
        "docs/theory/gas.md",
    ),
    Statement("paper.md", r"outcome under (\w+) laws", lambda: [len(carom.LAWS)], COUNTS),
    *(
        Statement(page, r"under (\w+) published laws", lambda: [len(carom.LAWS)], COUNTS)
        for page in ("README.md", "docs/index.md")
    ),
    Statement("docs/index.md", r"compares (\w+) laws", lambda: [len(carom.compare().verdicts)], COUNTS),
    *(
        Statement(
            page,
            r"numbered \((\d+)\) to \((\d+)\)" if page[0] == "d" else r"Equations \((\d+)\) to \((\d+)\) of the paper",
            lambda: [1, beside("equations").LAST],
            "docs/dev/equations.py",
        )
        for page in ("docs/index.md", "paper.md")
    ),
    *(
        Statement(
            "docs/howto/predict.md",
            rf"\| {name} \|[^|]*\| (\d+) \| ([\d.]+) to ([\d.]+) \| ([\d.]+) \| ([\d.]+) \|",
            lambda row=name: measured(row),
            "docs/dev/measured.py",
        )
        for name in (
            "Mathavan 2009, below 1.5 m/s",
            "&nbsp;&nbsp; the same, above",
            "&nbsp;&nbsp; below, cushion alone, then the cloth",
            "Kharaz 2001, above 35°",
            "&nbsp;&nbsp; below 35°, β = 0",
        )
    ),
    Statement(
        "docs/validation/which_law.md",
        r"rejected, by (\d+) in AICc.*?rejected too\*\*, by (\d+)",
        lambda: [law_of_films("conventional", 3), law_of_films("two-step with", 3)],
        FILMS,
    ),
    Statement("README.md", r"to (\d+) rebounds", lambda: rebounds()[:1], "docs/data/carom_tracks_rebounds.csv"),
    Statement(
        "docs/validation/which_law.md",
        r"fit better, by (\d+) to (\d+), and springs at the nose come \[within (\d+) to 1",
        speed_dependent,
        "docs/theory/cushions.md",
    ),
    Statement("README.md", r"restitution ([\d.]+), friction ([\d.]+)\.\*\*", fitted, FILMS),
)


# --- every number ---------------------------------------------------------------------------------------------------
@dataclass(frozen=True)
class Stated:
    """A number of a page, its kind and what made it."""

    page: str
    line: int
    number: str
    kind: str
    source: str


def spans(pattern: re.Pattern[str], page: str) -> list[tuple[int, int, str]]:
    return [(m.start(), m.end(), m.group(0)) for m in pattern.finditer(text(page))]


@cache
def recorded() -> dict[str, list[str]]:
    """Where each number of three characters or more stands in the records."""
    found: dict[str, list[str]] = defaultdict(list)
    for pattern in RECORDS:
        for path in sorted(ROOT.glob(pattern)):
            for n, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                for number in NUMBER.findall(line):
                    if len(number) > 2:
                        found[number].append(f"{path.relative_to(ROOT)}:{n}")
    return found


def paragraphs(page: str) -> list[tuple[int, int, str]]:
    """Start, end and text of what stands between blank lines; a table has the paragraph before it as well."""
    found: list[tuple[int, int, str]] = []
    for m in re.finditer(r"(?:.+\n?)+", text(page)):
        before = found[-1][2] if found and m.group(0).startswith("|") else ""
        found.append((m.start(), m.end(), before + m.group(0)))
    return found


def stated(page: str) -> list[Stated]:
    """Every number of a page."""
    fences, codes, formulas, names, conditions = (spans(p, page) for p in (FENCE, INLINE, FORMULA, NAME, GIVEN))
    checked = []
    for one in STATEMENTS:
        if one.page == page and (found := one.search()):
            checked += [(found.start(k), found.end(k), one.source) for k in range(1, 1 + len(found.groups()))]
            # the sentence is searched with these numbers in it, as in "below 35°"
            words = NUMBER.finditer(found.group(0))
            checked += [
                (found.start() + m.start(), found.start() + m.end(), one.source)
                for m in words
                if m.group(0) in NUMBER.findall(one.pattern.replace("\\", ""))
            ]
    blocks = paragraphs(page)
    in_cells = {one for fence in fences if "code-cell" in fence[2] for one in NUMBER.findall(fence[2])}
    measured = page.startswith("docs/validation/") or page in ("docs/datasets.md", "docs/howto/predict.md")
    parts = spans(SECTION, page) if measured else []

    def inside(at: int, places: Sequence[tuple[int, int, str]]) -> str:
        return next((what for start, end, what in places if start <= at < end), "")

    def kind(at: int, number: str) -> tuple[str, str]:  # noqa: PLR0911
        if fence := inside(at, fences):
            head = fence.partition("\n")[0]
            return (
                ("cell", "executed as the docs are built")
                if "code-cell" in head
                else ("formula", "")
                if "math" in head
                else ("code", head.strip("`:"))
            )
        if source := inside(at, checked):
            return "checked", source
        for name, places in (("code", codes), ("formula", formulas), ("name", names)):
            if inside(at, places):
                return name, ""
        if source := SOURCE.search(inside(at, blocks)):
            return "said", source.group(0)
        if number in in_cells:
            return "cell", "stands in a cell of the page"
        if source := COMMAND.search(inside(at, parts)):
            return "said", source.group(0)
        if inside(at, conditions) or (number.isdigit() and int(number) <= 12):
            return ("given" if inside(at, conditions) else "count"), ""
        elsewhere = (place for place in recorded().get(number, ()) if place.partition(":")[0] != page)
        return ("record", place) if (place := next(elsewhere, "")) else ("no source", "")

    whole = text(page)
    return [
        Stated(
            page, whole.count("\n", 0, m.start()) + 1, m.group(0), *kind(m.start() + len(m.group(0)) - 1, m.group(0))
        )
        for m in NUMBER.finditer(whole)
    ]


def main(words: Sequence[str] | None = None) -> int:
    """Print the list; return 1 where ``--check`` finds a statement that is wrong."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--all", action="store_true", help="print every number")
    parser.add_argument("--check", action="store_true", help="compute the checked ones again")
    given = parser.parse_args(words)
    if given.check:
        faults = [fault for one in STATEMENTS if (fault := one.wrong())]
        print(*faults, sep="\n")
        return bool(faults)
    everything = [one for page in PAGES for one in stated(page)]
    if given.all:
        for one in everything:
            print(f"{one.page}:{one.line}: {one.number} [{one.kind}] {one.source}".rstrip())
    for (page, line), some in groupby(
        (one for one in everything if one.kind == "no source"), lambda one: (one.page, one.line)
    ):
        print(f"{page}:{line}: no source: {', '.join(one.number for one in some)}")
    print("\n| page | " + " | ".join(KINDS) + " |\n" + "|---" * (1 + len(KINDS)) + "|")
    for page in PAGES:
        count = Counter(one.kind for one in everything if one.page == page)
        print(f"| {page} | " + " | ".join(str(count[kind]) for kind in KINDS) + " |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
