#!/bin/sh
# Runs a program that counts what it does: train.sh NCVET PROGRAMS, the folder of the benchmarks' programs.
#
# Half of it is a long check of each of them, the other half starts: each control is started often. The
# tests' programs have what the others have not: findings.
#
# Each run counts the same, on every machine: in one thread, in folders whose names are always as long
# and with one file in each, because the order in which a folder names its files is no one's.
set -eu
export LC_ALL=C # the order of names
tests=$(cd "$(dirname "$0")/../programs" && pwd)
folder=$(mktemp -d /tmp/ncvet-XXXXXXXX)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/programs" # further up no one looks for what belongs to a program
cp "$1" "$folder/ncvet"
programs=$(cd "$2" && pwd)
cd "$folder/programs"
# Counts are of addresses, too: these hang on the environment, and are others each time unless the system is asked.
fixed="env -i HOME=$folder LC_ALL=C NCVET_NO_CACHE=1"
if setarch -R true 2>/dev/null; then fixed="$fixed setarch -R"; fi
check() { $fixed ../ncvet check --jobs 1 --exit-zero --color never "$@" >/dev/null 2>&1; }

# alone NAME FILE: a copy of the file in a folder of its own.
alone() { mkdir "$1" && cp "$2" "$1/" && echo "$1/${2##*/}"; }

for table in programs.tsv rs274.tsv; do
  while read -r name _ dialect _; do
    program=$(alone "${name%.*}-${name##*.}" "$programs/$name")
    check --dialect "$dialect" --format json "$program"
    check "$program" # its control found out
  done <"$programs/$table"
done
short="tiny-nc/tiny.nc tiny-mpf/tiny.mpf"
for program in "$tests"/*/*.nc; do
  short="$short $(alone "$(basename "$(dirname "$program")")-$(basename "$program" .nc)" "$program")"
done
dialects=$($fixed ../ncvet dialects | cut -d ' ' -f 1)
for _ in 1 2 3 4 5 6 7 8; do
  for dialect in $dialects; do check --dialect "$dialect" tiny-nc/tiny.nc; done
  for program in $short; do check "$program"; done
done
# shellcheck disable=SC2086 # programs are words
for format in text json sarif html; do check --format "$format" $short; done
