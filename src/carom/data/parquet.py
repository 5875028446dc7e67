"""Parquet tables, read and written in chunks with pyarrow (the extra ``carom[parquet]``)."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from carom.data.csv import TableChunk, row_label
from carom.data.plan import TablePlan
from carom.errors import CaromError
from carom.files import import_optional, open_regular, require_unpacked_size

__all__ = ["ParquetTable"]

Array = NDArray[np.float64]
CHUNK_ROWS = 1 << 17
CELL_BYTES = 8  # of a number in memory


class ParquetTable:
    """A Parquet file; columns of any type are copied; columns that are read must hold numbers."""

    def __init__(self, path: Path) -> None:
        """Open a file and read its headers. Raises CaromError for a file that is not Parquet."""
        pa, pq = (import_optional(name, str(path)) for name in ("pyarrow", "pyarrow.parquet"))
        self.path = path
        open_regular(path, "a Parquet file").close()
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
        """Return itself; the file is closed at the end of the with block."""
        return self

    def __exit__(self, *_: object) -> None:
        """Close the file."""
        self.file.close()

    def whole(self) -> Any:
        """Return the table in memory. Raises CaromError for a damaged file, and one that would fill the memory."""
        require_unpacked_size(self.path, CELL_BYTES * self.file.metadata.num_rows * len(self.headers))
        with self._complete():
            return self.file.read()

    @contextlib.contextmanager
    def _complete(self) -> Iterator[None]:
        try:
            yield
        except (self.pa.ArrowException, OSError) as error:
            got = str(error).splitlines()[0]
            raise CaromError(f"{self.path}: expected a complete Parquet file, got: {got}") from None

    def chunks(self, plan: TablePlan) -> Iterator[TableChunk]:
        """Iterate over the rows in chunks."""
        types = self.pa.types
        faults = []
        for source in plan.sources.values():
            kind = self.schema.field(source.index).type
            if not (types.is_floating(kind) or types.is_integer(kind) or types.is_decimal(kind)):
                faults.append(f"column {source.header!r}: expected numbers, got {kind}; write it as a float column")
        if faults:
            raise CaromError(*faults)
        start = 0
        with self._complete():
            for batch in self.file.iter_batches(CHUNK_ROWS):
                if not batch.num_rows:
                    continue
                notes: dict[int, str] = {}
                columns = {
                    name: self._numbers(batch.column(s.index), s.header, notes, name in plan.may_be_empty)
                    for name, s in plan.sources.items()
                }
                yield TableChunk(columns, notes, row_label(start), batch)
                start += batch.num_rows
                self.done = start

    def _numbers(self, column: Any, header: str, notes: dict[int, str], may_be_empty: bool) -> Array:
        values: Array = column.cast(self.pa.float64(), safe=False).to_numpy(zero_copy_only=False)
        if column.null_count and not may_be_empty:
            for i in np.flatnonzero(np.asarray(column.is_null())).tolist():
                fault = f"{header}: expected a number, got an empty cell"
                notes[i] = f"{notes[i]}; {fault}" if i in notes else fault
        return values

    def write_head(self, file: BinaryIO, plan: TablePlan) -> None:
        """Begin the output: the columns of the table, then the new ones."""
        pa = self.pa
        fields = [
            *self.schema,
            *(pa.field(added.header, pa.float64()) for added in plan.added),
            pa.field(plan.note, pa.string()),
        ]
        self.out_schema = pa.schema(fields, metadata=self.schema.metadata)
        # (a dictionary of numbers that are all different takes longer to make than the rest of the file, and is thrown away)
        repeated = [field.name for field in self.out_schema if not pa.types.is_floating(field.type)]
        self.writer = self.pq.ParquetWriter(file, self.out_schema, use_dictionary=repeated)

    def write(self, file: BinaryIO, chunk: TableChunk, added: list[Array]) -> None:
        """Write the rows of a chunk with the new columns; null for a row without an answer."""
        pa = self.pa
        notes = pa.nulls(chunk.rows.num_rows, pa.string())
        if chunk.notes:
            notes = pa.array([chunk.notes.get(i) for i in range(chunk.rows.num_rows)], pa.string())
        columns = [*chunk.rows.columns, *(pa.array(column, from_pandas=True) for column in added), notes]
        self.writer.write_batch(pa.record_batch(columns, schema=self.out_schema))

    def finish(self) -> None:
        """Write the footer."""
        self.writer.close()

    def abort(self) -> None:
        """Close an output that will not be kept."""
        if self.writer is not None:
            with contextlib.suppress(self.pa.ArrowException, OSError, ValueError):
                self.writer.close()
