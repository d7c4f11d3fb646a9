"""A page's frame: the template with its style, its only script, and what every page says about its making."""

from __future__ import annotations

import base64
import hashlib
import platform
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from workbench.files.numbers import number
from workbench.files.regular import contents
from workbench.report.claims import claim_views, counts
from workbench.report.sources import SourcedValue, stated

PACKAGES = ("workbench", "numpy", "scipy", "sympy", "numba", "casadi", "matplotlib")

# Shows the filter, which is of no use without scripts, and opens what folds before printing.
SCRIPT = """
const filter = document.getElementById("filter");
const claims = [...document.querySelectorAll("tbody[data-verdict]")];
const say = document.getElementById("shown");
function show(verdict) {
  let count = 0;
  for (const claim of claims) {
    claim.hidden = verdict !== "all" && claim.dataset.verdict !== verdict;
    count += claim.hidden ? 0 : 1;
  }
  for (const button of filter.querySelectorAll("button"))
    button.setAttribute("aria-pressed", String(button.value === verdict));
  say.textContent = count + " of " + claims.length + " claims shown";
}
if (filter) {
  filter.hidden = false;
  filter.addEventListener("click", e => {
    const button = e.target.closest("button");
    if (button) show(button.value);
  });
  // A link to a claim that is filtered away shows all again.
  addEventListener("hashchange", () => {
    const claim = document.getElementById(decodeURIComponent(location.hash.slice(1)))
      || document.getElementById(location.hash.slice(1));
    if (claim && claim.closest("tbody[hidden]")) { show("all"); claim.scrollIntoView(); }
  });
}
addEventListener("beforeprint", () => {
  for (const fold of document.querySelectorAll("details")) fold.open = true;
});
"""


@dataclass(frozen=True)
class PageFigure:
    """A figure to stand in a page: its anchor, its SVG element, its caption."""

    anchor: str
    svg: Markup
    caption: str


def render(template: str, document: Mapping[str, Any], sources: Sequence[SourcedValue], **values: Any) -> str:
    """The page as HTML: styles, figures and formulas within it, no reference to anything outside.

    document: the claims as `workbench prove --json` writes them; values: what else the template shows, among it
    `subject` (what the page is about), `headline`, `settings`, `commands` and `timings`.
    """
    folder = Path(__file__).parent
    claims = claim_views(document)
    environment = Environment(loader=FileSystemLoader(folder), autoescape=True, undefined=StrictUndefined,
                              trim_blocks=True, lstrip_blocks=True)
    environment.filters |= {"number": number, "stated": stated, "breakable": _breakable}
    return environment.get_template(template).render(
        claims=claims, counts=counts(claims),
        sources={kind: [s for s in sources if s.kind == kind] for kind in ("assumed", "paper", "convention")},
        versions=_versions(), style=Markup(contents(folder / "page.css").decode()), script=Markup(SCRIPT),
        script_hash=_hash(SCRIPT), **values)


def _versions() -> dict[str, str]:
    found = {"Python": platform.python_version(), "system": f"{platform.system()} {platform.machine()}"}
    for package in PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            found[package] = "not installed as a package"
    return found


def _breakable(text: str) -> Markup:
    """A dotted key that may be broken after its dots."""
    return Markup(".<wbr>").join(text.split("."))


def _hash(script: str) -> str:
    """The hash by which the page allows this script and no other."""
    return "sha256-" + base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
