"""How many rows a second `carom predict` answers, CSV and Parquet.

python benchmarks/tables.py [rows]
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import numpy as np
from rows import alone, report, run_script, usually

import carom
from carom.data import PredictSettings, predict_table

GIVEN = {"restitution": 0.98, "friction": 0.14, "radius": 0.026, "mass": 0.14}
WANTED = {"csv": 80_000, "parquet": 1_000_000}  # rows/s


def write(path: Path, rows: int) -> None:
    """Write incoming states, three columns."""
    rng = np.random.default_rng(1)
    columns = {
        "v_n_in": rng.uniform(0.5, 3, rows).round(4),
        "v_t_in": rng.uniform(-2, 2, rows).round(4),
        "spin_in": rng.normal(0, 5, rows).round(3),
    }
    if path.suffix == ".csv":
        cells = (map(repr, column.tolist()) for column in columns.values())
        path.write_text(",".join(columns) + "\n" + "\n".join(map(",".join, zip(*cells, strict=True))) + "\n")
        return
    import pyarrow as pa
    import pyarrow.parquet as pq

    pq.write_table(pa.table(columns), path)


def main() -> None:
    rows = int(float(sys.argv[1])) if len(sys.argv) > 1 else usually(1_000_000, 50)
    settings = PredictSettings(carom.LAWS["two-step"], given=GIVEN)
    with tempfile.TemporaryDirectory() as folder:
        for kind, wanted in WANTED.items():
            table, out = Path(folder) / f"in.{kind}", Path(folder) / f"out.{kind}"
            try:
                write(table, rows)
            except ImportError as missing:
                print(f"  not measured: {missing}")
                continue
            row = alone(
                f"carom predict, {kind}, {rows:,} rows",
                lambda: predict_table(table, out, settings),  # noqa: B023
                count=rows,
                unit="row",
                wanted=1e9 / wanted,
            )
            report(row)


if __name__ == "__main__":
    run_script(main)
