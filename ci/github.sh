#!/bin/sh
# The step of action.yml: its inputs, which are in the environment, as options of ncvet. Findings go
# to the log as annotations, and their summary to the page of the job.
set -eu

if ! command -v "$NCVET" >/dev/null 2>&1; then
  echo "::error title=ncvet::$NCVET is not in the PATH: install it in a step before this one, or name it in the input 'ncvet'"
  exit 2
fi
# Steps that run ncvet by themselves, in its own form: their findings become annotations, too.
if [ -n "${GITHUB_ACTION_PATH:-}" ]; then echo "::add-matcher::$GITHUB_ACTION_PATH/ci/problem-matcher.json"; fi

# Inputs with blanks are lists. A file name in them is not expanded.
set -f
# shellcheck disable=SC2086
set -- $INPUT_ARGUMENTS
if [ -n "$INPUT_FAIL_ON" ]; then set -- "$@" --fail-on "$INPUT_FAIL_ON"; fi
if [ -n "$INPUT_CHANGED_SINCE" ]; then set -- "$@" --changed-since "$INPUT_CHANGED_SINCE"; fi
if [ -n "$INPUT_BASELINE" ]; then set -- "$@" --baseline "$INPUT_BASELINE"; fi
if [ -n "$INPUT_SARIF" ]; then set -- "$@" --report "sarif:$INPUT_SARIF"; fi
if [ -n "${GITHUB_STEP_SUMMARY:-}" ]; then set -- "$@" --report "markdown:$GITHUB_STEP_SUMMARY"; fi
# shellcheck disable=SC2086
exec "$NCVET" check --format github "$@" -- $INPUT_PATHS
