"""The code and the inputs of a job as an archive for workers that share no disk with this process.

    workbench_upload_<digest>/__init__.py    unpacks the rest on a worker, once (`upload_start.py`), and what else is
                                             imported there
    code/workbench/...                       this package
    tree/home/me/proofs/mine2026/...         the folders and files that this process knows, by their whole paths
"""

from __future__ import annotations

import hashlib
import io
import zipfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from workbench.errors import InputError
from workbench.files.modules import known_folders
from workbench.files.regular import LARGEST_DATA, contents, size_words
from workbench.files.text import inputs_read, sources_read

PACKAGE = Path(__file__).parents[1]
START = Path(__file__).with_name("upload_start.py")
LEFT_OUT = ("__pycache__", "certificates")
LARGEST_UPLOAD = 256 * 2**20


@dataclass(frozen=True)
class Archive:
    """The bytes of an archive; name: of the package in it; roots: what its paths begin with, of all that is in it."""

    name: str
    data: bytes
    roots: frozenset[Path]


def archive(modules: Mapping[str, Path]) -> Archive:
    """Of this package and of all that this process has imported from folders, or read, so far.

    modules: what workers import besides, by the names in the archive's own package. Raises InputError where it would
    be larger than LARGEST_UPLOAD.
    """
    folders = known_folders()
    files = {path.resolve() for path in (*inputs_read(), *sources_read()) if path.is_file()}
    own = {f"code/{PACKAGE.name}/{path.relative_to(PACKAGE).as_posix()}": path for path in _files(PACKAGE)}
    entries = own | {f"tree{path.as_posix()}": path for path in files}
    for folder in folders.values():
        size = 0
        for path in _files(folder):
            size += path.stat().st_size
            if size > LARGEST_UPLOAD:
                raise InputError(folder, "", f"holds more than {size_words(LARGEST_UPLOAD)}, the most that is sent to "
                                 "a cluster: put the paper, or the file, into a folder of its own")
            entries[f"tree{path.as_posix()}"] = path
    held = {name: contents(path, LARGEST_DATA) for name, path in sorted(entries.items())}
    started = {"__init__": contents(START)} | {name: contents(path) for name, path in modules.items()}
    digest = hashlib.sha256()
    for name, data in (started | held).items():
        digest.update(f"{name} {len(data)} ".encode() + data)
    package = f"workbench_upload_{digest.hexdigest()[:16]}"
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as made:
        for name, data in started.items():
            made.writestr(f"{package}/{name}.py", data)
        for name, data in held.items():
            made.writestr(name, data)
    return Archive(package, stream.getvalue(), frozenset({*folders.values(), *files}))


def _files(folder: Path) -> Iterator[Path]:
    """The files of a folder that a worker may need; none that is too large to be read."""
    for path in sorted(folder.rglob("*")):
        parts = path.relative_to(folder).parts
        if (not any(part.startswith(".") or part in LEFT_OUT for part in parts) and path.is_file()
                and path.stat().st_size <= LARGEST_DATA):
            yield path


@contextmanager
def temporary_archive(made: Archive) -> Iterator[Path]:
    """The archive as a file, while the block lasts."""
    with TemporaryDirectory(prefix="workbench-upload-") as folder:
        path = Path(folder) / f"{made.name}.zip"
        path.write_bytes(made.data)
        yield path


@contextmanager
def scratch_folder() -> Iterator[Path]:
    """A folder for what workers of this process are sent, while the block lasts."""
    with TemporaryDirectory(prefix="workbench-dask-", ignore_cleanup_errors=True) as folder:
        yield Path(folder)


def put_file(path: Path, data: bytes) -> None:
    """On a worker: a file of the sender's, where another process has not put it yet."""
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        with TemporaryDirectory(dir=path.parent) as aside:
            (Path(aside) / path.name).write_bytes(data)
            (Path(aside) / path.name).replace(path)
