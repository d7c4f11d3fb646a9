"""A small paper's folder for the tests: a law of its own, a short scenario, claims and gains in it if wanted."""

from pathlib import Path

from test_cli import LINE, short_toml

LAWS = '''
"""A paper's law."""
import sympy as sp
from workbench.model.law import ControlLaw, desired_position, desired_speed, position, speed
from .numbers import SHARE

K_p, K_d = sp.symbols("K_p K_d", positive=True)
pd = ControlLaw("doe2030.pd", "PD", "doe2030 (1)", "full state, model unknown",
                SHARE * (K_p * (desired_position - position) + K_d * (desired_speed - speed)), parameters=(K_p, K_d))
'''
CLAIMS = '''
from workbench.proof.claim import Goal, at_least
from ..paper import paper
from ..laws import K_p
from ..numbers import SHARE

@paper.claim("{number}", "claim {number}", "inequality", "x", "proved")
def claim_{name}() -> Goal:
    return Goal((at_least(SHARE * K_p**2 + {name}, 0),))
'''
PAPER = '"""A paper."""\nfrom workbench.proof.paper import Paper\n\npaper = Paper("doe2030", "nobody, nowhere")\n'
OBJECTIVE = """
[tuning.objective]
position_m = 0.1
speed_mps = 0.1
jerk_mps3 = 0.3
failed = 100.0
"""
CONTROLLER = """
[controllers.own]
law = "{law}"
period_s = 0.01
parameters = {{ K_p = 1.0, K_d = 2.0 }}
"""


def small_scenario(law: str = "doe2030.pd", **changes: str) -> str:
    """A short scenario's text with a controller of the law beside PID; changes: words by what stands there instead."""
    head, _, rest = short_toml().partition("[controllers.slow]")
    text = head + CONTROLLER.format(law=law).lstrip() + rest[rest.index("[uncertainty]"):]
    for old, new in changes.items():
        assert old in text
        text = text.replace(old, new)
    return text


def small_folder(folder: Path, share: int = 1, law: str = "doe2030.pd") -> Path:
    """A folder with laws.py, the module that it imports, and a study.toml."""
    folder.mkdir(parents=True)
    (folder / "laws.py").write_text(LAWS, encoding="utf-8")
    (folder / "numbers.py").write_text(f"SHARE = {share}\n", encoding="utf-8")
    (folder / "line.toml").write_text(LINE, encoding="utf-8")
    (folder / "study.toml").write_text(small_scenario(law), encoding="utf-8")
    return folder


def with_claims(folder: Path, *names: str) -> Path:
    """The folder with a paper.py and a file of claims for each name, `section_2` states claim 2."""
    (folder / "paper.py").write_text(PAPER, encoding="utf-8")
    (folder / "claims").mkdir(exist_ok=True)
    for name in names:
        add_claims(folder, name)
    return folder


def add_claims(folder: Path, name: str) -> None:
    """One more file of claims."""
    number = name.rpartition("_")[2]
    (folder / "claims" / f"{name}.py").write_text(CLAIMS.format(number=number, name=number), encoding="utf-8")
