# Two commands for a newcomer: `make practice` and `make test`. Each sets up what is missing first.
# `make check` is what a developer runs before every commit; CI runs the same through `make test`.

VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready
EXTRAS := $(wildcard benchmarks examples)

# The tests start a hundred programs: what one of them has compiled the others read.
unexport PYTHONDONTWRITEBYTECODE

.PHONY: practice test check format lint types imports unit setup setup-test oracles bench soak clean help

help:  ## list the targets
	@grep -hE '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 14

practice: $(READY)  ## set up what is missing, then practise: in a window, or headless where there is no screen
	@$(BIN)/station practice

setup: $(READY)  ## install system packages, make .venv, install the station and its developers' tools

$(READY): pyproject.toml constraints.txt tools/setup.sh
	@tools/setup.sh $(VENV)
	@touch $(READY)

setup-test: $(READY)
	@tools/setup.sh --test-packages

# Types are checked while the tests' packages come; then the tests, which wait much at first, run beside that.
test: PACKAGES := setup-test
test: check  ## the same set-up, then every check and every test

check: format lint  ## what must be green before a commit
	@$(MAKE) --no-print-directory -j 2 unit types imports PACKAGES=$(PACKAGES)

format: $(READY)
	@$(BIN)/ruff format --check --quiet station tests $(EXTRAS)

lint: $(READY)
	@$(BIN)/ruff check --quiet --output-format concise station tests $(EXTRAS)

types: $(READY)
	@$(BIN)/mypy

imports: $(READY)
	@$(BIN)/lint-imports --no-cache | tail -n 12

unit: $(READY) $(PACKAGES)
	@$(BIN)/python -m pytest -q -n 2 --dist loadgroup --no-loadscope-reorder

oracles: $(READY)  ## comparisons with files that may not be passed on, read from ORACLES=../shared/data (tests/oracles)
	@ORACLES=$(or $(ORACLES),../shared/data) $(BIN)/python -m pytest -q -r fE -m oracle tests/oracles

bench: $(READY)  ## the benchmarks, at most five minutes
	@$(BIN)/station bench

soak: setup-test  ## the benchmarks and the long ones: floods, plug cycles, a million hostile inputs; half an hour
	@$(BIN)/station bench --soak
	@PYTHONPATH=. $(BIN)/python benchmarks/hit_to_sound.py --periods 128 --seconds 600 --a-second 33.4
	@PYTHONPATH=. $(BIN)/python benchmarks/ten_minutes.py

clean:  ## remove the virtual environment and caches
	rm -rf $(VENV) .mypy_cache .ruff_cache .pytest_cache .hypothesis .import_linter_cache
