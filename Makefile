# make install | demo | test | lint | prove | clean        PYTHON=python3.12 chooses the interpreter
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/.installed

.PHONY: install demo test lint prove clean

install: $(STAMP)

# The stamp is newer than the two files that say what to install, so that a second call does nothing.
$(STAMP): pyproject.toml constraints.txt
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || \
		{ echo "$(PYTHON) is missing or older than 3.11: install Python 3.11 or newer, or name one: make install PYTHON=python3.12" >&2; exit 1; }
	@$(PYTHON) -c 'import ensurepip, venv' 2>/dev/null || \
		{ echo "$(PYTHON) has no venv module: install it (on Debian or Ubuntu: apt install python3-venv)" >&2; exit 1; }
	@$(PYTHON) -m venv $(VENV)
	@$(BIN)/python -m pip install -qq --disable-pip-version-check -c constraints.txt -e ".[test]"
	@touch $@

demo: install
	@$(BIN)/workbench report benchmarks/yang2021.toml proofs/yang2021.py --out out/ --runs 20

test: install
	@$(BIN)/python -m pytest -n 2

lint: install
	@$(BIN)/ruff check
	@$(BIN)/mypy

prove: install
	@$(BIN)/workbench prove proofs

clean:
	rm -rf $(VENV) out .cache .hypothesis .mypy_cache .pytest_cache .ruff_cache build *.egg-info
	find workbench proofs tests benchmarks -name __pycache__ -type d -prune -exec rm -rf {} +
