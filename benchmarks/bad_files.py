"""Files that are spoiled: structured mutants of TOML and JSON, mutants of any text, and what is no file at all."""

from __future__ import annotations

import json
import os
import random
import re
import socket
import tomllib
from collections.abc import Callable, Iterator
from datetime import date, time
from itertools import pairwise
from pathlib import Path
from typing import Any

HOSTILE_TEXTS = (
    "", " ", "o[/red]x", "[bold]x[/bold]", r"$\undefined$", r"\frac{", "$" + "{" * 400 + "$", "a\0b", "a\x1b[31mb",
    "a\rb\nc", "\u202eabc", "\ufeffx", "\ud7ff", "x" * 200_000, "../../escaped", "/etc/passwd", "/dev/zero", "-rf",
    "--out", ".", "..", "~", "a\tb", "<script>alert(1)</script>", "%s%n{0}", "__import__('os').system('true')",
    "9" * 5000, "é́️‍🦄", "nan", "1e400", "x.py::y", "laws.py::__class__", "mpc.nothing", "yang2021." + "y" * 5000,
    "line.toml", "study.toml", "CON", "*" * 50,
)
HOSTILE_NUMBERS = (
    float("nan"), float("inf"), -float("inf"), 1e300, -1e300, 1e-300, 5e-324, -1, -1.0, 0, 0.0, -0.0, 1, 2, 0.5, 1e9,
    10**12, 10**30, -(10**30), 2**63, 2**31, 1e6, 1e-9, 3.7, 1000.0, 0.001, 200_000,
)
HOSTILE_OTHERS = (True, False, [], {}, [1, 2], [[]], {"a": 1}, [None], ["x"], [1e300, -1e300], [0.0, 0.0])
# Of a file's text what takes the place of a number; of a Python file numbers and expressions alone.
WRITTEN_NUMBERS = (
    "nan", "inf", "-1", "0", "1e300", "1e-300", "9" * 25, "0x" + "f" * 5000, "''", "[]", "True", "1979-05-27", "-0.0",
    "1e999", "1_0", "+", "2**10**9", "0.1", "7",
)
DEEP = 5_000

Tree = Any
Spoil = Callable[[random.Random, bytes], bytes]


def nested(depth: int) -> Tree:
    """Lists in each other."""
    found: Tree = 1
    for _ in range(depth):
        found = [found]
    return found


def places(tree: Tree, above: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The way to everything in tables and lists, these included."""
    for key, value in tree.items() if isinstance(tree, dict) else enumerate(tree) if isinstance(tree, list) else ():
        yield (*above, key)
        yield from places(value, (*above, key))


def at(tree: Tree, way: tuple[Any, ...]) -> Tree:
    """What stands at the end of a way."""
    for key in way:
        tree = tree[key]
    return tree


def hostile_value(rng: random.Random, old: Tree) -> Tree:
    """Something in the place of a value, of the same kind more often than not."""
    if isinstance(old, int | float) and not isinstance(old, bool) and rng.random() < 0.7:
        if rng.random() < 0.4:
            return old * rng.choice((-1, 1000, 0.001, 3.6, 1e6, 1e-6, 10, 0))
        return rng.choice(HOSTILE_NUMBERS)
    if isinstance(old, str) and rng.random() < 0.7:
        return rng.choice(HOSTILE_TEXTS)
    return rng.choice((*HOSTILE_NUMBERS, *HOSTILE_TEXTS, *HOSTILE_OTHERS, nested(rng.choice((3, 30, 60)))))


def spoil_tree(rng: random.Random, tree: Tree) -> None:
    """One thing in tables and lists changed in place: a key dropped, renamed, doubled or added, a value replaced."""
    ways = list(places(tree))
    if not ways:
        return
    *above, key = rng.choice(ways)
    table = at(tree, tuple(above))
    match rng.choice(("drop", "rename", "value", "value", "value", "value", "add", "twice", "swap", "many")):
        case "drop":
            del table[key]
        case "rename" if isinstance(table, dict):
            table[rng.choice((key.upper(), key + "s", key[:-1], *HOSTILE_TEXTS))] = table.pop(key)
        case "add" if isinstance(table, dict):
            table[rng.choice(("colour", "name", "kind", "source", *HOSTILE_TEXTS))] = hostile_value(rng, 1.0)
        case "twice" if isinstance(table, list):
            table.insert(key, table[key])
        case "swap" if isinstance(table, list):
            other = rng.randrange(len(table))
            table[key], table[other] = table[other], table[key]
        case "many" if isinstance(table, list):
            table[:] = table * rng.choice((2, 50, 1000))
        case _:
            table[key] = hostile_value(rng, table[key])


def toml_text(tree: dict[str, Tree]) -> str:
    """A tree as TOML: keys of the outermost table a line each, all else within it."""
    return "".join(f"{_quoted(key)} = {_toml_value(one)}\n" for key, one in tree.items())


def _toml_value(value: Tree) -> str:
    match value:
        case dict():
            text = "{ " + ", ".join(f"{_quoted(key)} = {_toml_value(one)}" for key, one in value.items()) + " }"
        case list():
            text = "[" + ", ".join(map(_toml_value, value)) + "]"
        case bool():
            text = str(value).lower()
        case str() | None:
            text = _quoted(value or "")
        case date() | time():
            text = value.isoformat()
        case _:
            text = repr(value)
    return text


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def spoiled_toml(rng: random.Random, data: bytes) -> bytes:
    """A mutant of a TOML file that is still TOML."""
    tree = tomllib.loads(data.decode())
    for _ in range(rng.choice((1, 1, 1, 2, 3))):
        spoil_tree(rng, tree)
    return toml_text(tree).encode("utf-8", "surrogatepass")


def spoiled_json(rng: random.Random, data: bytes) -> bytes:
    """A mutant of a JSON file that is still JSON."""
    tree = json.loads(data)
    for _ in range(rng.choice((1, 1, 1, 2, 3))):
        spoil_tree(rng, tree)
    return json.dumps(tree).encode()


def spoiled_lines(rng: random.Random, data: bytes) -> bytes:
    """A mutant of a file of lines, each JSON: one of them spoiled, dropped, doubled or cut."""
    lines = data.splitlines()
    place = rng.randrange(len(lines))
    match rng.choice(("json", "drop", "twice", "cut", "deep", "digit")):
        case "json":
            lines[place] = spoiled_json(rng, lines[place])
        case "drop":
            del lines[place]
        case "twice":
            lines.insert(place, lines[place])
        case "cut":
            lines[place] = lines[place][: rng.randrange(len(lines[place]))]
        case "deep":
            lines[place] = lines[place][:-1] + b', "x": ' + b"[" * DEEP + b"]" * DEEP + b"}"
        case _:
            lines[place] = lines[place].replace(b"1", b"7", 1)
    return b"\n".join(lines) + b"\n"


def spoiled_text(rng: random.Random, data: bytes) -> bytes:
    """A mutant of any text: a line dropped, doubled, swapped or cut, a number or a quoted word replaced."""
    lines = data.decode().split("\n")
    place, other = rng.randrange(len(lines)), rng.randrange(len(lines))
    match rng.choice(("drop", "twice", "swap", "cut", "number", "number", "number", "quoted", "quoted", "insert")):
        case "drop":
            del lines[place]
        case "twice":
            lines.insert(place, lines[place])
        case "swap":
            lines[place], lines[other] = lines[other], lines[place]
        case "cut":
            lines[place:] = [lines[place][: rng.randrange(len(lines[place]) + 1)]]
        case "number":
            return _replaced(rng, data.decode(), r"\b\d+(?:\.\d+)?(?:e-?\d+)?\b", WRITTEN_NUMBERS).encode()
        case "quoted":
            texts = [json.dumps(text, ensure_ascii=False) for text in HOSTILE_TEXTS]
            return _replaced(rng, data.decode(), r'"[^"\n]*"', texts).encode("utf-8", "surrogatepass")
        case _:
            lines.insert(
                place,
                rng.choice(
                    ("=", "[", "]", "{", "\t", "\\end{document}", "$", "x = 1", "% x", "\0", *HOSTILE_TEXTS[:20])
                ),
            )
    return "\n".join(lines).encode("utf-8", "surrogatepass")


def _replaced(rng: random.Random, text: str, pattern: str, by: tuple[str, ...] | list[str]) -> str:
    found = list(re.finditer(pattern, text))
    if not found:
        return text
    one = rng.choice(found)
    return text[: one.start()] + rng.choice(by) + text[one.end() :]


def _flipped(rng: random.Random, data: bytes, _: int) -> bytes:
    place = rng.randrange(max(1, len(data)))
    return data[:place] + bytes(byte ^ (1 << rng.randrange(8)) for byte in data[place : place + 1]) + data[place + 1 :]


def _with(*pieces: bytes) -> Callable[[random.Random, bytes, int], bytes]:
    return lambda rng, data, place: data[:place] + rng.choice(pieces) + data[place:]


# What is done to a file's bytes, with a place in them.
BYTES: dict[str, Callable[[random.Random, bytes, int], bytes]] = {
    "BOM": lambda _, data, __: b"\xef\xbb\xbf" + data,
    "UTF-16": lambda _, data, __: data.decode(errors="replace").encode("utf-16"),
    "Latin-1": _with("é".encode("latin-1")),
    "CRLF": lambda _, data, __: data.replace(b"\n", b"\r\n"),
    "CR": lambda _, data, __: data.replace(b"\n", b"\r"),
    "NUL": _with(b"\0"),
    "control": _with(b"\x1b[2J", b"\x07", b"\x0c", b"\x08", b"\x7f"),
    "bidi": _with("\u202e".encode()),
    "cut": lambda _, data, place: data[:place],
    "empty": lambda _, __, ___: b"",
    "blank": lambda _, __, ___: b" \n\t\n",
    "bit": _flipped,
    "random": lambda rng, _, __: rng.randbytes(2000),
    "zeros": lambda _, __, ___: bytes(1000),
    "long line": _with(b"x" * 1_000_000),
    "deep": lambda _, __, ___: b"[" * 100_000,
    "brackets": _with(b"{" * DEEP, b"[" * DEEP, b"(" * DEEP),
}


def spoiled_bytes(rng: random.Random, data: bytes) -> bytes:
    """A mutant of a file's bytes: another encoding, other ends of lines, control characters, cut or empty."""
    return BYTES[rng.choice(tuple(BYTES))](rng, data, rng.randrange(len(data) + 1))


def no_file(rng: random.Random, path: Path) -> str:
    """Something that is no regular file in the place of one; what it is."""
    what = rng.choice(("nothing", "folder", "pipe", "loop", "dangling link", "device", "memory", "huge", "socket"))
    path.unlink()
    match what:
        case "folder":
            path.mkdir()
        case "pipe":
            os.mkfifo(path)
        case "loop":
            path.symlink_to(path.name)
        case "dangling link":
            path.symlink_to("nowhere")
        case "device":
            path.symlink_to("/dev/zero")
        case "memory":
            path.symlink_to("/proc/self/mem")
        case "huge":
            with path.open("wb") as file:
                file.truncate(10**11)
        case "socket":
            with socket.socket(socket.AF_UNIX) as one:
                place = os.open(path.parent, os.O_RDONLY)
                one.bind(f"/proc/self/fd/{place}/{path.name}")
                os.close(place)
        case _:
            pass
    return what


MACROS = (
    r"\def\a{\a\a}\a", r"\newcommand{\a}[1]{\a{#1}\a{#1}}\a{x}", r"\input{paper}", r"\input{paper.tex}",
    r"\include{/dev/zero}", r"\input{/etc/passwd}", r"\def\a{" + "x" * 20_000 + "}" + r"\a" * 400,
    "".join(rf"\def\{b}{{\{a}\{a}\{a}\{a}}}" for a, b in pairwise("abcdefghijklmnop")) + r"\p",
    r"\begin{equation}" * 300, r"\end{document}", r"\newcommand{\alpha}{\beta}\newcommand{\beta}{\alpha}",
    r"\begin{equation}" + "{" * DEEP + r"\end{equation}", r"\begin{equation}" + r"\frac{x}" * DEEP + r"\end{equation}",
    r"\begin{theorem}" + "x = y. " * 20_000 + r"\end{theorem}", r"\label{" + "9" * 5000 + "}", r"\ref{\ref{\ref{}}}",
    "%" * 10_000, r"\catcode`\{=12", r"\verb|\end{equation}|", r"\begin{equation} x = 1 \tag{../../x} \end{equation}",
)


def spoiled_tex(rng: random.Random, data: bytes) -> bytes:
    """A LaTeX source with macros or inclusions that never end, or are of another kind, in it."""
    text = data.decode()
    place = rng.randrange(len(text) + 1)
    return (text[:place] + rng.choice(MACROS) + text[place:]).encode()


# By the kind of a file how it is spoiled beside by `spoiled_bytes` and `no_file`.
SPOILS: dict[str, Spoil] = {"toml": spoiled_toml, "json": spoiled_json, "jsonl": spoiled_lines,
                           "tex": spoiled_tex}


def spoil(rng: random.Random, path: Path) -> str:
    """Spoil a file in place; how."""
    chance = rng.random()
    if chance < 0.06:
        return no_file(rng, path)
    data = path.read_bytes()
    kind = path.suffix.removeprefix(".")
    if chance < 0.2 or kind == "parquet":
        how, text = "bytes", spoiled_bytes(rng, data)
    elif kind in SPOILS and chance < 0.85:
        how, text = kind, SPOILS[kind](rng, data)
    else:
        how, text = "text", spoiled_text(rng, data)
    path.write_bytes(text)
    return how
