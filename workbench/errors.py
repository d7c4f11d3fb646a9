"""The few errors the workbench raises; each message ends with its remedy."""

from __future__ import annotations

from pathlib import Path

# A key or a value of a file may be of any length; what is said of it begins with its place and ends with its remedy.
LONGEST_PART, BEGINNING, END = 600, 200, 200


class WorkbenchError(Exception):
    """Base of all errors that are the caller's to mend; the CLI prints it in one line and exits with 2."""


class InputError(WorkbenchError):
    """A file or an option cannot be used: names the file, the key and the remedy, in one line.

    `where` is empty where the file is not known yet; whoever knows it raises `error.within(path)`.
    """

    def __init__(self, where: str | Path, key: str, problem: str) -> None:
        self.where, self.key, self.problem = str(where), key, problem
        super().__init__(": ".join(in_one_line(part) for part in (self.where, key, problem) if part))

    def __reduce__(self) -> tuple[type[InputError], tuple[str, str, str]]:
        # From a worker process the error comes by what it was made of.
        return InputError, (self.where, self.key, self.problem)

    def within(self, where: str | Path, key: str = "") -> InputError:
        """The same error, naming the file it was found in, and the key where it named none."""
        return InputError(where, self.key or key, self.problem)


class CompileError(WorkbenchError):
    """A sympy expression cannot become code: names the symbol that has no meaning there."""


class ClaimError(WorkbenchError):
    """A claim is ill-formed: names the claim and what is missing."""


class SolverError(WorkbenchError):
    """A numerical solver returned nothing that may be used: names the solver and its status."""


class OutOfTime(BaseException):  # no Exception: deciders and libraries that catch every one let it pass
    """The time that was given is used up."""


# What is no mistake of the code that it is raised in: it has come from outside.
FROM_OUTSIDE = (KeyboardInterrupt, OutOfTime)


# What a light installation leaves out -> the extra of the package that brings it.
EXTRAS = {"numba": "simulate", "llvmlite": "simulate", "pyarrow": "simulate", "optuna": "tune", "cmaes": "tune",
          "jinja2": "report", "plotly": "report", "matplotlib": "report", "grandalf": "report"}


class MissingExtraError(WorkbenchError):
    """A part of the workbench is asked for whose packages are not installed: names the package and its extra."""


def of_an_extra(trouble: ImportError) -> MissingExtraError | None:
    """What is said of a package that is not installed and that an extra brings; None of any other."""
    name = (trouble.name or "").partition(".")[0]
    if name not in EXTRAS:
        return None
    return MissingExtraError(f"{name} is not installed, which this needs: pip install 'workbench[{EXTRAS[name]}]', or "
                             "'workbench[all]'")


def in_one_line(text: str) -> str:
    """A text that comes from a file, so that it may be of any length, and hold line breaks and control characters."""
    if len(text) > LONGEST_PART:
        text = f"{text[:BEGINNING]} ... ({len(text)} characters) ... {text[-END:]}"
    return printable(text)


def printable(text: str) -> str:
    """A text with a blank in the place of what ends lines or steers a terminal."""
    return "".join(c if c.isprintable() else " " for c in text)
