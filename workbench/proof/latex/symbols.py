"""The letters of a pasted line, from a TOML file or from a paper: what they stand for and what is known of them."""

from __future__ import annotations

import keyword
import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

import sympy as sp
from pydantic import Field

from workbench.errors import InputError
from workbench.files.toml import FileRecord, Text, load_record
from workbench.proof.claim import D, Relation
from workbench.proof.language import LANGUAGE
from workbench.proof.latex.commands import ACCENTS
from workbench.proof.latex.convert import Converter
from workbench.proof.latex.error import LatexError
from workbench.proof.latex.notation import Notation, without_dot
from workbench.proof.latex.read import read_line
from workbench.proof.latex.statement import relations, statement
from workbench.proof.latex.tree import Letter
from workbench.proof.latex.varying import printed_of_time, varies
from workbench.proof.latex.write import letters_of
from workbench.proof.paper import collect_papers

Kind = Literal["real", "positive", "nonnegative", "vector"]
INDEX, COUNT = sp.symbols("j n", integer=True, positive=True)


class SymbolsFile(FileRecord):
    """What a symbols file holds; all formulas are LaTeX.

    symbols: letters and what is known of each; a vector has components 1..n. definitions: letters that stand for an
    expression of letters before them. assumptions: relations that hold. flow: rates of the letters that move in time.
    inputs: letters without a rate that may vary in time, to which those printed as d(t) belong, or as f(x) where x
    moves; all others are constant.
    """

    symbols: dict[Text, Kind] = Field(min_length=1)
    definitions: dict[Text, Text] = Field(default_factory=dict)
    assumptions: tuple[Text, ...] = ()
    flow: dict[Text, Text] = Field(default_factory=dict)
    inputs: tuple[Text, ...] = ()


@dataclass(frozen=True)
class Symbols:
    """Letters ready for use: the notation, LaTeX for the names of symbols, assumptions, rates, limits of sums, the
    symbols that vary without a rate, and the formulas of definitions."""

    notation: Mapping[str, sp.Expr]
    letters: Mapping[str, str]
    assume: tuple[Relation, ...] = ()
    flow: Mapping[sp.Expr, sp.Expr] = field(default_factory=dict)
    limits: sp.Tuple | None = None
    inputs: tuple[sp.Symbol | sp.Indexed, ...] = ()
    definitions: Mapping[str, str] = field(default_factory=dict)
    declared: bool = False  # whether each letter is known to be a number or a column


def load_symbols(path: Path) -> Symbols:
    """The letters of a symbols file or of a paper's folder; raises InputError naming file, key and remedy."""
    return _of_paper(path) if path.is_dir() or path.suffix == ".py" else _of_file(path)


def _of_paper(path: Path) -> Symbols:
    papers = collect_papers([path])
    if len(papers) > 1:
        raise InputError(path, "", f"states {len(papers)} papers, whose letters differ: name the folder of one")
    notation = papers[0].notation
    if not notation:
        raise InputError(path, "notation", "the paper gives its letters no meaning: write Paper(..., notation={...})")
    limits = {total.limits[0] for meaning in notation.values() for total in meaning.atoms(sp.Sum)}
    return Symbols(notation, letters_of(notation.values()), limits=limits.pop() if len(limits) == 1 else None)


def _of_file(path: Path) -> Symbols:
    return symbols_in(load_record(path, SymbolsFile), path)


def symbols_in(record: SymbolsFile, path: Path) -> Symbols:
    """The letters of a record; path: the file that messages name."""
    notation: dict[str, sp.Expr] = {}
    letters: dict[str, str] = {}
    for typed, kind in record.symbols.items():
        name = _name(typed, letters)
        letters[name] = typed
        notation[typed] = _symbol(name, kind)
        if kind == "vector":
            notation[f"{{{typed}}}_j"] = notation[typed]
    vectors = any(kind == "vector" for kind in record.symbols.values())
    if vectors and {"n", "j"} & {str(symbol) for symbol in notation.values()}:
        raise InputError(path, "symbols", "n and j number the components of vectors: name the letters otherwise")
    limits = sp.Tuple(INDEX, 1, COUNT) if vectors else None
    if vectors:
        notation["n"] = COUNT
    if "t" not in record.symbols:
        notation["(t)"] = sp.S.One  # all is said of one instant
    _checked(path, "symbols", notation)
    varying = {notation[typed] for typed in (*record.flow, *record.inputs) if typed in notation}
    defined: dict[str, str] = {}
    for typed, formula in record.definitions.items():
        meaning = _expression(path, f"definitions.{typed}", formula, Notation(notation, defined, varying), limits)
        if typed in notation:
            raise InputError(path, f"definitions.{typed}", "is a symbol too: keep one of the two")
        notation[typed] = meaning
        _checked(path, f"definitions.{typed}", notation)
        defined[typed] = formula
    known = Notation(notation, defined, varying)
    flow: dict[sp.Expr, sp.Expr] = {}
    for typed, formula in record.flow.items():
        moving = notation.get(typed)
        if typed not in record.symbols or moving is None:
            raise InputError(path, f"flow.{typed}", "is none of the symbols: add it there, as it is typed here")
        flow[moving] = _expression(path, f"flow.{typed}", formula, known, limits,
                                   vector=isinstance(moving, sp.Indexed))
    _let_time_pass(path, record, notation, flow)
    _require_own_rates(path, record, notation, flow)
    inputs = _inputs(path, record, notation, flow)
    assume: list[Relation] = []
    for number, formula in enumerate(record.assumptions):
        try:
            stated = statement(read_line(formula), Converter(known, limits, declared=True))
        except LatexError as trouble:
            raise InputError(path, f"assumptions[{number}]", str(trouble)) from None
        if stated.conditions:
            raise InputError(path, f"assumptions[{number}]", "has a condition of its own: state relations only")
        assume += relations(stated.claimed)
    inputs = _with_varying(inputs, record, notation, flow)
    flow = _written_out(path, flow, inputs)
    return Symbols(notation, letters, tuple(assume), flow, limits, inputs, defined, declared=True)


def _let_time_pass(path: Path, record: SymbolsFile, notation: Mapping[str, sp.Expr],
                   flow: dict[sp.Expr, sp.Expr]) -> None:
    """Give the letter t the rate 1, by which all rates are; InputError where the file says that it has another one."""
    if "t" not in record.symbols:
        return
    if "t" in record.inputs or flow.setdefault(notation["t"], sp.S.One) != 1:
        raise InputError(path, "flow.t" if "t" in record.flow else "inputs", "gives the time t another rate than 1: "
                         "leave it out, or name the letter otherwise")


def _require_own_rates(path: Path, record: SymbolsFile, notation: Mapping[str, sp.Expr],
                       flow: Mapping[sp.Expr, sp.Expr]) -> None:
    """InputError for a letter with a dot that is not the rate of the letter below it, where that is known too."""
    letters = Notation(notation)
    for typed in (*record.symbols, *record.definitions):
        found = without_dot(key) if isinstance(key := read_line(typed).chains[0].sides[0], Letter) else None
        below = letters.meaning(found[0]) if found is not None else None
        if below is not None and (flow or typed in record.definitions) and (
                found is None or _rate_of(below, found[1], flow) != notation[typed]):
            part = "symbols" if typed in record.symbols else "definitions"
            raise InputError(path, f"{part}.{typed}", "is the rate of a letter that is given too: state it as that "
                             "letter's rate under [flow], or leave one of the two out")


def _rate_of(moving: sp.Expr, order: int, flow: Mapping[sp.Expr, sp.Expr]) -> sp.Expr | None:
    """What the flow gives as the first, second, ... rate, where each rate is a letter with a rate of its own."""
    found: sp.Expr | None = moving
    for _ in range(order):
        found = flow.get(found) if found is not None else None
    return found


def _written_out(path: Path, flow: Mapping[sp.Expr, sp.Expr], inputs: Collection[sp.Expr]) -> dict[sp.Expr, sp.Expr]:
    """Rates in which rates of other letters stand, as `s' = e' + c e`, with these put in; InputError where one of
    them is not given, or needs itself."""
    def along(part: sp.Expr, moving: sp.Expr) -> sp.Expr:
        if part.has(sp.Abs, sp.sign, sp.Max, sp.Min, sp.Sum, sp.Indexed):
            raise InputError(path, f"flow.{moving}", f"has the rate of {part}, which may have none: write it out")
        if unknown := sorted(map(str, part.free_symbols & set(inputs))):
            raise InputError(path, f"flow.{moving}", f"has a rate of {unknown[0]}, which has none: give it one under "
                             "[flow], as a letter of its own if nothing more is known")
        moved = sorted(part.free_symbols & flow.keys(), key=str)
        return sp.Add(*(sp.diff(part, symbol) * flow[symbol] for symbol in moved))

    for moving, rate in flow.items():
        if rate == D(moving):
            raise InputError(path, f"flow.{moving}", f"says that the rate is the rate: add the rate as a letter under "
                             f"[symbols], as '\\dot {moving}', and give it its own rate under [flow]")
    found = dict(flow)
    for _ in flow:
        for moving, rate in found.items():
            inner = {one: along(one.args[0], moving) for one in rate.atoms(D) if not one.args[0].has(D)}
            found[moving] = rate.xreplace(inner)
    for moving, rate in found.items():
        if rate.has(D):
            raise InputError(path, f"flow.{moving}", "needs itself by way of other rates: solve for the rate")
    return found


def _inputs(path: Path, record: SymbolsFile, notation: Mapping[str, sp.Expr],
            flow: Mapping[sp.Expr, sp.Expr]) -> tuple[sp.Symbol | sp.Indexed, ...]:
    """The symbols that may vary without a rate."""
    inputs: list[sp.Symbol | sp.Indexed] = []
    for number, typed in enumerate(record.inputs):
        varying = notation[typed] if typed in record.symbols else None
        if not isinstance(varying, (sp.Symbol, sp.Indexed)):
            raise InputError(path, f"inputs[{number}]", f"{typed!r} is none of the symbols: add it there, as it is "
                             "typed here")
        if varying in flow:
            raise InputError(path, f"inputs[{number}]", f"{typed!r} has a rate under [flow] too: keep one of the two")
        inputs.append(varying)
    return tuple(inputs)


def _with_varying(inputs: tuple[sp.Symbol | sp.Indexed, ...], record: SymbolsFile, notation: Mapping[str, sp.Expr],
                  flow: Mapping[sp.Expr, sp.Expr]) -> tuple[sp.Symbol | sp.Indexed, ...]:
    """The inputs, with what the file itself prints as a function of time, or of what moves, and gives no rate."""
    letters = Notation(notation)
    of_time = set().union(*(printed_of_time(read_line(text), letters)
                            for text in (*record.definitions.values(), *record.flow.values(), *record.assumptions)))
    moving = {*flow, *inputs, *of_time}
    more = [notation[typed] for typed in record.symbols
            if notation[typed] in of_time or varies(read_line(typed).chains[0].sides[0], moving, letters)]
    return (*inputs, *(symbol for symbol in more if symbol not in flow and symbol not in inputs
                       and isinstance(symbol, (sp.Symbol, sp.Indexed))))


def _expression(path: Path, key: str, formula: str, notation: Notation, limits: sp.Tuple | None,
                vector: bool = False) -> sp.Expr:
    try:
        line = read_line(formula)
        if len(line.chains) != 1 or line.chains[0].signs:
            raise LatexError("a relation where an expression is expected: write its right side alone")
        converter = Converter(notation, limits, declared=True)
        side = line.chains[0].sides[0]
        return converter.expression(side) if vector else converter.side(side)
    except LatexError as trouble:
        raise InputError(path, key, str(trouble)) from None


def _checked(path: Path, key: str, notation: Mapping[str, sp.Expr]) -> None:
    try:
        Notation(notation)
    except LatexError as trouble:
        raise InputError(path, key, str(trouble)) from None


_ACCENTED = {"overline": "bar", "widehat": "hat", "widetilde": "tilde"}  # what else accents are typed by


def _symbol(name: str, kind: Kind) -> sp.Expr:
    if kind == "vector":
        return sp.IndexedBase(name, real=True)[INDEX]
    return sp.Symbol(name, **{kind: True})


def _name(typed: str, taken: Mapping[str, str]) -> str:
    """A name for certificates: the letters and digits of what is typed, accents behind their letter, `theta_hat`."""
    parts, accents = list[str](), list[str]()
    for part in re.findall(r"\\?[A-Za-z]+|\d+", typed):
        command = part.removeprefix("\\")
        if part != command and command in ACCENTS:
            accents.insert(0, _ACCENTED.get(command, command))
        else:
            parts += [command, *accents]
            accents = []
    name = "_".join([*parts, *accents]) or "x"
    if not name[0].isalpha():
        name = f"x_{name}"
    if keyword.iskeyword(name) or name in LANGUAGE:
        name += "_"
    number, found = 2, name
    while found in taken:
        found, number = f"{name}_{number}", number + 1
    return found

