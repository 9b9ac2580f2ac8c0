# make paper: every figure and table of the paper.   make test: the tests.   make help: the rest.
PYTHON ?= $(shell command -v python3.11 || command -v python3)
CORES ?= 2
TARGETS ?=
CONFIG ?= config/config.yaml
FAULTS ?= 200
SEED ?=

VENV := .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/environment.stamp
SNAKEMAKE = $(BIN)/snakemake $(TARGETS) --cores $(CORES) \
	--workflow-profile workflow/profiles/default

.DEFAULT_GOAL := help
.PHONY: help paper report quick test lint docs bench reference schema lock clean-venv \
	check bundle restore torture

help: ## This list
	@grep -hE '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 14
	@echo "Variables: PYTHON (3.11) CORES=$(CORES) TARGETS='figure_3 lengths' (all if empty)"

paper: $(STAMP) ## Make every figure, table and verdict, in results/
	$(SNAKEMAKE)

report: $(STAMP) ## Make results/report.html: verdicts, figures, theory with sliders, in half an hour
	$(BIN)/snakemake report --cores $(CORES) --workflow-profile workflow/profiles/default

quick: $(STAMP) ## The same on coarse grids in a minute, in results/quick/
	$(SNAKEMAKE) --configfile config/quick.yaml

test: $(STAMP) ## Run the tests
	@$(BIN)/python -m pytest -n $(CORES) --dist loadfile --no-loadscope-reorder

torture: $(STAMP) ## Kill, damage and fill disks FAULTS=200 times (SEED=1): nothing may be lost
	PYTHONPATH=src $(BIN)/python tests/faults/torture.py $(FAULTS) $(SEED)

lint: $(STAMP) ## Check the code's style and types
	@$(BIN)/ruff check .
	@$(BIN)/mypy

docs: $(STAMP) ## Build the documentation, its tutorials executed, in docs/_build/html/
	$(BIN)/sphinx-build -W --keep-going -q -b html docs docs/_build/html

bench: $(STAMP) ## Measure the solver's speed on one core, in some minutes
	OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 $(BIN)/python -m nucleation.pipeline.benchmark \
		config/config.yaml

reference: $(STAMP) ## Make the committed reference set again, from the results of the workflow
	$(BIN)/snakemake paper figure_patch_stability figure_3_extended figure_convergence \
		figure_sensitivity figure_verification figure_dispersion animation \
		--cores $(CORES) --workflow-profile workflow/profiles/default
	mkdir -p results/reference
	cp results/lengths.csv results/patch_stability.csv results/patch_convergence.csv \
		results/twin_runs.csv results/verification.csv \
		results/dispersion.csv results/convergence.csv results/sensitivity.csv \
		results/figures/*.png results/figures/animation.gif \
		results/tables/claims.csv results/tables/claims.md results/reference/
	sed 's|](figures/|](|' results/article.md > results/reference/article.md

check: $(STAMP) ## List results that are stale, incomplete, damaged or foreign
	$(BIN)/snakemake check --cores 1 --workflow-profile workflow/profiles/default

bundle: $(STAMP) ## Write all results of CONFIG with a manifest to FILE (results.tar)
	@$(BIN)/python -m nucleation.pipeline.bundle write "$(or $(FILE),results.tar)" "$(CONFIG)"

restore: $(STAMP) ## Start from the results in FILE, with nothing computed again
	@$(BIN)/python -m nucleation.pipeline.bundle restore "$(FILE)" "$(CONFIG)"

schema: $(STAMP) ## Make config/schema.yaml again, after a change of a parameter's declaration
	PYTHONPATH=src $(BIN)/python -m nucleation.configuration.load > config/schema.yaml

lock: ## Pin the newest versions of requirements.in in environment.txt (needs uv)
	uv pip compile --upgrade --generate-hashes --python-version 3.11 --no-emit-index-url \
		requirements.in -o environment.txt

clean-venv: ## Remove the installed environment
	rm -rf $(VENV)

# Everything installed is pinned and hashed. The package itself is not installed but pointed to:
# that needs no build tools, which environment.txt would not pin.
$(STAMP): environment.txt
	@$(PYTHON) -c 'import sys; v = sys.version_info[:2]; sys.exit(v != (3, 11) and \
		"Python 3.11 is needed, this is %d.%d: make PYTHON=/path/to/python3.11" % v)'
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes \
		-r environment.txt
	$(BIN)/python -c 'import pathlib, sysconfig; \
		pathlib.Path(sysconfig.get_path("purelib"), "nucleation.pth").write_text("$(CURDIR)/src\n")'
	printf '#!/bin/sh\nexec "%s/$(BIN)/python" -m nucleation "$$@"\n' "$(CURDIR)" > $(BIN)/nucleation
	chmod +x $(BIN)/nucleation
	@touch $@
