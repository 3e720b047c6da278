# The commands a person uses. Each does its own set-up (tools/setup.sh: Debian 12, root or sudo).
BUILD  ?= build/release
PREFIX ?= /usr/local
JOBS   ?= $(shell nproc)
# Rooms whose tests run under sanitizers: in `make asan` all that read, index or write, in `make tsan`
# all that run threads. Those that draw by OpenGL are left to the release build: its drivers are not
# compiled with a sanitizer.
ASAN_ROOMS ?= file math work astronomy radiometry media sh image tone scene scene_io transfer asset atlas trace \
              transport macro synthesis meso light sky sources capture shade view bi_scale reference
# Tests that simulate for seconds where they are optimised, and for minutes where they are not; and
# runs of a room's tests once more, by another choice of instructions.
ASAN_LEFT_OUT ?= sky.(Scattering|SkyTables|Aerial|Air|ExactAir|Haze|Shafts|ConstantAir)|SharpSun.CountsNothingTwice|shade.(baseline|avx2)
TSAN_ROOMS ?= file work sh image atlas trace transport macro synthesis meso shade bi_scale reference
# Tests of `make tsan`, as ctest's -R; all by default.
TSAN_TESTS ?= .

$(shell mkdir -p build)

.PHONY: all help setup setup-tests inputs configure build product everything test demo figures screenshots bench \
        docs install asan tsan clang format check-format check clean

all: product

help:
	@echo 'make                     build the library, the tool and the page into $(BUILD)'
	@echo 'make demo                bake a bunny, relight it, compare with the path-traced truth'
	@echo 'make test                build and run every test'
	@echo 'make bench               measure; CSV files under bench/results/'
	@echo 'make figures             the pictures of docs/reproduction.md (FIGURES="figure3 table1": only those)'
	@echo 'make screenshots         the viewers as they look, into docs/images'
	@echo 'make docs                the reference of library and npm package: build/docs/index.html'
	@echo 'make install PREFIX=DIR  DIR/bin/lambent, the library and its CMake package'
	@echo 'make asan | tsan         tests under sanitizers (TSAN_TESTS=Threads: only those)'
	@echo 'make clang               the library and the tool by clang, file by file, where a warning is an error'
	@echo 'make check               formatting, rooms, references'
	@echo 'make format              clang-format everything'

setup:
	@tools/setup.sh

setup-tests:
	@tools/setup.sh tests

inputs: setup
	@tools/fetch-inputs.sh

configure: setup
	@cmake --preset release -B $(BUILD) $(CMAKE_ARGS) > $(BUILD)-configure.log 2>&1 \
	  || { cat $(BUILD)-configure.log; exit 1; }

build: configure
	@cmake --build $(BUILD) --parallel $(JOBS) --target lambent_tool

# What is installed: the tool, and the page where npm is there to build it.
product: configure
	@cmake --build $(BUILD) --parallel $(JOBS) --target lambent_product

everything: configure
	@cmake --build $(BUILD) --parallel $(JOBS)

test: setup-tests everything inputs
	@ctest --test-dir $(BUILD) --parallel $(JOBS) --output-on-failure

demo: build inputs
	@tools/demo.sh $(BUILD)/apps/lambent/lambent

figures: build
	@tools/fetch-inputs.sh all
	@cmake --build $(BUILD) --parallel $(JOBS) --target lambent_figures
	@$(BUILD)/figures/lambent_figures build/inputs docs/images $(FIGURES)

screenshots: setup-tests everything inputs
	@tools/screenshots.sh $(BUILD)

bench: setup-tests everything
	@tools/fetch-inputs.sh all
	@bench/run.sh $(BUILD)

docs: setup-tests
	@tools/make-docs.sh build/docs

install: product
	@cmake --install $(BUILD) --prefix '$(PREFIX)' > $(BUILD)-install.log
	@echo 'installed: $(PREFIX)/bin/lambent'

asan: setup-tests
	@cmake --preset asan > build/asan-configure.log 2>&1 || { cat build/asan-configure.log; exit 1; }
	@cmake --build build/asan --parallel $(JOBS) --target lambent_fuzz_replay $(ASAN_ROOMS:%=lambent_%_tests)
	@LAMBENT_ISA=baseline ctest --test-dir build/asan --parallel $(JOBS) --output-on-failure -E '$(ASAN_LEFT_OUT)' \
	  -L '^($(call either,$(ASAN_ROOMS) fuzz))$$'

tsan: setup-tests
	@cmake --preset tsan > build/tsan-configure.log 2>&1 || { cat build/tsan-configure.log; exit 1; }
	@cmake --build build/tsan --parallel $(JOBS) --target $(TSAN_ROOMS:%=lambent_%_tests)
	@LAMBENT_ISA=baseline TSAN_OPTIONS='suppressions=$(CURDIR)/tools/tsan.supp:ignore_noninstrumented_modules=1' \
	  ctest --test-dir build/tsan --parallel $(JOBS) --output-on-failure -R '$(TSAN_TESTS)' \
	  -L '^($(call either,$(TSAN_ROOMS)))$$'

either = $(subst $() ,|,$(strip $(1)))

clang: setup-tests
	@cmake --preset clang > build/clang-configure.log 2>&1 || { cat build/clang-configure.log; exit 1; }
	@cmake --build build/clang --parallel $(JOBS) --target lambent_tool

SOURCES = $(shell git ls-files -co --exclude-standard '*.h' '*.cpp')

format: setup
	@clang-format -i $(SOURCES)

check-format: setup
	@clang-format --dry-run -Werror $(SOURCES)

check: check-format
	@python3 tools/check_rooms.py
	@python3 tools/check_references.py

clean:
	@rm -rf build
