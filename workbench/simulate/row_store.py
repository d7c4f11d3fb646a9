"""Where the rows of a Monte Carlo are kept: in memory, or as Parquet in chunks that a manifest names by their digests.

    sweep.manifest.jsonl    of which job, and for each chunk its number, its digest and the runs in it
    sweep/00000.parquet     rows of some runs; `select * from 'sweep/*.parquet'` in DuckDB reads them all

A chunk is named in the manifest before it is written, aside and renamed, so that whatever is killed leaves no chunk
that the manifest does not name. A chunk that is not what the manifest names is left out, with a note, and removed.
"""

from __future__ import annotations

import hashlib
import io
import time
from bisect import bisect_right
from collections import OrderedDict
from collections.abc import Iterator, Mapping, Sequence
from operator import itemgetter
from pathlib import Path
from types import TracebackType
from typing import Any, NamedTuple, Self

from workbench.errors import InputError
from workbench.files.cache_folder import note
from workbench.files.memory_limit import limited_memory
from workbench.files.regular import contents
from workbench.files.writing import remove_old, require_inside, set_aside, write_bytes
from workbench.simulate.journal import Journal
from workbench.simulate.sweep_rows import BLOCK, COLUMNS, Values

MANIFEST_NAME, CHUNKS = "sweep.manifest.jsonl", "sweep"
REMEDY, WITHOUT = "name another --out", "start anew without --resume, or name another --out"
# A chunk is written after so many seconds, which is what a kill can cost, or rows, which is what memory holds.
CHUNK_S, CHUNK_ROWS = 5.0, 32_768
CHUNKS_OPEN, LARGEST_PART = 3, 2 * CHUNK_ROWS


class Part(NamedTuple):
    """Some runs of one controller."""

    controller: str
    first: int
    runs: int

    @property
    def end(self) -> int:
        """The number of the run after the last."""
        return self.first + self.runs


class RowStore:
    """Rows in memory, in parts that do not overlap."""

    def __init__(self) -> None:
        self._parts: dict[str, list[Part]] = {}  # of each controller, in the order of their runs
        self._rows: dict[Part, Sequence[Values]] = {}

    def add(self, part: Part, rows: Sequence[Values]) -> None:
        """Keep the rows of a part, in the order of its runs."""
        self._place(part)
        self._rows[part] = rows

    def missing(self, controller: str, runs: int) -> Iterator[Part]:
        """The runs of a controller, of so many, that are not there."""
        reached = 0
        for part in self._parts.get(controller, ()):
            if reached < min(part.first, runs):
                yield Part(controller, reached, min(part.first, runs) - reached)
            reached = part.end
        if reached < runs:
            yield Part(controller, reached, runs - reached)

    def lacks(self, controllers: Sequence[str], runs: int) -> bool:
        """Whether a run is missing, of so many of each controller."""
        return any(True for name in controllers for _ in self.missing(name, runs))

    def rows(self, controller: str, first: int, end: int) -> list[Values]:
        """The rows of the runs from `first` to before `end`, which are all there."""
        parts, found = self._parts[controller], list[Values]()
        for part in parts[max(0, bisect_right(parts, first, key=itemgetter(1)) - 1):]:
            if part.first >= end:
                break
            found += self._of(part)[max(0, first - part.first):end - part.first]
        return found

    def blocks(self, controllers: Sequence[str], runs: int) -> Iterator[list[list[Values]]]:
        """Block by block the rows of each controller, in the order of the runs, which are all there."""
        for first in range(0, runs, BLOCK):
            yield [self.rows(name, first, min(first + BLOCK, runs)) for name in controllers]

    def _of(self, part: Part) -> Sequence[Values]:
        return self._rows[part]

    def _place(self, part: Part) -> None:
        parts = self._parts.setdefault(part.controller, [])
        parts.insert(bisect_right(parts, part.first, key=itemgetter(1)), part)

    def _overlaps(self, part: Part) -> bool:
        return sum(gap.runs for gap in self.missing(part.controller, part.end) if gap.end > part.first) < part.runs

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.close()

    def close(self) -> None:
        """Nothing more is added; what was added can still be read."""


class ChunkStore(RowStore):
    """Rows in a folder, those that are in no chunk yet in memory; settings, resume: as of `Journal`; columns: their
    names and types, "int", "float" or "str".

    Raises InputError as a journal does, and where a chunk cannot be read or written.
    """

    def __init__(self, folder: Path, settings: dict[str, Any], resume: bool,
                 columns: Mapping[str, str] = COLUMNS) -> None:
        super().__init__()
        self._columns = columns
        self._folder = folder / CHUNKS
        require_inside(self._folder, folder, REMEDY)
        self._places: dict[Part, tuple[int, int]] = {}  # chunk and row group
        self._open: OrderedDict[int, Any] = OrderedDict()
        self._written_s = time.monotonic()
        self._journal = Journal(folder / MANIFEST_NAME, settings, resume)
        try:
            if resume:
                self._load()
            else:
                for path in self._files():
                    set_aside(path, REMEDY)
        except BaseException:
            self._journal.close()
            raise

    def add(self, part: Part, rows: Sequence[Values]) -> None:
        """Keep the rows of a part; they are on the disk after CHUNK_S at the latest where others follow."""
        super().add(part, rows)
        if (time.monotonic() - self._written_s >= CHUNK_S
                or sum(len(kept) for kept in self._rows.values()) >= CHUNK_ROWS):
            self._write()

    def close(self) -> None:
        """Write what is in no chunk yet; InputError where that fails."""
        try:
            self._write()
        finally:
            self._journal.close()

    def _write(self) -> None:
        if not self._rows:
            return
        together = [(_joined(parts), parts) for parts in _adjacent(sorted(self._rows))]
        groups = [[row for part in parts for row in self._rows[part]] for _, parts in together]
        data, number = _parquet(groups, self._columns), self._journal.lines
        self._journal.append({"chunk": number, "sha256": hashlib.sha256(data).hexdigest(),
                              "parts": [list(part) for part, _ in together]})
        write_bytes(self._path(number), data, REMEDY)
        for place, (part, parts) in enumerate(together):
            self._parts[part.controller] = [p for p in self._parts[part.controller] if p not in parts]
            self._place(part)
            self._places[part] = number, place
        self._rows.clear()
        self._written_s = time.monotonic()

    def _load(self) -> None:
        """Take the chunks that are what the manifest names; the others, and those of damaged records, are removed."""
        whole = set()
        for record in self._journal.records:
            number, parts = self._read_record(record)
            if number in whole or any(map(self._overlaps, parts)):
                note(f"{self._journal.path}: names chunk {number} twice")
            elif self._digest(number) != record["sha256"]:
                note(f"{self._path(number)} is not what was written: its {sum(p.runs for p in parts)} runs are made "
                     "again")
            else:
                whole.add(number)
                for place, part in enumerate(parts):
                    self._place(part)
                    self._places[part] = number, place
        for number in set(range(self._journal.lines)) - whole:
            remove_old(self._path(number))
        for path in self._files():  # of records that a damaged manifest has lost; others would read their rows twice
            if int(path.stem) >= self._journal.lines:
                set_aside(path, REMEDY)

    def _read_record(self, record: dict[str, Any]) -> tuple[int, list[Part]]:
        """The number and the parts of a chunk; InputError for a record that this program would not have written, of
        which a forged digest says nothing."""
        try:
            number, parts = record["chunk"], [Part(*part) for part in record["parts"]]
            fits = isinstance(number, int) and all(
                isinstance(part.controller, str) and isinstance(part.first, int) and isinstance(part.runs, int)
                and part.first >= 0 and 0 < part.runs <= LARGEST_PART for part in parts)
        except (KeyError, TypeError):
            fits = False
        if not fits or not isinstance(record.get("sha256"), str):
            raise InputError(self._journal.path, "", f"holds a record that is no chunk of a sweep: {WITHOUT}")
        return number, parts

    def _digest(self, number: int) -> str:
        try:
            return hashlib.sha256(contents(self._path(number))).hexdigest()
        except FileNotFoundError:
            return ""
        except OSError as trouble:
            raise InputError(self._path(number), "", f"cannot be read ({trouble.strerror}): check its "
                             "permissions") from None

    def _of(self, part: Part) -> Sequence[Values]:
        if part in self._rows:
            return self._rows[part]
        number, place = self._places[part]
        try:
            with limited_memory():  # a small file may say that it holds any number of rows
                return _rows_of(self._chunk(number), place, part.runs, self._columns)
        except (ValueError, IndexError, OSError, MemoryError) as trouble:  # those of pyarrow are of these kinds
            raise InputError(self._path(number), "", f"is no chunk of a sweep ({str(trouble)[:80] or 'too large'}): "
                             f"{WITHOUT}") from None

    def _chunk(self, number: int) -> Any:
        """An open chunk; of all of them a few are held open."""
        if number not in self._open:
            from pyarrow import BufferReader, py_buffer  # noqa: PLC0415 - sweeps into a folder alone need it
            from pyarrow.parquet import ParquetFile  # noqa: PLC0415 - as above

            self._open[number] = ParquetFile(BufferReader(py_buffer(contents(self._path(number)))))
            if len(self._open) > CHUNKS_OPEN:
                self._open.popitem(last=False)
        self._open.move_to_end(number)
        return self._open[number]

    def _files(self) -> Iterator[Path]:
        """The chunks of whoever wrote here before."""
        return (path for path in sorted(self._folder.glob("*.parquet")) if path.stem.isdecimal())

    def _path(self, number: int) -> Path:
        return self._folder / f"{number:05d}.parquet"


def _adjacent(parts: list[Part]) -> Iterator[list[Part]]:
    """Parts in order, those of one block that follow each other together: what is read at once is written so."""
    together: list[Part] = []
    for part in parts:
        if together and (part[:2] != (together[-1].controller, together[-1].end) or part.first % BLOCK == 0):
            yield together
            together = []
        together.append(part)
    if together:
        yield together


def _joined(parts: list[Part]) -> Part:
    return Part(parts[0].controller, parts[0].first, sum(part.runs for part in parts))


def _rows_of(chunk: Any, place: int, count: int, columns: Mapping[str, str]) -> list[Values]:
    """The rows of a group, so many; ValueError where it has others, or other columns."""
    if chunk.schema_arrow != _schema(columns) or chunk.metadata.row_group(place).num_rows != count:
        raise ValueError("its rows or columns are others")
    # Threads of pyarrow may be there still as the process ends, which then aborts; a group is read in no time.
    read = chunk.read_row_group(place, use_threads=False)
    return list(zip(*read.to_pydict().values(), strict=True))


def _schema(columns: Mapping[str, str]) -> Any:
    """The columns of a chunk and their types."""
    import pyarrow as pa  # noqa: PLC0415 - as above

    types = {"int": pa.int64(), "str": pa.string(), "float": pa.float64()}
    return pa.schema([(name, types[kind.partition(" ")[0]]) for name, kind in columns.items()])


def _parquet(groups: Sequence[Sequence[Values]], columns: Mapping[str, str]) -> bytes:
    """The bytes of a Parquet file with a row group for each of the groups."""
    import pyarrow as pa  # noqa: PLC0415 - as above
    from pyarrow.parquet import ParquetWriter  # noqa: PLC0415 - as above

    schema = _schema(columns)
    stream = io.BytesIO()
    with ParquetWriter(stream, schema, compression="zstd") as writer:
        for rows in groups:
            arrays = [pa.array(values, field.type) for values, field in zip(zip(*rows, strict=True), schema,
                                                                            strict=True)]
            writer.write_table(pa.Table.from_arrays(arrays, schema=schema), row_group_size=max(1, len(rows)))
    return stream.getvalue()
