# Thin: each target is a script, so that each can be read and run alone.
.PHONY: help demo test format lint

help:
	@echo "make demo    install what is needed, build, convert and render the Stanford Dragon"
	@echo "make test    build with every check enforced and run all tests"
	@echo "make format  format all C++ files in place"
	@echo "make lint    tell which C++ files are not formatted (make test does this and clang-tidy)"

demo:
	@scripts/demo.sh

test:
	@scripts/test.sh

format:
	@scripts/format.sh

lint:
	@scripts/format.sh --check
