"""chen2019's study with other values."""

from pathlib import Path

from workbench.paper.study import with_values

FOLDER = Path(__file__).parents[3] / "proofs" / "chen2019"


def changed(study, **values):
    """The study without its changes, with values set; dots as double underscores."""
    return with_values(study.model_copy(update={"changes": ()}),
                       {key.replace("__", "."): value for key, value in values.items()}, "test")
