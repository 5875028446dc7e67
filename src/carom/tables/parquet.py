"""Parquet tables, some rows at a time, by way of pyarrow (the extra ``carom[parquet]``)."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.tables.plan import Plan
from carom.tables.text import Piece

__all__ = ["ParquetTable"]

Array = NDArray[np.float64]
ROWS_AT_ONCE = 1 << 17


class ParquetTable:
    """A Parquet file; columns of any type pass through, those that are read must hold numbers."""

    def __init__(self, path: Path) -> None:
        """Open a file and read its headers; CaromError where it is none of this kind."""
        try:
            import pyarrow as pa
            import pyarrow.parquet as pq
        except ImportError:
            message = f"{path}: expected pyarrow, to read Parquet, got none; pip install pyarrow, or use a CSV file"
            raise CaromError(message) from None
        self.path = path
        self.pa, self.pq = pa, pq
        try:
            # no read-ahead: a file that is one large row group is still read a page at a time
            self.file = pq.ParquetFile(path, buffer_size=1 << 20, pre_buffer=False)
        except (pa.ArrowException, OSError, ValueError) as error:
            raise CaromError(f"{path}: expected a Parquet file, got: {str(error).splitlines()[0]}") from None
        self.schema = self.file.schema_arrow
        self.headers: list[str] = list(self.schema.names)
        self.size = max(self.file.metadata.num_rows, 1)
        self.done = 0.0
        self.writer: Any = None

    def __enter__(self) -> ParquetTable:
        """Use in a with block: the file is closed at its end."""
        return self

    def __exit__(self, *_: object) -> None:
        """Close the file."""
        self.file.close()

    def pieces(self, plan: Plan) -> Iterator[Piece]:
        """The rows, some at a time."""
        types = self.pa.types
        faults = []
        for source in plan.sources.values():
            kind = self.schema.field(source.index).type
            if not (types.is_floating(kind) or types.is_integer(kind) or types.is_decimal(kind)):
                faults.append(f"column {source.header!r}: expected numbers, got {kind}; write it as a float column")
        if faults:
            raise CaromError(*faults)
        start = 0
        try:
            for batch in self.file.iter_batches(ROWS_AT_ONCE):
                if not batch.num_rows:
                    continue
                notes: dict[int, str] = {}
                columns = {
                    name: self._numbers(batch.column(s.index), s.header, notes) for name, s in plan.sources.items()
                }
                yield Piece(columns, notes, _namer(start), batch)
                start += batch.num_rows
                self.done = start
        except self.pa.ArrowException as error:
            raise CaromError(f"{self.path}: expected a whole Parquet file, got: {str(error).splitlines()[0]}") from None

    def _numbers(self, column: Any, header: str, notes: dict[int, str]) -> Array:
        values: Array = column.cast(self.pa.float64(), safe=False).to_numpy(zero_copy_only=False)
        if column.null_count:
            for i in np.flatnonzero(np.asarray(column.is_null())).tolist():
                fault = f"{header}: expected a number, got an empty cell"
                notes[i] = f"{notes[i]}; {fault}" if i in notes else fault
        return values

    def write_head(self, file: BinaryIO, plan: Plan) -> None:
        """Begin the file: the table's own columns, then the new ones."""
        pa = self.pa
        fields = [
            *self.schema,
            *(pa.field(added.header, pa.float64()) for added in plan.added),
            pa.field(plan.note, pa.string()),
        ]
        self.out_schema = pa.schema(fields, metadata=self.schema.metadata)
        self.writer = self.pq.ParquetWriter(file, self.out_schema)

    def write(self, file: BinaryIO, piece: Piece, added: list[Array]) -> None:
        """The rows of a piece with the answer; null where there is none."""
        pa = self.pa
        notes = pa.nulls(piece.rows.num_rows, pa.string())
        if piece.notes:
            notes = pa.array([piece.notes.get(i) for i in range(piece.rows.num_rows)], pa.string())
        columns = [*piece.rows.columns, *(pa.array(column, from_pandas=True) for column in added), notes]
        self.writer.write_batch(pa.record_batch(columns, schema=self.out_schema))

    def finish(self) -> None:
        """Close the file's footer."""
        self.writer.close()

    def give_up(self) -> None:
        """Let go of a file that will not be kept."""
        if self.writer is not None:
            with contextlib.suppress(self.pa.ArrowException, OSError, ValueError):
                self.writer.close()


def _namer(start: int) -> Callable[[int], str]:
    return lambda i: f"row {start + i + 1}"
