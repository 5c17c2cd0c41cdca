# SPDX-FileCopyrightText: The Waylode authors
# SPDX-License-Identifier: Apache-2.0
# Verbs only: each calls a preset of CMakePresets.json or a script of tools/.
# The ccache settings let a second checkout use what the first compiled.
export CCACHE_BASEDIR ?= $(CURDIR)
export CCACHE_NOHASHDIR ?= 1
export CMAKE_BUILD_PARALLEL_LEVEL ?= $(shell nproc)
preset = cmake --preset $(1) && cmake --build --preset $(1)
.DEFAULT_GOAL := help
.PHONY: help setup-build setup-test build demo test slow asan lint fix golden bench fuzz docs clean

help: ## List the verbs
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/  make \1\t\2/p' $(MAKEFILE_LIST) | expand -t 20

setup-build: ## Install what building and the demo need
	@tools/setup_build.sh

setup-test: setup-build ## Install what the tests need besides
	@tools/setup_test.sh

build: setup-build ## Build build/release/bin/waylode
	@$(call preset,release)

demo: build ## Simulate a building, position three walkers in it, report: build/demo/report.html
	@tools/demo.sh

test: setup-test ## Build with assertions and run the fast tests
	@$(call preset,ci) && ctest --preset ci

slow: setup-test ## Run the slow tests: install, header checks, accuracy
	@$(call preset,ci) && ctest --preset slow

asan: setup-test ## Run the fast tests under the address and undefined-behaviour sanitizers
	@$(call preset,asan) && ctest --preset asan

lint: setup-test ## Check format, layers, documentation and changed code (ALL=1: all code)
	@$(call preset,ci) && tools/lint.sh $(if $(ALL),--all)

fix: setup-test ## Format every source file
	@tools/lint.sh --fix

golden: setup-test ## Rewrite the golden samples in contract/samples; review the difference
	@$(call preset,ci) && build/ci/bin/mcap_interop_helper golden contract/samples

bench: setup-test ## Build and run the speed benchmarks
	@$(call preset,bench) && tools/run_each.sh build/bench/bin 'bench_*'

fuzz: setup-test ## Fuzz every reader for FUZZ_SECONDS (60)
	@$(call preset,fuzz) && tools/fuzz.sh $(or $(FUZZ_SECONDS),60)

docs: ## Build the documentation site into build/docs
	@tools/install_packages.sh tools/apt-packages-docs.txt && mkdocs build --strict --quiet

clean: ## Remove build/
	rm -rf build
