"""The committed picture of the rooms shows the imports that the code has, and these obey the one-way rule."""

import importlib.util
import re
import xml.etree.ElementTree as ET
from collections import Counter
from pathlib import Path

import pytest
import test_architecture

DOCS = Path(__file__).resolve().parent.parent / "docs"


@pytest.fixture(scope="module")
def rooms():
    spec = importlib.util.spec_from_file_location("rooms", DOCS / "rooms.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_picture_shows_the_imports_of_the_code(rooms):
    drawn = {(edge.get("data-from"), edge.get("data-to")) for edge in ET.parse(rooms.PICTURE).getroot().iter()
             if edge.get("data-from")}
    assert drawn == set(rooms.edges()), "draw it again: python docs/rooms.py"


def test_the_imports_obey_the_rule_that_the_picture_is_drawn_by(rooms):
    found = rooms.edges()
    assert len(found) > 30
    assert rooms.against_the_rule(found) == []
    assert [set(floor) for floor in rooms.ORDER] == [set(floor) for floor in test_architecture.ORDER]


def test_an_import_against_the_rule_is_found(rooms, tmp_path):
    package = tmp_path / "workbench"
    for room, line in (("files", "from workbench.model import law"), ("mpc", "import workbench.gains.lmi"),
                       ("gains", "from workbench import mpc"), ("cli", "from workbench.files.toml import x")):
        (package / room).mkdir(parents=True)
        (package / room / "a.py").write_text(line)
    found = rooms.edges(package)
    assert found == Counter({("files", "model"): 1, ("mpc", "gains"): 1, ("gains", "mpc"): 1, ("cli", "files"): 1})
    assert set(rooms.against_the_rule(found)) == {("files", "model"), ("mpc", "gains"), ("gains", "mpc")}
    assert len(re.findall("<g data-from", rooms.picture(found))) == 4
