# wrapit: from a line drawing to wire-wrapped jewellery. `make` lists what can be made.
SHELL := /bin/bash
# The Pythons that the kernel's wheels exist for, best first; pyproject.toml promises the same.
PYTHONS := 3.13 3.12 3.11
# The one to use instead of the first of these that works: make PYTHON=/opt/python3.12/bin/python3 demo
PYTHON ?=
VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready
# build/NAME for each config; a space in a name (and what else make would stumble upon) gets its backslash.
PIECES := $(shell for each in configs/*.yaml; do [ ! -e "$$each" ] || echo "$$each"; done \
  | sed -e 's|^configs/\(.*\)\.yaml$$|build/\1|' -e 's/[[ |;:*?]/\\&/g')
SOURCES := $(shell find wrapit -name '*.py' -o -name '*.jinja' -o -name '*.css' -o -name '*.js' -o -name '*.ftl' \
  -o -name '*.html' -o -name '*.yaml')
JOBS ?= auto
# A word as the shell reads it: in quotes.
quoted = '$(subst ','\'',$(1))'

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.PHONY: help setup demo all check format lint types imports test golden pictures bench docs clean FORCE

help: ## list the targets
	@awk -F ':.*## ' '/^[a-z%\/-]+:.*## / {printf "  %-16s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

setup: $(READY) ## create .venv with wrapit and its tools

# Looked at whenever it is needed, for the system's Python may have changed under it; remade only then.
$(VENV)/.python: FORCE
	@GOALS='$(MAKECMDGOALS)' .ci/make-venv $(VENV) '$(PYTHONS)' '$(PYTHON)'

FORCE:

$(READY): $(VENV)/.python pyproject.toml requirements.lock
	$(BIN)/python -m pip install --quiet --disable-pip-version-check -c requirements.lock -e '.[dev]'
	@touch $@

demo: $(READY) ## build the butterfly from its bitmap and say where the files are
	@$(BIN)/wrapit build configs/butterfly.yaml -o build/butterfly --force -MF build/.deps/butterfly.d
	@echo && echo "The butterfly is in build/butterfly; open build/butterfly/guide.html in a browser." \
	  && ls -1 build/butterfly

all: $(PIECES) ## build every config (use -j)

# One report per piece. wrapit says in build/.deps what it read and wrote: make builds a piece again when its
# config, its drawing (wherever that is) or wrapit changed, or when one of its files is gone.
build/%: build/%/report.json ; @: ## build one piece: make build/leaf

build/%/report.json: configs/%.yaml $(READY) $(SOURCES)
	$(BIN)/wrapit build $(call quoted,$<) -o $(call quoted,build/$*) --force -MF $(call quoted,build/.deps/$*.d)

# The report says which files are wrapit's own: make is never to delete it.
.PRECIOUS: build/%/report.json
-include build/.deps/*.d

# What was not made here last may be of another drawing, of other settings or half done, so it is built again.
$(shell cd build 2>/dev/null && for each in */report.json; do \
  [ ! "$$each" -nt ".deps/$${each%/report.json}.d" ] || echo "build/$$each"; done \
  | sed -e 's/[[ :*?%]/\\&/g') .foreign: FORCE

check: lint types imports ## every gate: lint, format, types, import arrows

format: $(READY) ## format the code
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

lint: $(READY)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: $(READY)
	$(BIN)/mypy

imports: $(READY)
	$(BIN)/lint-imports

test: $(READY) ## the whole test suite
	$(BIN)/python -m pytest -n $(JOBS) tests

golden: $(READY) ## write the golden numbers anew, to be looked at before they are committed
	$(BIN)/python -m tests.golden

pictures: $(READY) ## make the README's pictures anew
	$(BIN)/python examples/pictures.py

bench: $(READY) ## measure accuracy and speed
	$(BIN)/python -m tests.bench

docs: $(READY) ## write wrapit/TROUBLESHOOTING.md anew
	$(BIN)/python -m tests.docs

clean: ## remove what was built (keeps .venv)
	rm -rf build .pytest_cache .ruff_cache .mypy_cache .hypothesis .import_linter_cache
