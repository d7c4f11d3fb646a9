r"""What sources on backstepping call what they design: virtual controls, command filters, compensated errors."""

import pytest

from workbench.paper.source.document import read_source
from workbench.paper.source.folder import rows_and_letters
from workbench.paper.source.row import Row, with_numbers
from workbench.proof.latex.symbols import _name

TEXT = r"""\documentclass{article}\begin{document}
Consider the system \begin{align} \dot x_1 &= x_2, \\ \dot x_2 &= u, \end{align}
where $x_1, x_2 \in \mathbb{R}$ are the states and $u \in \mathbb{R}$ is the control input.
Define the transformed errors \begin{equation} z_1 = x_1, \quad z_2 = x_2 - \alpha_f . \end{equation}
The virtual control is \begin{equation} \alpha = -k_1 z_1, \end{equation} where $k_1 > 0$ is a design constant.
The command filter is \begin{equation} \dot\alpha_f = -\omega (\alpha_f - \alpha), \end{equation}
where $\omega > 0$ is the filter bandwidth.
The compensating signal is \begin{equation} \dot\xi = -k_1 \xi + \alpha_f - \alpha . \end{equation}
The compensated error is \begin{equation} v_1 = z_1 - \xi . \end{equation}
The control law is \begin{equation} u = -k_1 z_2 . \end{equation} \end{document}"""


def roles(text):
    return {row.id: row.role for row in rows_and_letters(read_source(text))[0]}


def test_what_a_paper_on_command_filters_designs_is_taken():
    assert [*roles(TEXT).values()] == ["dynamics", "dynamics", "definition", "definition", "dynamics", "dynamics",
                                       "definition", "definition"]


def test_gains_and_bandwidths_are_constants():
    letters = rows_and_letters(read_source(TEXT))[1]
    assert [letters[letter].role for letter in (r"\omega", "k_{1}")] == ["constant", "constant"]


@pytest.mark.parametrize("word", ["virtual", "ideal", "desired"])
def test_what_is_no_law_of_the_plant_s_input_is_left_to_the_author(word):
    assert roles(TEXT.replace("The control law is", f"The {word} control is"))["8"] != "definition"


def test_interconnected_systems_are_plants_under_their_heading():
    text = TEXT.replace("Consider the system", r"\section{Interconnection} Consider the interconnected systems")
    assert roles(text) == roles(TEXT)


@pytest.mark.parametrize(("typed", "name"), [
    (r"\hat\theta", "theta_hat"), (r"\hat{\theta}_{1}", "theta_hat_1"), (r"\overline{d}", "d_bar"),
    (r"\dot{\hat{\theta}}", "theta_hat_dot"), (r"\alpha_{f}", "alpha_f"), (r"k_1", "k_1")])
def test_a_letter_has_the_name_by_which_it_is_written_again(typed, name):
    r"""As hat_theta it stood in errata as a word, and not as \hat\theta."""
    assert _name(typed, {}) == name


def test_a_theorem_in_words_has_the_numbers_that_are_printed():
    rows = [Row("1", "Equation", "1", "", ("eq:x",)), Row("assumption2", "Assumption", "2", "", ("as:d",))]
    assert with_numbers(r"By \eqref{eq:x}, Assumption~\ref{as:d} and \eqref{eq:no}", rows) == (
        r"By (1), Assumption 2 and \eqref{eq:no}")
