# make paper: every figure and table of the paper.   make test: the tests.   make help: the rest.
# What users may give. Empty: CONFIG is the default configuration, TARGETS all of it, PYTHON the newest
# Python that works here of those the project runs on.
CORES ?= 2
CONFIG ?=
TARGETS ?=
PYTHON ?=
PRUNE ?=
PARTS ?= solver
FAULTS ?= 200
SEED ?= 1
PYTHON_IS := $(origin PYTHON)

# Recipes read these from the environment, "$$CONFIG". Neither make nor a shell runs what they hold, nor
# what any other variable of the command line holds.
GIVEN := CORES CONFIG TARGETS PYTHON PRUNE PARTS FAULTS SEED
ASKED := $(foreach name,$(.VARIABLES),$(if $(filter command,$(origin $(name))),$(name)))
$(foreach name,$(GIVEN) $(ASKED),$(eval override $(name) := $$(value $(name))))
export $(GIVEN) $(ASKED)

VENV ?= .venv
ifneq ($(words $(VENV)),1)
$(error VENV = "$(VENV)" is not allowed: make knows no file names with blanks)
endif
ENVIRONMENT := '$(subst ','\'',$(VENV))'
BIN := $(ENVIRONMENT)/bin
# What `make paper` needs is installed, and what development needs too.
STAMP := $(VENV)/environment.stamp
DEV_STAMP := $(VENV)/environment-dev.stamp

PYTEST = $(BIN)/python -m pytest --dist loadfile --no-loadscope-reorder
# The launcher looks at a configuration before Snakemake, which runs what some of them hold.
LAUNCH = $(BIN)/python -m replication.pipeline.launch
CONFIGURED = $${CONFIG:+--configfile "$$CONFIG"}
OPTIONS = --cores "$$CORES" $(CONFIGURED)

.DEFAULT_GOAL := help
.PHONY: help install paper report quick test test-quick lint docs calculator bench reference lock asked-python check prune torture test-answers

help: ## This list
	@grep -hE '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 14
	@echo "Variables: PYTHON (the newest of 3.11 to 3.13) CORES=$$CORES TARGETS='figure_3 lengths' (all if empty) CONFIG=my.yaml"

install: $(STAMP) ## Install what `make paper` needs, in .venv

paper: $(STAMP) ## Make every figure, table and verdict, in results/
	$(LAUNCH) $$TARGETS $(OPTIONS)

report: $(STAMP) ## Make results/report.html: all figures with captions, and verdicts, in half an hour to an hour
	$(LAUNCH) figures $(OPTIONS)
	$(LAUNCH) figures --report results/report.html $(OPTIONS)

quick: $(STAMP) ## The same on coarse grids in a minute, in results/quick/
	$(LAUNCH) $$TARGETS --cores "$$CORES" --configfile config/quick.yaml

# Two workers more than there are cores: tests of a cluster and of faults mostly wait.
test: $(DEV_STAMP) ## Run the tests
	@$(PYTEST) -n "$$(expr "$$CORES" + 2)"

test-quick: $(DEV_STAMP) ## Run those that are neither slow nor start a whole system, in a minute
	@$(PYTEST) -n "$$CORES" -m "not slow and not system"

# OpenBLAS and numba use what an old processor has: other last bits. Chaotic slow slip amplifies them.
test-answers: $(DEV_STAMP) ## Run those whose answer irregular slow slip decides, as on another processor
	@OPENBLAS_CORETYPE=Nehalem NUMBA_CPU_NAME=generic OMP_NUM_THREADS=2 $(PYTEST) -n "$$CORES" -m answers

torture: $(DEV_STAMP) ## Kill, damage and fill disks FAULTS=200 times (SEED=1): nothing may be lost
	FAULT_COUNT="$$FAULTS" FAULT_SEED="$$SEED" $(BIN)/python -m pytest -v tests/faults -o tmp_path_retention_policy=failed

lint: $(DEV_STAMP) ## Check style, types, and which package imports which
	@$(BIN)/ruff check .
	@$(BIN)/ruff format --check --quiet .
	@$(BIN)/snakefmt --check Snakefile workflow
	@$(BIN)/mypy
	@$(BIN)/lint-imports

docs: $(DEV_STAMP) ## Build the documentation, its tutorials executed, in docs/_build/html/
	$(BIN)/sphinx-build -W --keep-going -q -b html docs docs/_build/html

calculator: $(DEV_STAMP) ## Make the committed tables of the calculator again, in ten minutes
	OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 $(BIN)/python docs/calculator/tables.py

bench: $(STAMP) ## Measure on one core: PARTS="solver workflow", the first by itself
	OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 $(BIN)/python -m benchmarks config/config.yaml $$PARTS

REFERENCE := patch_stability.csv patch_theory.csv patch_convergence.csv pairs.csv \
	pair_modes.csv drop.csv map.csv dispersion.csv convergence.csv \
	literature.csv weakening.csv other_faults.csv weakening_patches.csv \
	figures/*.png tables/claims.csv tables/claims.md \
	tables/claims_pairs.csv tables/claims_pairs.md

BLIND := blind.csv blind_coverage.csv figures/figure_blind.png

# The columns of lengths.nc that lengths.csv leaves out; tests of the verdicts need them.
REST := import sys, pandas, xarray; table = xarray.open_dataset("results/lengths.nc").to_dataframe(); \
	shown = set(pandas.read_csv("results/lengths.csv")) - {"id"}; \
	table.drop(columns=shown & set(table)).to_csv(sys.stdout, index=False)

reference: $(DEV_STAMP) ## Make the committed reference set again, from the results of the workflow
	$(BIN)/snakemake paper replication patch_convergence figure_patch_stability figure_3_extended \
		convergence figure_drop pairs figure_map figure_weakening gather_patch_theory \
		gather_weakening_patches patch_outcomes other_faults gather_literature --cores "$$CORES"
	$(BIN)/snakemake blind --configfile config/blind.yaml --cores "$$CORES"
	mkdir -p results/reference
	cd results && install -m 644 $(REFERENCE) reference/
	@# without blind_predicted.csv: it was kept before the faults were simulated
	cd results/blind && install -m 644 $(BLIND) ../reference/
	sed 's|](figures/|](|' results/replication.md > results/reference/article.md
	install -m 644 results/patch_outcomes.csv src/nucleation/lengths/
	@# digits beyond the twelfth are those of one machine
	sed -E 's/([0-9]\.[0-9]{11})[0-9]+/\1/g' results/lengths.csv > results/reference/lengths.csv
	$(BIN)/python -c '$(REST)' | sed -E 's/([0-9]\.[0-9]{11})[0-9]+/\1/g' > results/reference/measures.csv

check: $(STAMP) ## List results that are stale, incomplete, damaged or foreign
	$(LAUNCH) check $(OPTIONS)

prune: $(STAMP) ## List results that nothing refers to; PRUNE=yes removes them
	$(LAUNCH) prune $(OPTIONS)

# For all Pythons and machines at once, with one version of a package on all of them if there is one.
LOCK = uv pip compile --universal --python-version 3.11 --fork-strategy fewest --generate-hashes \
	--no-annotate --no-emit-index-url --custom-compile-command "make lock" pyproject.toml

lock: ## Pin the newest versions of what pyproject.toml names in environment*.txt (needs uv)
	$(LOCK) --upgrade --all-extras -o environment-dev.txt
	$(LOCK) --upgrade --extra workflow --constraint environment-dev.txt -o environment.txt
	echo uv | uv pip compile --upgrade --universal --python-version 3.11 --generate-hashes \
		--no-annotate --no-emit-index-url --no-header - -o workflow/uv.txt

INSTALL = $(BIN)/python -P workflow/install.py
# Bytecode of all that is imported: eight seconds of one core, five of two.
COMPILE = $(BIN)/python -c 'import sys; from workflow.install import compile_imports; compile_imports(*sys.argv[1:])'

# Everything installed is pinned and hashed. The package itself is not installed but pointed to, so
# that the code of the checkout is what runs. An environment that works keeps its Python.
VERSION = import sys; print("%d.%d" % sys.version_info[:2])
$(STAMP): environment.txt
	@$(BIN)/python -c '' 2>/dev/null || { \
		python=$${PYTHON:-$$(workflow/pythons.sh | head -n 1)}; \
		case "$$("$$python" -c '$(VERSION)' 2>/dev/null)" in \
		3.11|3.12|3.13) "$$python" -m venv --clear $(ENVIRONMENT) ;; \
		*) echo "Python 3.11, 3.12 or 3.13 is needed, with its module venv;" \
			"$${python:-none was found}$${python:+ is not}: make PYTHON=/path/to/python3.13" >&2; \
			exit 1 ;; \
		esac; }
	$(INSTALL) environment.txt
	$(BIN)/python -c 'import pathlib, sysconfig; \
		path = pathlib.Path(sysconfig.get_path("purelib"), "nucleation.pth"); \
		path.write_text(str(pathlib.Path("src").absolute()) + "\n")'
	printf '#!/bin/sh\nexec "%s/python" -P -m nucleation "$$@"\n' "$$(cd $(BIN) && pwd)" > $(BIN)/nucleation
	chmod +x $(BIN)/nucleation
	$(COMPILE) nucleation replication netCDF4.utils & other=$$!; \
		$(COMPILE) snakemake.cli snakemake.report.html_reporter smart_open.smart_open_lib \
			matplotlib.backends.backend_pdf pint.registry && wait $$other
	@touch $(ENVIRONMENT)/environment.stamp

$(DEV_STAMP): environment-dev.txt $(STAMP)
	$(INSTALL) environment-dev.txt
	@touch $(ENVIRONMENT)/environment-dev.stamp

# A Python that is asked for where the environment has another one: said, rather than not used.
ifeq ($(PYTHON_IS),command line)
$(STAMP): | asked-python
asked-python:
	@have=$$($(BIN)/python -c '$(VERSION)' 2>/dev/null); \
	asked=$$("$$PYTHON" -c '$(VERSION)' 2>/dev/null); \
	[ -z "$$have" ] || [ "$$have" = "$$asked" ] || { \
		echo $(ENVIRONMENT) "has Python $$have, and $$PYTHON is $${asked:-not a Python that works}:" \
			"remove it, or VENV=.venv-$${asked:-other}" >&2; exit 1; }
endif
