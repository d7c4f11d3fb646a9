# make install | demo | test | lint | docs | prove | kernel | clean        PYTHON=python3.12 chooses the interpreter
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/.installed
TOOLS := $(VENV)/.installed-tools
PAGES := $(VENV)/.installed-docs

.PHONY: install demo test lint docs prove kernel clean

install: $(TOOLS)

# A stamp is newer than the two files that say what to install, so that a second call does nothing. What the package
# needs to run comes first: the demo waits for no tool that only tests and style need.
$(STAMP): pyproject.toml constraints.txt
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || \
		{ echo "$(PYTHON) is missing or older than 3.11: install Python 3.11 or newer, or name one: make install PYTHON=python3.12" >&2; exit 1; }
	@$(PYTHON) -c 'import ensurepip, venv' 2>/dev/null || \
		{ echo "$(PYTHON) has no venv module: install it (on Debian or Ubuntu: apt install python3-venv)" >&2; exit 1; }
	@$(PYTHON) -m venv $(VENV)
	@$(BIN)/python -m pip install -qq --disable-pip-version-check -c constraints.txt -e ".[all]"
	@touch $@

$(TOOLS): $(STAMP)
	@$(BIN)/python -m pip install -qq --disable-pip-version-check -c constraints.txt -e ".[all,test]"
	@touch $@

demo: $(STAMP)
	@$(BIN)/workbench report proofs/yang2021 --out out/ --runs 5

test: install
	@$(BIN)/python -m pytest -n 2

lint: install
	@$(BIN)/ruff check
	@$(BIN)/mypy

$(PAGES): $(STAMP)
	@$(BIN)/python -m pip install -qq --disable-pip-version-check -c constraints.txt -e ".[all,docs]"
	@touch $@

# Every notebook is run and every warning is an error; out/docs/index.html is where to begin.
docs: $(PAGES)
	@$(BIN)/python -m sphinx -q -E -W -n --keep-going -b html -d out/doctrees docs out/docs

prove: $(STAMP)
	@$(BIN)/workbench prove proofs

# Every certificate of the examples before Coq's kernel. Coq is not installed by this: without it, what is missing is said.
kernel:
	@command -v coqc >/dev/null || { echo "coqc is missing: on Debian or Ubuntu: apt install coq libcoq-interval libcoq-coquelicot" >&2; exit 1; }
	@test -x $(BIN)/workbench || { echo "the workbench is missing: run make install" >&2; exit 1; }
	@set -e; for paper in proofs/*/; do \
		$(BIN)/workbench export-coq $$paper --out out/kernel/$$(basename $$paper); \
		$(BIN)/workbench check-coq out/kernel/$$(basename $$paper) --record $$paper; done

clean:
	rm -rf $(VENV) out .cache .hypothesis .mypy_cache .pytest_cache .ruff_cache build *.egg-info
	find workbench proofs tests benchmarks docs -name __pycache__ -type d -prune -exec rm -rf {} +
