"""docs/trust.md says of every rule and fact of the checker by which lemma Coq knows it, and the lemmas are there."""

import re
from pathlib import Path

from workbench.kernel.export import HERE, LIBRARY
from workbench.proof import checker

ROOT = Path(__file__).resolve().parents[2]
OF_COQ = {"ring", "field", "exp_pos", "Rabs_pos", "sqrt_pos", "sqrt_lt_R0"}
ROWS = re.findall(r"^\| (.*?) \| (.*) \|$",
                  (ROOT / "docs" / "trust.md").read_text(encoding="utf-8").partition("| rule or fact |")[2], re.M)


def named(column: int) -> set[str]:
    """What stands between backticks in a column of the table."""
    return {name for row in ROWS for name in re.findall(r"`(\w+)`", row[column])}


def test_every_rule_and_fact_of_the_checker_has_its_row() -> None:
    source = Path(checker.__file__).read_text(encoding="utf-8")
    rules = set(re.findall(r'"(\w+)": _\w+[,}]', source.partition("rules = {")[2].partition("}")[0] + "}"))
    facts = {name for names in re.findall(r'"fact": ((?:"\w+"(?: \| )?)+)', source)
             for name in re.findall(r'"(\w+)"', names)}
    assert {"cut", "monotone"} < rules
    facts |= checker.ARCTAN.keys()
    assert {"circle", "arctan_limit", "log_product", "sqrt_positive"} < facts
    assert named(0) == rules | facts


def test_every_lemma_of_the_table_is_proved_in_the_library() -> None:
    library = "".join((HERE / name).read_text(encoding="utf-8") for name in LIBRARY)
    assert "Admitted" not in library
    assert "Axiom" not in library
    assert named(1) - OF_COQ <= set(re.findall(r"^Lemma (\w+)", library, re.M))
