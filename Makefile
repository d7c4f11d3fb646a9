# make install | ready | demo | test | lint | docs | prove | kernel | clean        PYTHON=python3.12 chooses the interpreter
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/.installed
TOOLS := $(VENV)/.installed-tools
PAGES := $(VENV)/.installed-docs

.PHONY: install ready demo test lint docs prove kernel clean

install: $(TOOLS)

$(BIN)/pip:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || \
		{ echo "$(PYTHON) is missing or older than 3.11: install Python 3.11 or newer, or name one: make install PYTHON=python3.12" >&2; exit 1; }
	@$(PYTHON) -c 'import ensurepip, venv' 2>/dev/null || \
		{ echo "$(PYTHON) has no venv module: install it (on Debian or Ubuntu: apt install python3-venv)" >&2; exit 1; }
	@$(PYTHON) -m venv $(VENV)

# pip compiles on one core, tests and tools that run as they are too; some files of packages are no Python of this version.
define INSTALL
@echo "installing into $(VENV), in constraints.txt's versions: some minutes"
@$(BIN)/python -m pip install -qq --no-compile --disable-pip-version-check -c constraints.txt -e ".[$(EXTRAS)]"
@$(BIN)/python -m compileall -qq -j 0 -x '/(tests?|pip|setuptools|mypy|debugpy)/' $(VENV)/lib || true
endef

# A stamp is newer than the two files that say what to install, so that a second call does nothing. The demo waits for
# no tool that only tests, style or pages need.
$(STAMP): EXTRAS := all
$(TOOLS): EXTRAS := all,test
$(PAGES): EXTRAS := all,docs
$(STAMP) $(TOOLS) $(PAGES): pyproject.toml constraints.txt | $(BIN)/pip
	$(INSTALL)
	@touch $(STAMP) $@

# All of it by one call of pip, which takes its time to find out what is there already.
ready: EXTRAS := all,docs,test
ready: | $(BIN)/pip
	$(INSTALL)
	@touch $(STAMP) $(TOOLS) $(PAGES)

demo: $(STAMP)
	@$(BIN)/workbench report proofs/yang2021 --out out/ --runs 5

# Strings are hashed alike in every run: what is found must not depend on it, but a test that fails fails again.
test: install
	@PYTHONHASHSEED=0 PYTHONDONTWRITEBYTECODE= $(BIN)/python -m pytest -n 2

lint: install
	@$(BIN)/ruff check
	@$(BIN)/mypy

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
