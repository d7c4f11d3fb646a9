"""Commands of this version, and of an earlier one checked out elsewhere, each with files and caches of its own."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from descendants import seconds_of_all

ROOT = Path(__file__).resolve().parents[1]


@dataclass(frozen=True)
class Ended:
    """Seconds of the processor of a command and of what it started, its exit code, and all that it has said."""

    cpu_s: float
    code: int
    said: str


@dataclass(frozen=True)
class Version:
    """A checkout, and the folder that its commands work in, with the cache in it."""

    root: Path
    place: Path

    def once(self, *arguments: object, cache: str = "cache", options: tuple[str, ...] = ()) -> Ended:
        """One command. Paths below this checkout are those of the version's own. options: of Python."""
        return self._python([*options, "-m", "workbench", *map(self._own, arguments)], cache)

    def value(self, code: str) -> Any:
        """What the last line that a text in Python prints says as JSON, with the benchmarks at hand; None where it
        ends otherwise."""
        ended = self._python(["-c", code], "cache")
        return json.loads(ended.said.splitlines()[-1]) if ended.code == 0 else None

    def empty(self) -> None:
        """Forget what lies in the cache of cold commands."""
        shutil.rmtree(self.place / "empty", ignore_errors=True)

    def _own(self, argument: object) -> str:
        inside = isinstance(argument, Path) and argument.is_relative_to(ROOT)
        return str(self.root / argument.relative_to(ROOT)) if isinstance(argument, Path) and inside else str(argument)

    def _python(self, arguments: list[str], cache: str) -> Ended:
        said = self.place / "said.txt"
        # Where modules may not be kept compiled, each command would compile all of them: nobody who works so waits so.
        kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
        paths = os.pathsep.join((str(self.root), str(self.root / "benchmarks")))
        before = seconds_of_all()
        with said.open("wb") as out:
            process = subprocess.Popen([sys.executable, *arguments], cwd=self.place, stdout=out, stderr=out, env={
                **kept, "PYTHONPATH": paths, "WORKBENCH_CACHE": str(self.place / cache)})
            process.wait()
        return Ended(seconds_of_all() - before, process.returncode, said.read_text(encoding="utf-8", errors="replace"))


@dataclass(frozen=True)
class Bench:
    """Runs commands of this version and, where there is one, of an earlier, in turn."""

    now: Version
    before: Version | None
    repeats: int

    def row(self, what: str, *arguments: object, expected: int = 0, warm: bool = True,
            earlier: tuple[object, ...] | None = None, cold: bool = False) -> Ended:
        """The quickest of the repeats, after one that fills the caches; a line of the table. Exits where a command of
        this version ends with another code than expected.

        earlier: how the earlier version is asked, where otherwise; none where it cannot be. cold: with an empty cache
        each time.
        """
        asked = [(self.now, arguments)]
        if self.before is not None and earlier != ():
            asked.append((self.before, earlier or arguments))
        best: list[Ended] = []
        for version, words in asked:
            if warm and not cold:
                version.once(*words)
            taken = []
            for _ in range(1 if cold else self.repeats):
                version.empty()
                taken.append(version.once(*words, cache="empty" if cold else "cache"))
            best.append(min(taken, key=lambda ended: ended.cpu_s))
        if best[0].code != expected:
            sys.exit(f"{what}: ends with {best[0].code}: {best[0].said[-500:]}")
        gaps = [re.search(r"gap (\d\S*) %", ended.said) for ended in best]
        note = " before ".join(f"gap {gap[1]} %" for gap in gaps if gap)
        if len(best) > 1 and best[1].code != expected:
            note = f"{note}; before it ended with {best[1].code}".removeprefix("; ")
        tell(what, best[0].cpu_s, best[1].cpu_s if len(best) > 1 and best[1].code == expected else None, note)
        return best[0]

    def values(self, code: str, earlier: str | None = None) -> tuple[Any, Any]:
        """What a text in Python says of this version, and of the earlier, None where it says nothing."""
        return self.now.value(code), self.before.value(earlier or code) if self.before else None


def tell(what: str, now_s: float, before_s: float | None = None, note: str = "") -> None:
    """A line of the table."""
    ratio = f"{before_s / now_s:7.1f}" if before_s is not None and now_s > 0 else " " * 7
    earlier = f"{before_s:11.6f}" if before_s is not None else " " * 11
    print(f"{what:62s}{earlier}{now_s:11.6f}{ratio}  {note}".rstrip(), flush=True)
