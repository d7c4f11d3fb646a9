"""Ask an oracle about decisions, in a process of its own: what it does there changes no verdict, stops no command."""

from __future__ import annotations

import json
import os
import queue
import subprocess
import sys
import threading
from collections.abc import Callable, Iterable
from contextlib import suppress
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from workbench.errors import InputError
from workbench.proof.checker import UNDECIDED
from workbench.proof.oracle.opinion import Opinion
from workbench.proof.verdict import Decision

SECONDS = 2.0  # of processor time for each question
PATIENCE = 40  # times that by the wall clock, before a process that does not answer is ended
CHILD = "workbench.proof.oracle.child"
PACKAGES = Path(__file__).resolve().parents[3]
# Of a certificate what a question needs: a proof may be long, and z3 is not told it.
PARTS = ("verdict", "goal", "point", "functions")


def require_oracle(name: str) -> None:
    """Raise InputError where the oracle is not installed."""
    if find_spec(name) is None:
        raise InputError("", "--oracle", f"{name} is not installed: pip install 'workbench[oracle]'")


def opinions_on(decisions: Iterable[Decision], on_progress: Callable[[int, int], None] = lambda done, total: None,
                seconds: float = SECONDS) -> dict[str, Opinion]:
    """By the claim's id what z3 says of each decision's verdict; `seconds` of processor time for each question.

    The decisions stay as they are. Where the recorded verdict is another one, it is asked about too.
    """
    every = list(decisions)
    found: dict[str, Opinion] = {}
    with _Oracle(seconds) as oracle:
        for done, decision in enumerate(every):
            on_progress(done, len(every))
            found[decision.claim.id] = _opinion(oracle, decision)
    on_progress(len(every), len(every))
    return found


def _opinion(oracle: _Oracle, decision: Decision) -> Opinion:
    """On what was decided, or on the recorded verdict where that is another one and is contradicted."""
    if decision.certificate is None:
        return Opinion("not asked", f"{decision.verdict}, without a certificate")
    asked = {key: decision.certificate[key] for key in PARTS if key in decision.certificate}
    recorded = decision.claim.recorded
    if recorded not in (decision.verdict, *UNDECIDED):
        opinion = oracle.ask(asked | {"verdict": recorded})
        if opinion.answer == "contradicted":
            return Opinion("contradicted", f"recorded {opinion.reason}")
    # The verdict is the row's, not the certificate's: the two are the same where nothing is wrong.
    return oracle.ask(asked | {"verdict": decision.verdict})


class _Oracle:
    """A process with z3, begun anew where one has ended or does not answer."""

    def __init__(self, seconds: float) -> None:
        self.seconds = seconds
        self.process: subprocess.Popen[str] | None = None
        self.answers: queue.Queue[str] = queue.Queue()

    def __enter__(self) -> _Oracle:
        return self

    def __exit__(self, *_: object) -> None:
        self._end()

    def ask(self, certificate: dict[str, Any]) -> Opinion:
        """The opinion on a certificate; `unknown` where the process ends or takes too long."""
        process = self.process or self._begin()
        assert process.stdin is not None
        try:
            process.stdin.write(json.dumps({"certificate": certificate, "seconds": self.seconds}) + "\n")
            process.stdin.flush()
            line = self.answers.get(timeout=PATIENCE * self.seconds)
        except queue.Empty:
            self._end()
            return Opinion("unknown", f"z3 does not answer within {PATIENCE * self.seconds:g} s")
        except BrokenPipeError:
            line = ""
        if not line:
            self._end()
            return Opinion("unknown", "z3's process has ended")
        return Opinion(**json.loads(line))

    def _begin(self) -> subprocess.Popen[str]:
        paths = [str(PACKAGES), *os.environ.get("PYTHONPATH", "").split(os.pathsep)]
        # -P: nothing in the working folder, a paper's perhaps, is taken for a module.
        self.process = subprocess.Popen(
            [sys.executable, "-P", "-m", CHILD], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
            encoding="utf-8", env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, paths))})
        self.answers = queue.Queue()
        self.reader = threading.Thread(target=_forwarded, args=(self.process, self.answers), daemon=True)
        self.reader.start()
        return self.process

    def _end(self) -> None:
        if self.process is not None:
            self.process.kill()
            self.process.wait()
            self.reader.join()
            for stream in (self.process.stdin, self.process.stdout):
                if stream is not None:
                    with suppress(BrokenPipeError):  # what was still to be written to it
                        stream.close()
            self.process = None


def _forwarded(process: subprocess.Popen[str], answers: queue.Queue[str]) -> None:
    """Hand on every line that a process says, and an empty one when it has ended."""
    assert process.stdout is not None
    for line in process.stdout:
        answers.put(line)
    answers.put("")
