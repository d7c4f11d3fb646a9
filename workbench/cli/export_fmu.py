"""`workbench export-fmu`: a control law for other simulators."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from workbench.cli.console import out_console
from workbench.cli.options import PaperOrFile, load
from workbench.errors import InputError

NAME = "export-fmu"


def command(paper: PaperOrFile,
            controller: Annotated[str, typer.Argument(metavar="CONTROLLER", help="A controller of the file: a law.")],
            out: Annotated[Path, typer.Option(metavar="FILE", help="The unit, as law.fmu.")]) -> None:
    """Write a control law with its stated values as a co-simulation unit of FMI 3.0.

    For Simulink, Modelica tools and FMPy; one sample is: set the inputs, read the commands, step by the law's period.
    """
    from workbench.files.outputs import check_outputs
    from workbench.files.writing import write_bytes
    from workbench.fmu.build import fmu_bytes
    from workbench.fmu.unit import unit_of

    if out.suffix != ".fmu":
        raise InputError(out, "--out", "simulators know a unit by its ending: end the name in .fmu")
    loaded = load(paper)
    unit = unit_of(loaded, controller)
    check_outputs({"--out": out}, [loaded.path])  # now that its laws have been read
    write_bytes(out, fmu_bytes(unit))
    out_console.print(f"{out}: {unit.name}, every {unit.period_s:g} s, from {', '.join(unit.inputs)} to "
                      f"{', '.join(unit.commands)}", soft_wrap=True, highlight=False, markup=False)
