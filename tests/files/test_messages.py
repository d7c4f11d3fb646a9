"""What is said of a file stays readable, whatever the file holds."""

from __future__ import annotations

from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st

from workbench.errors import LONGEST_PART, InputError


def test_a_key_and_a_value_of_any_length_leave_place_and_remedy_in_sight() -> None:
    said = str(InputError("line.toml", "k" * 200_000, f"is no number, {'9' * 200_000}: correct it"))
    assert len(said) < 3 * LONGEST_PART
    assert said.startswith("line.toml: kkk") and said.endswith("999: correct it")
    assert said.count("(200000 characters)") == 1


@given(st.text(max_size=2000), st.text(max_size=2000))
def test_every_message_is_one_printable_line_and_travels_whole(key: str, problem: str) -> None:
    error = InputError(Path("f.toml"), key, problem)
    said = str(error)
    assert said.isprintable() and len(said) <= 2 * LONGEST_PART + 20
    made, arguments = error.__reduce__()
    assert str(made(*arguments)) == said and arguments == ("f.toml", key, problem)
