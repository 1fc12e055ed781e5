# The commands of the project; `make help` lists them.
#
# Set-up is a .venv of pinned packages, made once and remade when requirements.txt changes. Nothing
# outside this folder is written. Builds of the simulators are cached by content in build/.

PYTHON ?= python3
VENV   := .venv
READY  := $(VENV)/ready
BIN    := $(VENV)/bin
# Nothing is written outside this folder, and no cache beside the sources.
export PYTHONPYCACHEPREFIX := $(CURDIR)/build/pycache
export HYPOTHESIS_STORAGE_DIRECTORY := $(CURDIR)/build/hypothesis
unexport WAVES SIM SEED UNIT COVERAGE

UNITS  := $(patsubst verif/units/%/unit.py,%,$(wildcard verif/units/*/unit.py))
JOBS   ?= $(shell nproc 2>/dev/null || echo 2)

# A command line option for a variable that is set: $(call option,--size,SIZE)
option = $(if $($(2)),$(1) '$($(2))')

.DEFAULT_GOAL := help
.PHONY: help setup render video test unit smoke nightly coverage lint format bench book synth weigh close breaks mutate header requirements clean

help: ## lists the commands
	@echo "Commands (make <command> [NAME=value ...]):"
	@grep -hE '^[a-z]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/^([a-z]+):.*## /  \1\t/' | expand -t 16

setup: $(READY) ## makes the Python environment, once

$(READY): requirements.txt
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
		{ echo "$(PYTHON) is older than 3.11: name a newer one with PYTHON=..." >&2; exit 2; }
	@echo "Setting up $(VENV), once ..."
	@rm -rf $(VENV)
	@$(PYTHON) -m venv $(VENV)
	@$(BIN)/pip install --quiet --disable-pip-version-check --no-cache-dir --require-hashes -r requirements.txt
	@touch $@

render: $(READY) ## draws a scene through the RTL: [SCENE=file] [SIZE=WxH] [OUT=dir] [SIM=icarus] [BUILD=wide] [DEPTH=n] [PIXEL=x,y]
	@$(BIN)/python -m verif.render $(call option,--scene,SCENE) $(call option,--size,SIZE) $(call option,--out,OUT) \
		$(call option,--sim,SIM) $(call option,--build,BUILD) $(call option,--depth,DEPTH) $(call option,--pixel,PIXEL)

video: $(READY) ## films a moving camera through the RTL's screen: [SCENE=file | PICTURES=dir] [CORE=rtl] [FRAMES=n] [RATE=n] [OUT=dir]
	@$(BIN)/python -m verif.video $(call option,--scene,SCENE) $(call option,--pictures,PICTURES) \
		$(call option,--core,CORE) $(call option,--frames,FRAMES) $(call option,--rate,RATE) $(call option,--out,OUT)

test: lint ## runs every test
	@$(BIN)/python -m pytest -n $(JOBS)

unit: $(READY) ## runs one unit's bench: UNIT=sqrt [SIM=icarus] [SET=narrow] [SEED=n] [WAVES=1] [COVERAGE=1] [EXAMPLES=n] [OPERANDS=n]
	@test -n "$(filter $(UNITS),$(UNIT))" || { echo "UNIT=$(UNIT) is no unit; one of: $(UNITS)" >&2; exit 2; }
	@$(BIN)/python -m pytest verif/test_units.py --unit '$(UNIT)' $(call option,--sim,SIM) $(call option,--seed,SEED) \
		$(call option,--set,SET) $(call option,--examples,EXAMPLES) $(call option,--operands,OPERANDS) $(if $(WAVES),--waves) \
		$(if $(COVERAGE),--code-coverage)

smoke: $(READY) ## runs every unit and a small core shortly, in two minutes: [SEED=n] [ONLY=pattern]
	@$(BIN)/python -m regressions run smoke --jobs $(JOBS) $(call option,--seed,SEED) $(call option,--only,ONLY)

nightly: $(READY) ## runs all there is in 45 minutes, with one record of it: [SEED=n] [ONLY=pattern]
	@$(BIN)/python -m regressions run nightly --jobs $(JOBS) $(call option,--seed,SEED) $(call option,--only,ONLY)

coverage: $(READY) ## draws the page of the latest regression, coverage and all: [RECORD=file]
	@$(BIN)/python -m regressions.report $(call option,--record,RECORD)

lint: $(READY) ## checks Verilog, Python and types, all warnings on
	@$(BIN)/ruff check --quiet
	@$(BIN)/ruff format --check --quiet
	@$(BIN)/mypy
	@$(BIN)/python -m verif.lint

format: $(READY) ## formats the Python
	@$(BIN)/ruff check --quiet --fix
	@$(BIN)/ruff format --quiet

bench: $(READY) ## measures: cocotb against a bare C++ loop, the model against the RTL
	@$(BIN)/python -m verif.bench

book: $(READY) ## repeats the book's experiments and writes hdl/BOOK.md: [ONLY=timing]
	@$(BIN)/python -m verif.book $(ONLY)

synth: $(READY) ## synthesises for an ECP5 with yosys and counts what it takes: [TOP=raytracer]
	@$(BIN)/python -m regressions.synthesis $(TOP)

weigh: $(READY) ## counts the tests that the scenes need, by kind, for the choice of trace units
	@$(BIN)/python -m models.weigh

close: $(READY) ## closes functional coverage, and compares with random: [UNIT=sqrt] [SECONDS=120] [SEED=n]
	@$(BIN)/python -m verif.coverage $(UNIT) $(call option,--seconds,SECONDS) $(call option,--seed,SEED) --jobs $(JOBS)

breaks: $(READY) ## breaks the Verilog a line at a time and shows that the benches notice: [UNIT=sqrt] [SIM=icarus]
	@$(BIN)/python -m verif.env.breaks $(UNIT) $(call option,--sim,SIM)

mutate: $(READY) ## qualifies benches by mutation: UNIT=sqrt|core-control|all [MUTANTS=200] [SEED=n]
	@test -n "$(UNIT)" || { echo "mutate needs UNIT=unit, core-control or all; units: $(UNITS)" >&2; exit 2; }
	@$(BIN)/python -m verif.mutation $(UNIT) --jobs $(JOBS) $(call option,--mutants,MUTANTS) $(call option,--seed,SEED)

header: $(READY) ## writes hdl/raytracer.vh and the tables of hdl/README.md from the tables in models/
	@$(BIN)/python -m models.header
	@$(BIN)/python -m models.stages

requirements: $(READY) ## pins requirements.txt anew from pyproject.toml
	@$(BIN)/pip install --quiet --disable-pip-version-check pip-tools
	@$(BIN)/pip-compile --quiet --generate-hashes --strip-extras --no-header --no-emit-index-url --no-emit-find-links \
		--no-emit-options --output-file requirements.txt pyproject.toml

clean: ## removes builds, runs and pictures; the environment stays
	rm -rf build
