"""What the attacks by pasted lines share: the letters that the attacked module names."""

import pytest

from workbench.errors import WorkbenchError
from workbench.proof.latex.question import answer
from workbench.proof.latex.symbols import load_symbols


@pytest.fixture(scope="module")
def symbols(request, tmp_path_factory):
    """The letters of the module's SYMBOLS."""
    path = tmp_path_factory.mktemp("letters") / "symbols.toml"
    path.write_text(request.module.SYMBOLS)
    return load_symbols(path)


@pytest.fixture(scope="module")
def outcome(symbols):
    """What becomes of a line: its verdict, `refused` in one line, or `same` where nothing is left to decide."""
    def of(line, letters=symbols):
        try:
            return answer(line, letters).decision.verdict
        except WorkbenchError as trouble:
            assert "\n" not in str(trouble), line
            return "same" if "nothing is left" in str(trouble) else "refused"

    return of
