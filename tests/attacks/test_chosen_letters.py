r"""A line that holds for the gains a paper means, or where it has just said, is not refuted by other values."""

import pytest
from short_papers import HEAD

from workbench.paper.source.folder import write_from_source

PLANT = r"""Consider the system \begin{equation} \dot x = a x + u, \end{equation} where $x\in\mathbb{R}$ is the state,
$u$ is the input and $a$ is a constant. The control law is \begin{equation} u = -k x[[law]]. \end{equation} [[said]]
Let $V = \frac12 x^2$. """
LINE = r"Then \begin{equation} \dot V \le 0. \tag{T} \end{equation}"
WHERE = tuple(f"where $k>0$ is {what}." for what in (
    "a sufficiently large constant", "a large constant", "a suitable constant", "a gain to be chosen",
    "the stabilizing gain", "the critical gain", "a big enough gain", "the optimal gain", "an upper bound of $a$",
    "the bound of $|a|$", "the ideal gain", "the solution of the Riccati equation", "the LQR gain"))
SAID = (
    r"The gain $k>0$ is suitable.", "Here $k>0$ is a stabilizing gain.", "Let $k>0$ denote the maximum of $a$.",
    "Let $k$ be a positive constant to be designed.", "The gain $k>0$ is the solution of the Riccati equation.")
OPEN = ("where $k>0$ is a design parameter.", "where $k>0$ is an unknown constant.", "Let $k>0$ be a gain.")
WITHIN = (
    r"For $|x| \le 1$, \begin{equation} \dot V \le 0. \end{equation} Hence \begin{equation} \dot V \le 0. \tag{T}"
    r"\end{equation}",
    r"\begin{lemma} If $|x| < 1$, then \begin{equation} \dot V \le 0. \end{equation} \end{lemma} Therefore "
    r"\begin{equation} \dot V \le 0. \tag{T} \end{equation}",
    r"For $|x| \le 1$, \begin{equation} \dot V \le -x^2 (1 - x^2). \end{equation} Thus \begin{equation} \dot V \le 0 . "
    r"\end{equation} Therefore \begin{equation} x \dot x \le 0. \tag{T} \end{equation}")

PROVED_SO = tuple(rf"\begin{{theorem}} {said} \begin{{equation}} \dot V \le -x^2. \end{{equation}} \end{{theorem}} "
                  r"\begin{proof} We have \begin{equation} \dot V \le -x^2. \tag{T} \end{equation} \end{proof}"
                  for said in ("If $k > 1$, then", "For $k > 1$, we have", "Suppose that $k > 1$. Then"))

VALUED = ("The constant $k$ is $2$.", "The gain $k$ is one.", "The gain $k$ is two.", "The constant $k$ equals $2$.",
          "The gain is $2$.", "The gain equals $2$.", "The gain is bounded below by $1$.",
          "The gain $k$ is an integer.", "The gain $k$ is a positive integer.",
          "Then $k$ is $2$.", "The gains $k$ and $c$ are $2$ and $3$.")
ASKED = (r"We have \begin{equation} \dot V \le -x^2, \quad k > 1 \tag{T} \end{equation}",
         r"where \begin{equation} k > 1. \end{equation} Then \begin{equation} \dot V \le -x^2 \tag{T} \end{equation}")


def verdict(folder, text):
    (folder / "paper.tex").write_text(rf"{HEAD}{text}\end{{document}}")
    return write_from_source("paper2030", folder, folder / "paper.tex").verdicts["T"]


def of(said, law=""):
    return PLANT.replace("[[law]]. ", f"{law}, " if said.startswith("where") else f"{law}. ").replace("[[said]]", said)


@pytest.mark.parametrize("said", [*WHERE, *SAID])
def test_a_gain_of_some_values_alone_is_not_given_another(said, tmp_path):
    assert verdict(tmp_path, of(said) + LINE) == "undecided"


@pytest.mark.parametrize("said", OPEN)
def test_a_gain_of_which_the_sign_is_said_may_be_any(said, tmp_path):
    assert verdict(tmp_path, of(said) + LINE) == "refuted"


@pytest.mark.parametrize("text", WITHIN)
def test_what_follows_from_a_line_of_some_values_is_of_these(text, tmp_path):
    assert verdict(tmp_path, of("Let $k>0$.", " - a x + x^3 + k x - x") + text) == "undecided"


@pytest.mark.parametrize("text", PROVED_SO)
def test_what_a_theorem_supposes_holds_in_its_proof(text, tmp_path):
    assert verdict(tmp_path, of("Let $k>0$.", " - a x") + text) == "undecided"


@pytest.mark.parametrize("said", VALUED)
def test_a_number_that_is_said_in_words_is_the_gains(said, tmp_path):
    line = r" Then \begin{equation} \dot V \le -x^2. \tag{T} \end{equation}"
    assert verdict(tmp_path, of("Let $k>0$.", " - a x") + said + line) == "undecided"


@pytest.mark.parametrize("text", ASKED)
def test_a_relation_of_gains_may_be_asked_of_them(text, tmp_path):
    assert verdict(tmp_path, of("Let $k>0$.", " - a x") + text) == "undecided"


def test_behind_the_proof_it_does_not(tmp_path):
    outside = r" We have \begin{equation} \dot V \le -x^2. \tag{T} \end{equation}"
    text = of("Let $k>0$.", " - a x") + PROVED_SO[0].replace(r" \tag{T}", "") + r" \section{More}" + outside
    assert verdict(tmp_path, text) == "refuted"


def test_what_does_not_follow_from_it_may_be_of_all(tmp_path):
    text = r"For $|x| \le 1$, \begin{equation} \dot V \le 0. \end{equation} We have [[T]]"
    line = r"\begin{equation} \dot V \le 0. \tag{T} \end{equation}"
    assert verdict(tmp_path, of("Let $k>0$.", " - a x + x^3 + k x - x") + text.replace("[[T]]", line)) == "refuted"
