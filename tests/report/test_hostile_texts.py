"""What a stranger's formula, title or name may not do: read files, bring a tag into a page, steer a terminal."""

import re
import sys

import pytest

from workbench.cli.console import QuietConsole
from workbench.optimal import bound_checker
from workbench.proof import checker
from workbench.report.errata.blocks import Formula, Heading, Item, Items, Paragraph
from workbench.report.errata.latex import latex_document
from workbench.report.errata.markdown import markdown
from workbench.report.errata.page import html_document
from workbench.report.errata.pdf import HEAD, typst_source
from workbench.report.errata.tex_formula import is_mathematics

READING = (r"\input{/etc/passwd}", r"\text{\input{/etc/passwd}}", r"x^^5cinput{/etc/passwd}", r"\write18{id}", "x % y",
           r"\csname input\endcsname", r"\def\x{\input}", r"\begin{filecontents}x\end{filecontents}", r"x} \par {",
           r"\immediate\openout15=x", r"\hspace{\input{x}}", r"\href{\input{x}}{y}", r"\verb|x|", r"\catcode`x=0",
           r"$ \end{document}", r"\usepackage{x}", r"\newcommand{\x}{y}", r"\begin{verbatim}", "x\\")
TAGS = ("<script>alert(1)</script>", "<img src=x onerror=alert(1)>", "</math><b>", "<!-- ", "<https://e.vil>",
        "[x](javascript:alert(1))", "![x](https://e.vil/x.png)", "\\<b>", "\\](javascript:x)")


@pytest.mark.parametrize("latex", READING)
def test_a_formula_that_is_more_than_mathematics_is_shown_letter_by_letter(latex):
    assert not is_mathematics(latex)
    text = latex_document([Formula(latex, "Printed"), Paragraph(f"with ${latex.replace('$', '')}$ in it")])
    body = text.partition("\\begin{document}")[2]
    known = re.sub(r"\\textbackslash\{\}|\\textasciicircum\{\}", "", body)
    assert not re.search(r"\\(input|write|csname|def|begin|immediate|href|verb|catcode|usepackage|newcommand)\b", known)
    assert body.count("\\end{document}") == 1 and "^^" not in body


@pytest.mark.parametrize("latex", [
    r"\dot V \le -\tfrac{k}{2} x^2", r"\left\{ \begin{cases} a & b \\ c & d \end{cases} \right.",
    r"\text{for $k$ in } \mathbb{R}",
    r"\operatorname{sgn}(s), \; \forall t \ge 0", r"\hat{\theta}_{i-1}^{\top} \Longrightarrow \|x\| \to \infty"])
def test_mathematics_stays_what_it_is(latex):
    assert is_mathematics(latex)
    assert latex in latex_document([Formula(latex)]) and latex in markdown([Formula(latex)])


@pytest.mark.parametrize("text", TAGS)
def test_no_tag_and_no_link_stands_in_a_document(text):
    blocks = [Heading(2, text), Paragraph(text, "Note"), Paragraph(f"a ${text}$ b"), Items((Item(text),)),
              Formula(text)]
    found = markdown(blocks)
    assert not re.search(r"<[A-Za-z/!?]", found) and "](" not in found
    page = html_document(blocks, text).partition("<main>")[2]
    assert not re.search(r"<(script|img|b|!--|a)\b", page) and "href" not in page and "<!--" not in page
    source = typst_source(blocks)
    assert not re.search(r"(?<!\\)#(?!heading|strong|block|text|tall|raw|\")", source.removeprefix(HEAD))


@pytest.mark.parametrize("text", ["a\x1b[31mb", "a\x1b]0;title\x07b", "a\x9b31mb", "\u202eabc", "a\rb", "a\bb"])
def test_nothing_that_is_printed_steers_a_terminal(text, monkeypatch, tmp_path, capsys):
    console = QuietConsole(force_terminal=True, width=80, markup=False)
    with console.capture() as shown:
        console.print(text, style="red")
    assert re.sub(r"\x1b\[[\d;]*m", "", shown.get()).strip().isprintable()
    assert shown.get().startswith("\x1b[31m")  # rich's own colours are still there
    (tmp_path / "a.json").write_text('{"verdict": "\\u001b[31m", "goal": 1}')
    monkeypatch.setattr(sys, "argv", ["checker.py", str(tmp_path)])
    assert checker.main() == 1 and bound_checker.main([str(tmp_path / "a.json")]) == 1
    assert all(line.isprintable() for line in capsys.readouterr().out.splitlines())
