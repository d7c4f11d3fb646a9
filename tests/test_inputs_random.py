"""Random bad input: whatever is written, a file loads or is refused in one line."""

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st
from input_mistakes import LINE, LINE_TEXT, TEXT
from scenarios import YANG

from workbench.errors import InputError
from workbench.simulate.law_values import check_controllers
from workbench.trains.scenario import load_scenario
from workbench.trains.track import load_track

JUNK = st.sampled_from([
    "nan", "inf", "-inf", "true", '""', '"x"', "-1", "0", "0.1", "3", "1e300", "1e-300", "-1e308", "5e-324",
    "999999999999", "9" * 25, "0x" + "f" * 5000, "[]", "[1, 2]", "{}", "{ a = 1 }", "1979-05-27", "07:32:00",
    "'''a\nb'''", "\x00", '"\\u0000"', '"yang2021.pocrac"', "=",
])
LINES = {YANG: TEXT.splitlines(), LINE: LINE_TEXT.splitlines()}


@st.composite
def mutations(draw):
    """A shipped scenario or line with lines deleted, doubled or swapped, or values replaced by junk."""
    path = draw(st.sampled_from([YANG, LINE]))
    lines = list(LINES[path])
    for _ in range(draw(st.integers(1, 3))):
        at = draw(st.integers(0, len(lines) - 1))
        match draw(st.sampled_from(["delete", "double", "swap", "value", "number"])):
            case "delete":
                del lines[at]
            case "double":
                lines.insert(at, lines[at])
            case "swap":
                other = draw(st.integers(0, len(lines) - 1))
                lines[at], lines[other] = lines[other], lines[at]
            case "value":
                lines[at] = lines[at].split("=")[0] + "= " + draw(JUNK)
            case "number":
                words = lines[at].split(" ")
                numbers = [i for i, word in enumerate(words) if word.strip(",").replace(".", "").isdigit()]
                if numbers:
                    words[draw(st.sampled_from(numbers))] = draw(JUNK) + ","
                lines[at] = " ".join(words)
    return path, "\n".join(lines)


@pytest.fixture(scope="module")
def playground(tmp_path_factory):
    return tmp_path_factory.mktemp("mutations")


@given(mutations())
def test_a_mutated_file_loads_or_is_refused_in_one_line(playground, mutation):
    path, text = mutation
    for target, content in {YANG: TEXT, LINE: LINE_TEXT, path: text}.items():
        (playground / target.name).write_text(content, encoding="utf-8")
    try:
        check_controllers(load_scenario(playground / YANG.name), playground / YANG.name)
    except InputError as refused:
        message = str(refused)
        assert message.startswith(str(playground))
        assert message.isprintable()


def _covered(sections: list[tuple[int, int]], length: int) -> bool:
    """Independent of the order the loader checks in: every metre is in exactly one section, in order."""
    metres = [metre for start, end in sections for metre in range(start, end)]
    return all(start < end for start, end in sections) and metres == list(range(length))


@st.composite
def section_lists(draw):
    """Sections that cover a line of 40 m, or nearly: a border moved, a section dropped, doubled, swapped."""
    length = 40
    edges = [0, *sorted(draw(st.sets(st.integers(1, length - 1), max_size=5))), length]
    sections = [list(pair) for pair in pairwise(edges)]
    for _ in range(draw(st.integers(0, 2))):
        at = draw(st.integers(0, len(sections) - 1))
        match draw(st.sampled_from(["move", "drop", "double", "swap", "nothing"])):
            case "move":
                border = draw(st.integers(0, 1))
                sections[at][border] = max(0, sections[at][border] + draw(st.integers(-3, 3)))
            case "drop" if len(sections) > 1:
                del sections[at]
            case "double":
                sections.insert(at, list(sections[at]))
            case "swap":
                other = draw(st.integers(0, len(sections) - 1))
                sections[at], sections[other] = sections[other], sections[at]
    return [tuple(section) for section in sections], length


@given(section_lists(), st.sampled_from(["grade", "curve"]))
def test_sections_are_accepted_exactly_when_they_cover_the_line_once(playground, drawn, kind):
    sections, length = drawn
    whole = [(0, length)]
    value = {"grade": "grade_permille = 1.0", "curve": "radius_m = 500.0"}
    text = f'name = "drawn"\nlength_m = {length}.0\n'
    for layer in ("grade", "curve"):
        rows = [f"{{ start_m = {a}.0, end_m = {b}.0, {value[layer]} }}"
                for a, b in (sections if layer == kind else whole)]
        text += f"{layer} = [{', '.join(rows)}]\n"
    text += "[source]\n"
    text += "".join(f'{key} = "assumed: a test"\n' for key in ("name", "length_m", "grade", "curve"))
    path = playground / "drawn.toml"
    path.write_text(text, encoding="utf-8")
    if _covered(sections, length):
        assert load_track(path).length_m == length
    else:
        with pytest.raises(InputError, match=f"drawn.toml: {kind}"):
            load_track(path)
