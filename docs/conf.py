"""How Sphinx builds the pages: notebooks are executed, formulas are MathML, no page asks another host (`make docs`)."""

from __future__ import annotations

import os
import re
import sys
from importlib import import_module
from pathlib import Path
from typing import Any

from docutils import nodes

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
sys.path[:0] = [str(HERE), str(ROOT)]
# Cells of the notebooks call the `workbench` of this interpreter, on this checkout, with its own cache.
os.environ["PATH"] = os.pathsep.join((str(Path(sys.executable).parent), os.environ.get("PATH", "")))
os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, (str(ROOT), os.environ.get("PYTHONPATH"))))
os.environ.setdefault("WORKBENCH_CACHE", str(ROOT / ".cache"))
# One thread and one core: what is run here is small, and a further process costs more than it takes over.
for limit in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"):
    os.environ.setdefault(limit, "1")
if hasattr(os, "sched_setaffinity"):
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
os.environ.setdefault("COLUMNS", "88")  # as wide as a page shows without scrolling
os.environ["TTY_COMPATIBLE"] = "0"  # no colours and no progress bars in outputs, which a kernel would force

import generated_pages
import shell_cells
from accessible import accessible, accessible_page, accessible_tree

import workbench
from workbench.report.formulas import formula

os.environ["IPYTHONDIR"] = shell_cells.ipython_folder()

project = "workbench"
author = "The authors of workbench"
release = version = workbench.__version__

extensions = ["myst_nb", "sphinx.ext.autodoc"]
exclude_patterns = ["_build", "README.md"]
root_doc = "index"

myst_enable_extensions = ["dollarmath", "deflist", "colon_fence"]
myst_heading_anchors = 4
nb_execution_mode = "force"
nb_execution_in_temp = True
nb_execution_raise_on_error = True
nb_execution_timeout = 1800  # a machine with much else to do takes its time
nb_merge_streams = True
nb_output_stderr = "remove"  # progress; an error ends the build

smartquotes = False  # `--all` is typed with two dashes
default_role = "literal"  # docstrings write `name`
autodoc_typehints = "signature"
autodoc_member_order = "bysource"
autodoc_default_options = {"exclude-members": "model_config"}
python_maximum_signature_line_length = 88
nitpicky = True
# Of other libraries, whose pages are not asked for while these are built; and what is no part of the API.
nitpick_ignore_regex = [(r"py:.*", r"(?!workbench\b).*"), (r"py:class", r"workbench\.(mpc|optimal|paper|trains)\..*")]

html_theme = "furo"
html_title = "workbench"
html_static_path = ["_static", "../workbench/report/fonts"]
html_css_files = ["pages.css"]
html_copy_source = False
html_show_copyright = False
html_show_sourcelink = False
html_math_renderer = "mathml"

_ELSEWHERE = re.compile(
    r"""<(?:script|img|link|iframe|source)\b[^>]*?(?:src|href)=["'](?:https?:)?//[^"']*"""
    r"""|url\(["']?https?:[^)]*|@import[^;]*https?:[^;]*""")


def setup(app: Any) -> None:
    """What these pages need beyond the extensions: formulas, generated pages, short names of classes, a last look."""
    app.add_html_math_renderer("mathml", (_inline, None), (_display, None))
    app.connect("config-inited", lambda _app, _config: generated_pages.write(HERE / "generated"))
    app.connect("source-read", _named_after_its_paper)
    app.connect("missing-reference", _public_name)
    app.connect("html-page-context", _accessible, priority=900)  # after the theme has made its list of pages
    app.connect("build-finished", _whole_pages)
    app.connect("build-finished", _nothing_from_elsewhere)


def _named_after_its_paper(_app: Any, name: str, source: list[str]) -> None:
    """Errata are all headed alike; in a list of them and at the edge of a page their paper tells them apart."""
    if name.endswith("/errata"):
        source[0] = source[0].replace("# Corrections", f"# Corrections to {name.split('/')[-2]}", 1)


def _accessible(_app: Any, _name: str, _template: str, context: dict[str, Any], _document: Any) -> None:
    context["body"] = accessible(context.get("body", ""))
    if "furo_navigation_tree" in context:
        context["furo_navigation_tree"] = accessible_tree(context["furo_navigation_tree"])


def _whole_pages(app: Any, trouble: Exception | None) -> None:
    for path in sorted(Path(app.outdir).rglob("*.html")) if trouble is None else ():
        path.write_text(accessible_page(path.read_text(encoding="utf-8")), encoding="utf-8")


def _inline(self: Any, node: nodes.math) -> None:
    self.body.append(f'<span class="math">{formula(node.astext())}</span>')
    raise nodes.SkipNode


def _display(self: Any, node: nodes.math_block) -> None:
    self.body.append(f'<div class="math">{formula(node.astext())}</div>')
    raise nodes.SkipNode


def _public_name(app: Any, env: Any, node: Any, content: Any) -> Any:
    """A reference to the class by the name that `import workbench` gives it, where it has one."""
    module, _, name = str(node.get("reftarget", "")).rpartition(".")
    if node.get("refdomain") != "py" or not module.startswith("workbench."):
        return None
    meant = getattr(import_module(module), name, None)
    shown = [public for public in workbench.__all__ if getattr(workbench, public) is meant]
    if not shown:
        return None
    return env.domains["py"].resolve_xref(env, node["refdoc"], app.builder, node["reftype"], f"workbench.{shown[0]}",
                                          node, content)


def _nothing_from_elsewhere(app: Any, trouble: Exception | None) -> None:
    """Raise for a page, style or script that would ask another host for anything."""
    for path in sorted(Path(app.outdir).rglob("*")) if trouble is None else ():
        found = _ELSEWHERE.search(path.read_text(encoding="utf-8")) if path.suffix in (".html", ".css") else None
        if found:
            raise ValueError(f"{path}: asks another host: {found[0][:200]}")
