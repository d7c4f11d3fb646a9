"""What the text of a source says of its constants besides signs: bounds, which hold with whatever is claimed."""

import pytest

from workbench.paper.source.bounds import bounded_in
from workbench.paper.source.document import read_source
from workbench.paper.source.folder import rows_and_letters, write_from_source

TEXT = r"""\documentclass{article}\begin{document}
Consider the plant \begin{equation} \dot{x} = x + u, \end{equation}
where $x \in \mathbb{R}$ is the state and $u \in \mathbb{R}$ is the control input. The control law is
\begin{equation} u = -k x, \end{equation} BOUND
Consider the Lyapunov function \begin{equation} V = \frac12 x^2. \end{equation}
Its derivative is \begin{equation} \dot V = -(k - 1) x^2 \le 0. \end{equation} \end{document}"""


@pytest.mark.parametrize(("formula", "kinds"), [
    (r"0 < a < 1", {"a": "positive"}), (r"k > 1", {"k": "positive"}), ("b > c > 0", {"b": "positive", "c": "positive"}),
    (r"k \ge 1", {"k": "positive"}), (r"k < 1", {"k": "real"}), (r"0 \le a < b", {"a": "real", "b": "positive"}),
    (r"k > 1, c > 0", {"k": "positive", "c": "positive"}), (r"1 > a < b", {}), (r"a^2 < 1", {}), (r"a = 1", {}),
    (r"a < 1 + b", {}), ("k, c > 1", {})])
def test_between_which_numbers_a_letter_lies(formula, kinds):
    assert bounded_in(formula) == kinds


@pytest.mark.parametrize(("said", "bounds", "kind"), [
    ("where $k > 1$ is a constant.", ["k > 1"], "positive"),
    ("with constants $k > c > 0$.", ["k > c > 0"], "positive"),
    ("where $k < 2$ is a positive constant.", ["k < 2"], "positive"),
    ("where $k < 2$ is a constant.", ["k < 2"], "real"),  # of either sign
    # Said twice, of what varies, or of more than constants: nobody knows which holds where.
    ("where $k > 1$ is a constant. Let $0 < k < 2$ be a constant.", [], ""),
    ("where $k > 0$ is a constant. Let $k > 1$ be a gain.", [], ""),
    ("where $k > 1$ is the state.", [], ""),
    ("where $k > x > 0$ is a constant.", [], "")])
def test_a_bound_of_a_constant_is_an_assumption(said, bounds, kind):
    rows, letters, _ = rows_and_letters(read_source(TEXT.replace("BOUND", said)))
    assert [row.printed for row in rows if row.id.startswith("bound")] == bounds
    assert letters["k"].kind == kind


def test_what_is_claimed_is_decided_within_the_bounds(tmp_path):
    for name, said, verdict in (("within", "where $k > 1$ is a constant.", "proved"),
                                ("beyond", "where $0 < k < 2$ is a constant.", "refuted")):
        (tmp_path / f"{name}.tex").write_text(TEXT.replace("BOUND", said), encoding="utf-8")
        assert write_from_source(name, tmp_path, tmp_path / f"{name}.tex").verdicts["4"] == verdict
