"""Draws which room of the package imports which: `python docs/rooms.py` writes docs/rooms.svg beside itself.

A room is a folder of `workbench/`. ORDER is the rule that the imports obey; a test holds the drawn picture to the code.
"""

from __future__ import annotations

import ast
from collections import Counter
from pathlib import Path

HERE = Path(__file__).resolve().parent
PACKAGE = HERE.parent / "workbench"
PICTURE = HERE / "rooms.svg"

# The rooms of the package, the upper ones first: a module imports from its own room and from rooms below it. Rooms of
# one floor may know each other, as long as no two know each other in both directions.
ORDER = (
    ("cli",),
    ("api",),
    ("report",),
    ("contest", "fmu"),
    ("paper",),
    ("kernel",),
    ("gains", "proof", "simulate", "mpc", "optimal"),
    ("systems",),
    ("compile",),
    ("trains",),
    ("model",),
    ("tasks",),
    ("files",),
)

CELL, LEFT, TOP = 52, 12, 66  # pixels: a cell's side, the margin, what stands above the chart


def edges(package: Path = PACKAGE) -> Counter[tuple[str, str]]:
    """(importing room, imported room) -> how many imports of modules; files at the package's root are left out."""
    rooms = {name for floor in ORDER for name in floor}
    found: Counter[tuple[str, str]] = Counter()
    for path in sorted(package.rglob("*.py")):
        room = path.relative_to(package).parts[0]
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))) if room in rooms else ():
            for name in _names(node, package.name):
                parts = name.split(".")
                if parts[0] == package.name and len(parts) > 1 and parts[1] in rooms - {room}:
                    found[room, parts[1]] += 1
    return found


def _names(node: ast.AST, package: str) -> list[str]:
    """The full names of the modules that a statement imports."""
    if isinstance(node, ast.Import):
        return [alias.name for alias in node.names]
    if not isinstance(node, ast.ImportFrom) or not node.module:
        return []
    return [f"{package}.{alias.name}" for alias in node.names] if node.module == package else [node.module]


def against_the_rule(found: Counter[tuple[str, str]]) -> list[tuple[str, str]]:
    """The edges that run upwards, and those of one floor that run both ways."""
    floor = {name: number for number, names in enumerate(ORDER) for name in names}
    return [(a, b) for a, b in found if floor[b] < floor[a] or (floor[a] == floor[b] and (b, a) in found)]


def picture(found: Counter[tuple[str, str]]) -> str:
    """An N2 chart as SVG: the rooms along the diagonal, in a room's row the rooms that it imports, and how often.

    What obeys the rule stands above the diagonal, or in the shaded square of rooms that share a floor.
    """
    names = [name for floor in ORDER for name in floor]
    side = CELL * len(names)
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {side + 2 * LEFT} {side + TOP + LEFT}" '
             'font-family="sans-serif" font-size="12" text-anchor="middle">',
             f'<rect width="{side + 2 * LEFT}" height="{side + TOP + LEFT}" fill="#fff"/>',
             f'<text x="{LEFT}" y="24" text-anchor="start" font-size="16">Which room imports which</text>',
             f'<text x="{LEFT}" y="46" text-anchor="start" fill="#555">A number: so many imports in the room of its '
             "row from the room of its column. Nothing below the steps: imports run one way.</text>"]
    for floor in ORDER:
        at, long = names.index(floor[0]) * CELL, len(floor) * CELL
        lines.append(f'<rect x="{LEFT + at}" y="{TOP + at}" width="{long}" height="{long}" fill="#eef2f7"/>')
    for row, a in enumerate(names):
        y = TOP + row * CELL
        for column, b in enumerate(names):
            x, count = LEFT + column * CELL, found[a, b]
            if a == b:
                lines.append(f'<rect x="{x}" y="{y}" width="{CELL}" height="{CELL}" fill="#2f4b6e"/>'
                             f'<text x="{x + CELL / 2:g}" y="{y + CELL / 2 + 4:g}" fill="#fff">{a}</text>')
            elif count:
                shade = 93 - 2.5 * min(count, 16)
                lines.append(f'<g data-from="{a}" data-to="{b}" data-imports="{count}"><title>{a} imports {b}</title>'
                             f'<rect x="{x + 3}" y="{y + 3}" width="{CELL - 6}" height="{CELL - 6}" rx="5" '
                             f'fill="hsl(32, 85%, {shade:g}%)"/>'
                             f'<text x="{x + CELL / 2:g}" y="{y + CELL / 2 + 4:g}">{count}</text></g>')
    return "\n".join([*lines, "</svg>"]) + "\n"


if __name__ == "__main__":
    PICTURE.write_text(picture(edges()), encoding="utf-8")
