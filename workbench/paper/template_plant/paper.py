"""$name: what the paper is about, in a line. A small adaptive controller stands here in its place, to be replaced.

`workbench prove`, `compare`, `sweep`, `tune`, `gains` and `report` take this folder; `workbench list` says what it has.
"""

from workbench.proof.paper import Paper

paper = Paper("$name", "A. Author, The title, The journal volume (year) pages")
