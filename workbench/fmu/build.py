"""The file of a co-simulation unit, by pythonfmu3, whose library goes into it."""

from __future__ import annotations

from importlib import import_module

from workbench.errors import WorkbenchError
from workbench.files.regular import contents
from workbench.files.scratch import scratch_folder
from workbench.files.writing import write_text
from workbench.fmu.slave_text import slave_text
from workbench.fmu.unit import LawUnit


def fmu_bytes(unit: LawUnit) -> bytes:
    """The unit as FMI 3.0 defines it; WorkbenchError where pythonfmu3 is not installed.

    Who loads it needs Python 3, whose interpreter the unit's library looks for, and numpy for laws with neurons.
    """
    try:
        builder = import_module("pythonfmu3").FmuBuilder
    except ImportError:
        raise WorkbenchError("pythonfmu3 is not installed: pip install pythonfmu3, or 'workbench[fmu]'") from None
    with scratch_folder() as folder:
        script = folder / f"{unit.name}_unit.py"
        write_text(script, slave_text(unit))
        made = builder.build_FMU(script, folder, canHandleVariableCommunicationStepSize=False)
        return contents(made)
