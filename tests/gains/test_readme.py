"""The README's example of a search runs as it is printed, and says what the text says of it."""

import re
from pathlib import Path

import pytest

from workbench.proof.checker import check

README = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")
SECTION = README.partition("## Find gains of your own, proved")[2].partition("\n## ")[0]


def test_the_example_is_short_runs_and_finds_the_norm(capsys):
    (example,) = re.findall(r"```python\n(.*?)```", SECTION, re.DOTALL)
    assert len(example.splitlines()) < 20
    names = {}
    exec(compile(example, "README.md", "exec"), names)  # noqa: S102 - our own text
    check(names["found"].certificate)
    assert float(capsys.readouterr().out.split()[-1]) == pytest.approx(2 / 3**0.5, rel=1e-3)
