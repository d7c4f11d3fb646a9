"""Files with a mistake, and the one line that must be said about it."""

from pathlib import Path

import pytest

from workbench.errors import InputError


def changed(text: str, old: str, new: str) -> str:
    assert old in text, f"the shipped file no longer holds {old!r}"
    return text.replace(old, new, 1)


def changed_copy(file: Path, folder: Path, old: str, new: str) -> Path:
    """A copy of a file under its own name, with a mistake."""
    path = folder / file.name
    path.write_text(changed(file.read_text(encoding="utf-8"), old, new), encoding="utf-8")
    return path


def refusal(read, *arguments) -> str:
    """What is said when something cannot be read: a line that can be printed."""
    with pytest.raises(InputError) as caught:
        read(*arguments)
    message = str(caught.value)
    assert len(message.splitlines()) == 1
    assert message.isprintable()
    return message
