"""Section VIII as study.toml states it."""

from __future__ import annotations

from pathlib import Path

from workbench.files.toml import read_toml

stated = read_toml(Path(__file__).with_name("study.toml"))
modes, cases = stated["modes"], stated["cases"]
