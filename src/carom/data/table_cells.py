"""Cells of text tables as numbers: the one reader that all tables share, of films and of rebounds."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

EMPTY = frozenset({""})
# As programs and people write that there is no number; in lower case.
MISSING = frozenset({"", "nan", "na", "n/a", "n.a.", "#n/a", "null", "nil", "-", "--", "none", "<na>", ".", "?"})

# Java, spreadsheets and word processors write the minus sign of a language instead of ASCII's.
MINUS = "\u2212\u2010\u2011\u2012\u2013\u2014\u2796\ufe58\ufe63\uff0d"
PLUS = "\ufe62\uff0b"
# Marks of the direction of writing beside a sign, in Arabic, Hebrew and Persian; the mark of a byte order
INVISIBLE = "\u200b\u200c\u200d\u200e\u200f\u061c\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069\ufeff"
SIGNS = {
    **dict.fromkeys(map(ord, MINUS), "-"), **dict.fromkeys(map(ord, PLUS), "+"), **dict.fromkeys(map(ord, INVISIBLE)),
    0x96: "-", 0x97: "-", 0xDC96: "-", 0xDC97: "-", 0xDCA0: " ",  # (of Windows' code page, read as another)
    0x066B: ".", 0x066C: "'", 0x2019: "'", 0x00A0: " ", 0x202F: " ", 0x2009: " ", 0x2007: " ",
}  # fmt: skip
# Exponents in the languages that do not write E: Swedish and others x10^, Arabic the word for exponent
DIGITS_MISTYPED = str.maketrans("OoIl", "0011")
EXPONENT = re.compile(r"\s*(?:[\u00d7\u00b7*]\s*10\s*\^|\u0623\u0633|\u0627\u0633|[eE])\s*(?=[-+]?\d+$)")
SPREADSHEET = re.compile(r"sep=(.)\s*\n", re.IGNORECASE)  # the first line with which spreadsheets name the delimiter
COMMENT = re.compile(r" *#+ *(?=[^\s#,;|]|$)")  # the beginning of one; no column that is called #
GROUPED = re.compile(r"[-+]?\d{1,3}(?:([ ',.])\d{3})(?:\1\d{3})*(?!\d)")
COMMA = re.compile(r"[-+]?(\d*),(\d+)(?:[eE][-+]?\d+)?")


_PLUS_MINUS = re.compile(r"^(.{0,60}?)\s{0,9}(?:±|\+/-|\+-)\s{0,9}([\d.,]{1,60}(?:[eE][-+]?\d{1,9})?)\s{0,9}(%?)$")
_LAST_DIGITS = re.compile(r"^([-+]?\d{0,40}[.,]?\d{1,40})\((\d{1,40})\)$")
_HEADER_ERROR = re.compile(
    r"^(.{0,200}?\S)\s{0,9}[\[(]?\s{0,9}(?:±|\+/-|\+-)\s{0,9}(\d{0,40}[.,]?\d{1,40}(?:[eE][-+]?\d{1,9})?)\s{0,9}(%?)[^%]{0,99}$"
)
_RELATIVE = re.compile(r"^(.{0,200}?\S)\s{0,9}(?:[\[(]\s{0,9}%\s{0,9}[\])]|_percent|_pct|\s%)$", re.IGNORECASE)


class ParsedCells(NamedTuple):
    """A column of cells, as numbers."""

    values: NDArray[np.float64]
    """(n,); NaN where a cell is missing or no number."""
    bad: list[int]
    """Indices of the cells that are neither a number nor missing."""


def parse_numbers(
    cells: Sequence[str], *, decimal_comma: bool = False, missing: Collection[str] = MISSING
) -> ParsedCells:
    """Parse a column of cells as floats, as programs and spreadsheets of any language write them.

    Read are the minus signs and dashes of all scripts, digits of any script, exponents such as ``E-3`` and ``×10^−3``, and
    thousands that are separated by spaces, apostrophes, or the sign that is not the decimal one (``1.234,5``, ``1,234.5``).

    Parameters
    ----------
    cells : sequence of n str
    decimal_comma : bool
        Whether a lone comma is a decimal sign; points remain decimal signs as well.
    missing : collection of str
        What a cell without a number may hold, in lower case and without blanks around it.

    Examples
    --------
    >>> parse_numbers(["1,5", "", "x"], decimal_comma=True)
    ParsedCells(values=array([1.5, nan, nan]), bad=[2])
    >>> parse_numbers(["\\u22121.5", "1,234.5"]).values
    array([  -1.5, 1234.5])
    """
    if decimal_comma and any("," in cell for cell in cells):
        quick = [cell.replace(",", ".") if cell.count(",") == 1 and "." not in cell else cell for cell in cells]
    else:
        quick = list(cells)
    try:
        return ParsedCells(np.fromiter(map(_strict, quick), float, len(cells)), [])
    except ValueError:
        pass
    values, bad = np.full(len(cells), np.nan), []
    for k, cell in enumerate(cells):
        try:
            values[k] = _strict(plain_number(cell, decimal_comma))
        except ValueError:
            if cell.strip().lower() not in missing and plain_number(cell, decimal_comma).lower() not in missing:
                bad.append(k)
    return ParsedCells(values, bad)


def split_errors(
    cells: Sequence[str], *, decimal_comma: bool = False
) -> tuple[list[str], tuple[NDArray[np.float64], NDArray[np.bool_]] | None]:
    """Return cells without their error bars; and the error bars, NaN where there is none, with which of them are in per cent.

    Examples
    --------
    >>> cells, errors = split_errors(["7.83 ± 0.10", "5.2(3)", "4.1 +- 2 %", "3"])
    >>> cells, errors[0].round(3).tolist(), errors[1].tolist()
    (['7.83', '5.2', '4.1', '3'], [0.1, 0.3, 2.0, nan], [False, False, True, False])
    """
    plain, errors, percent = list(cells), np.full(len(cells), np.nan), np.zeros(len(cells), bool)
    for k, cell in enumerate(cells):
        if not cell or not any(sign in cell for sign in ("±", "+-", "+/-", "(")):
            continue
        text = cell.strip()
        if found := _PLUS_MINUS.match(text):
            plain[k], percent[k] = found[1], found[3] == "%"
            errors[k] = parse_numbers([found[2]], decimal_comma=decimal_comma).values[0]
        elif found := _LAST_DIGITS.match(text):
            plain[k] = found[1]
            places = len(re.split("[.,]", found[1])[1]) if re.search("[.,]", found[1]) else 0
            errors[k] = int(found[2]) / 10**places
    return plain, None if np.isnan(errors).all() else (errors, percent)


def header_error(header: str) -> tuple[float, bool, str] | None:
    """Return the error bar that a header states for its column, whether it is in per cent, and the header without it.

    >>> header_error("v_n_out [m/s] ± 0.10"), header_error("v_n_out ± 2 %"), header_error("v_n_out")
    ((0.1, False, 'v_n_out [m/s]'), (2.0, True, 'v_n_out'), None)
    """
    found = _HEADER_ERROR.match(header.strip())
    if found is None:
        return None
    return float(found[2].replace(",", ".")), found[3] == "%", found[1]


def relative_header(header: str) -> str:
    """Return the header of a column in per cent without the sign; empty where it is in a unit, or only its error bar in per cent.

    >>> relative_header("sigma_v_n_out [%]"), relative_header("sigma_v_n_out"), relative_header("v_n_out ± 2 %")
    ('sigma_v_n_out', '', '')
    """
    found = _RELATIVE.match(header.strip())
    return "" if found is None or header_error(header) else found[1]


def _strict(cell: str) -> float:
    """Return a number as Python reads it, but for underscores between digits."""
    if "_" in cell:
        raise ValueError
    return float(cell)


def plain_number(cell: str, decimal_comma: bool = False) -> str:
    """Return a cell with the signs that Python knows: ASCII minus, a decimal point, E, no separators of thousands.

    Examples
    --------
    >>> plain_number("\\u20121\\u202f234,5 ", decimal_comma=True), plain_number("8,3\\u00d710^\\u22123", decimal_comma=True)
    ('-1234.5', '8.3E-3')
    """
    text = EXPONENT.sub("E", cell.translate(SIGNS).strip())
    text = re.sub(r"^([-+])\s+(?=[\d.,])", r"\1", text)
    if text.endswith("-") and text[:-1].strip().replace(".", "").replace(",", "").isdecimal():
        text = "-" + text[:-1].strip()  # as some languages write it
    both = "," in text and "." in text
    decimal = ("," if text.rfind(",") > text.rfind(".") else ".") if both else "," if decimal_comma else "."
    found = GROUPED.match(text)
    if found and found[1] != decimal and (found[1] in " '" or both or found[0].count(found[1]) > 1):
        text = found[0].replace(found[1], "") + text[found.end() :]
    return text.replace(",", ".") if decimal == "," and text.count(",") == 1 else text


def decimal_commas(cells: Sequence[str]) -> bool:
    """Return whether commas in these cells are decimal signs: no number has a point, and a comma does not divide thousands.

    Examples
    --------
    >>> decimal_commas(["0,25", "1,5"]), decimal_commas(["1,234", "2,345"]), decimal_commas(["1,5", "2.5"])
    (True, False, False)
    """
    found = [one for cell in cells if "," in cell and (one := COMMA.fullmatch(plain_number(cell)))]
    if any(_pointed(cell) for cell in cells):
        return False
    return any(len(one[2]) != 3 or one[1] in ("", "0") for one in found)


def number_advice(cell: str) -> str:
    """Return the remedy, for a message, where a cell is no number."""
    if COMMA.fullmatch(plain_number(cell)):
        return "its comma may be a decimal sign or separate thousands: write numbers with a decimal point"
    plain = cell.strip()
    digits = plain.translate(DIGITS_MISTYPED)
    try:
        float(plain_number(digits))
    except ValueError:
        digits = plain
    return "write units in the header" if digits == plain else f"it has a letter in place of a digit: {digits!r}?"


def _pointed(cell: str) -> bool:
    text = cell.strip()
    return "." in text and text.translate(SIGNS).lstrip("-+")[:1].isdigit()
