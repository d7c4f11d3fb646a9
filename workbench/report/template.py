"""A page's frame: the template with its style, its only script, and what every page says about its making."""

from __future__ import annotations

import base64
import hashlib
import platform
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from workbench.files.numbers import number
from workbench.files.regular import contents
from workbench.report.claims import ClaimView, by_section, claim_views, counts, fated
from workbench.report.findings_view import finding_groups
from workbench.report.sources import SourcedValue, stated

PACKAGES = ("workbench", "numpy", "scipy", "sympy", "numba", "casadi", "matplotlib")

# Shows the filter, which is of no use without scripts, and opens what folds before printing.
SCRIPT = """
const filter = document.getElementById("filter");
const claims = [...document.querySelectorAll("tbody[data-verdict]")];
const folds = [...document.querySelectorAll("details.paper-section")];
const START = "#show?";
function chosen() {
  return [...filter.querySelectorAll("select, input")].filter(field => field.value);
}
function show(keep) {
  const fields = chosen();
  let count = 0;
  for (const claim of claims) {
    claim.hidden = fields.some(field => field.name === "q"
      ? !claim.textContent.toLowerCase().includes(field.value.toLowerCase())
      : claim.dataset[field.name] !== field.value);
    count += claim.hidden ? 0 : 1;
  }
  for (const fold of folds) {
    const left = fold.querySelector("tbody[data-verdict]:not([hidden])");
    fold.hidden = !left;
    if (fields.length && left) fold.open = true;
  }
  document.getElementById("shown").textContent = count + " of " + claims.length + " claims";
  if (keep && fields.length)
    history.replaceState(null, "", START + new URLSearchParams(fields.map(field => [field.name, field.value])));
  else if (keep && location.hash.startsWith(START)) history.replaceState(null, "", "#proof");
}
function follow() {
  if (location.hash.startsWith(START)) {
    const asked = new URLSearchParams(location.hash.slice(START.length));
    for (const field of filter.querySelectorAll("select, input")) field.value = asked.get(field.name) || "";
    show(false);
    document.getElementById("proof").scrollIntoView();
    return;
  }
  const name = location.hash.slice(1);
  const claim = document.getElementById(decodeURIComponent(name)) || document.getElementById(name);
  if (!claim) return;
  if (claim.closest("tbody[hidden]")) {  // a link to a claim that is filtered away shows all again
    for (const field of filter.querySelectorAll("select, input")) field.value = "";
    show(false);
  }
  const fold = claim.closest("details.paper-section");
  if (fold && !fold.open) { fold.open = true; claim.scrollIntoView(); }
}
if (filter) {
  filter.hidden = false;
  filter.addEventListener("input", () => show(true));
  document.getElementById("unfold").addEventListener("click", () => { for (const fold of folds) fold.open = true; });
  addEventListener("hashchange", follow);
  show(false);
  follow();
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
        claims=claims, counts=counts(claims), findings=finding_groups(document), sections=by_section(claims),
        fated=fated(claims),
        choices=[(name, label, found) for name, label in CHOICES if len(found := _values(claims, name)) > 1],
        sources={kind: [s for s in sources if s.kind == kind] for kind in ("assumed", "paper", "convention")},
        versions=_versions(), style=Markup(contents(folder / "page.css").decode()), script=Markup(SCRIPT),
        script_hash=_hash(SCRIPT), **values)


CHOICES = (("verdict", "Verdict"), ("severity", "Severity"), ("origin", "Origin"), ("section", "Section"))


def _values(claims: Sequence[ClaimView], name: str) -> list[tuple[str, int]]:
    """The values that a field of claims has, and how many claims have each."""
    return [(value, n) for value, n in Counter(getattr(claim, name) for claim in claims).items() if value]


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
