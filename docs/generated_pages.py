"""Pages that are made from the code and the papers, never typed: commands, files, gallery, and the first picture."""

from __future__ import annotations

import html
import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

from workbench.api.schemas import FORMATS, schema
from workbench.files.folders import CERTIFICATES, papers_in
from workbench.paper.contents import contents_of
from workbench.proof.kernel_record import read_record

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
SIGNS = {"minimum": "≥ {}", "exclusiveMinimum": "> {}", "maximum": "≤ {}", "exclusiveMaximum": "< {}",
         "minItems": "at least {}", "maxItems": "at most {}", "pattern": "`{}`"}


def write(folder: Path) -> None:
    """Write all pages into a folder, and only what differs from what lies there, so that a second build is short."""
    folder.mkdir(exist_ok=True)
    pages = {"commands.md": commands(), "gallery.md": gallery(), "files_read.md": files("reads"),
             "files_written.md": files("writes")}
    for name, text in pages.items():
        path = folder / name
        if not path.is_file() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")


def commands() -> str:
    """The reference of every command, as typer writes it."""
    told = subprocess.run([sys.executable, "-m", "typer", "workbench.cli.app", "utils", "docs", "--name", "workbench",
                           "--title", "Commands"], capture_output=True, text=True, check=True, cwd=ROOT)
    text = html.unescape(told.stdout).replace("`workbench ", "`")
    first, _, rest = text.partition("\n## ")
    # In the list at the top typer cuts each sentence short: the headings below say it whole.
    head = first.split("**Commands**")[0].replace("$ [OPTIONS]", "$ workbench [OPTIONS]")
    names = "".join(f"- [`{name}`](#{name})\n" for name in re.findall(r"^## `?([\w-]+)", "## " + rest, re.MULTILINE))
    return f"{head}**Commands**:\n\n{names}\n## {rest}"


def gallery() -> str:
    """What was decided of each paper, taken from its errata, which are made from the decisions."""
    parts = ["# Gallery\n\nThe papers in `proofs/`: what is decided of each, and what becomes of its headline "
             "statements. All of it is made from the decisions, as are the errata, and from what `check-coq` "
             "recorded.\n"]
    for folder in papers_in(ROOT / "proofs"):
        text = (HERE / "errata" / folder.name / "errata.md").read_text(encoding="utf-8")
        citation = _between(text, "**Paper.** ", "\n")
        counts = _between(text, "\nOf ", ". Proved: ")
        fates = _between(text, "## What becomes of the headline statements\n\n", "\n\n## ")
        has = contents_of(folder)
        parts.append(f"## {folder.name}\n\n{citation}\n\n"
                     f"Of {counts}. In its folder: {', '.join(has.parts)}; {has.certificates} certificates. "
                     f"{_by_the_kernel(folder)}\n\n"
                     f"{fates}\n\n[Corrections](../errata/{folder.name}/errata.md), "
                     f"{{download}}`as PDF <../errata/{folder.name}/errata.pdf>`\n")
    return "\n".join(parts)


def _by_the_kernel(folder: Path) -> str:
    """How many of a paper's decided goals its record says that Coq's kernel has accepted."""
    manifest = json.loads((folder / CERTIFICATES / "manifest.json").read_text(encoding="utf-8"))
    goals = {name: one["goal_digest"] for name, one in manifest["claims"].items() if one["goal_digest"]}
    record = read_record(folder)
    accepted = sum(record.get(name) == digest for name, digest in goals.items())
    return f"Coq's kernel has accepted {accepted} of {len(goals)} decided claims too."


def _between(text: str, start: str, end: str) -> str:
    """What stands between two texts; the build fails where they are not there."""
    _, found, rest = text.partition(start)
    inside, closed, _ = rest.partition(end)
    if not (found and closed):
        raise ValueError(f"errata: no text between {start!r} and {end!r}")
    return inside


def files(use: str) -> str:
    """A section a format with every key, from its schema."""
    parts = [f"# Files that the workbench {use}\n"]
    for one in FORMATS:
        if one.use != use:
            continue
        document = schema(one.name)
        parts.append(f"## {one.name}\n\n{one.title[0].upper()}{one.title[1:]}. "
                     f"{{download}}`{one.name}.json <../schemas/{one.name}.json>`\n\n{_table(document)}")
        for name, part in document.get("$defs", {}).items():
            if "properties" in part:
                parts.append(f"### {name} ({one.name})\n\n{_table(part)}")
    text = "\n".join(parts)
    return text.replace(" or null |", " |") if use == "reads" else text  # what a file leaves out; TOML has no null


def _table(part: dict[str, Any]) -> str:
    """The keys of an object: what each holds, and its limits and default; what it is in words above."""
    words = _words(part.get("description", ""))
    required = set(part.get("required", ()))
    rows = [f"| `{key}` | {_kind(value)} | {_limits(value)} | "
            f"{'required' if key in required else _default(value)} |" for key, value in part["properties"].items()]
    return "\n".join([words, "", "| key | holds | limits | default |", "|---|---|---|---|", *rows, ""])


def _words(text: str) -> str:
    """A docstring as Markdown: signs that Markdown would take for its own are escaped outside of code."""
    return "".join(piece if piece.startswith("`") else re.sub(r"([*_<\[\]])", r"\\\1", piece)
                   for piece in re.split(r"(`[^`]*`)", text))


def _kind(value: dict[str, Any]) -> str:
    """What a value is, in words."""
    several = value.get("anyOf") or value.get("oneOf")
    if several:
        return " or ".join(dict.fromkeys(_kind(each) for each in several))
    fixed = [value["const"]] if "const" in value else value.get("enum")
    if fixed:
        return ", ".join(f"`{json.dumps(each)}`" for each in fixed)
    if "$ref" in value:
        return str(value["$ref"].rpartition("/")[2])
    return _plain_kind(value)


def _plain_kind(value: dict[str, Any]) -> str:
    """What a value of one type is, and what it holds."""
    kind = value.get("type", "anything")
    if isinstance(kind, list):
        return " or ".join(_plain_kind(value | {"type": each}) for each in kind)
    if kind == "array":
        items = value.get("prefixItems") or ([value["items"]] if value.get("items") else [])
        return "list of " + ", ".join(_kind(each) for each in items) if items else "list"
    if kind == "object":
        inside = value.get("additionalProperties") or next(iter(value.get("patternProperties", {}).values()), None)
        return f"table of {_kind(inside)}" if isinstance(inside, dict) else "table"
    return {"string": "text", "integer": "whole number", "boolean": "true or false"}.get(kind, kind)


def _limits(value: dict[str, Any]) -> str:
    parts = [value, *value.get("anyOf", ())]
    found = [SIGNS[key].format(part[key]) for part in parts for key in SIGNS if key in part]
    return ", ".join(found).replace("|", "\\|")


def _default(value: dict[str, Any]) -> str:
    return f"`{json.dumps(value['default'])}`" if value.get("default") is not None else ""
