"""List the external links of the documentation and the sources of the cards, and check their form; nothing is fetched.

    python docs/dev/links.py

One line for each: how often it stands, and where first. The exit status is 1 if a link is malformed: not https, or with a DOI or an
arXiv number of another form than theirs. It is no part of the tests: a link may be well formed and dead.
"""

from __future__ import annotations

import re
import sys
from collections import Counter
from pathlib import Path
from urllib.parse import urlsplit

import carom

ROOT = Path(__file__).parents[2]
LINK = re.compile(r"https?://[^\s<>\"'`\]}|]+")
DOI = re.compile(r"10\.\d{4,9}/\S+")
ARXIV = re.compile(r"(abs|pdf|html)/(\d{4}\.\d{4,5}|[a-z-]+/\d{7})(v\d+)?")


def links() -> tuple[Counter[str], dict[str, str]]:
    """Return how often each link stands, and the file where it stands first."""
    count: Counter[str] = Counter()
    where: dict[str, str] = {}
    pages = [page for page in (ROOT / "docs").rglob("*.md") if not {"_build", "jupyter_execute"} & set(page.parts)]
    for page in sorted([*ROOT.glob("*.md"), ROOT / "CITATION.cff", *pages]):
        for found in LINK.findall(page.read_text(encoding="utf-8")):
            link = found
            if "{" in link:  # made by a cell of the page, from what stands elsewhere
                continue
            while link[-1] in ".,;:*_" or (link[-1] == ")" and link.count("(") < link.count(")")):
                link = link[:-1]  # the end of a sentence, or of the parenthesis around it
            count[link] += 1
            where.setdefault(link, str(page.relative_to(ROOT)))
    for name, card in carom.CARDS.items():
        if card.doi:
            link = f"https://doi.org/{card.doi}"
            count[link] += 1
            where.setdefault(link, f"card {name}")
    return count, where


def fault(link: str) -> str:
    """Return what is wrong with a link; empty if nothing is."""
    parts = urlsplit(link)
    path = parts.path.lstrip("/")
    if parts.scheme != "https":
        return "expected https"
    if not re.fullmatch(r"([a-z0-9-]+\.)+[a-z]{2,}", parts.netloc):
        return "expected the name of a host"
    if parts.netloc in ("doi.org", "dx.doi.org") and not DOI.fullmatch(path):
        return "expected a DOI, 10.NNNN/..."
    if parts.netloc == "arxiv.org" and not ARXIV.fullmatch(path):
        return "expected abs/ and an arXiv number"
    return ""


def main() -> int:
    """Print the list; return the exit status."""
    count, where = links()
    wrong = 0
    for link in sorted(count):
        said = fault(link)
        wrong += bool(said)
        print(f"{count[link]:3}  {link}  ({where[link]})" + (f"  WRONG: {said}" if said else ""))
    print(f"{len(count)} links, {wrong} malformed")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
