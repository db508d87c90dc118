#!/bin/sh
# Runs a compiler by ccache, precompiled headers included.
#
# ccache declines what uses a precompiled header unless it may trust the header's own time and
# defines, and needs g++ to name the header in the preprocessed text. The header itself is compiled
# each time: it holds the paths of its tree, and one from another tree would bring the text of that.
# What was compiled with it depends on its text alone, so a sum of that text is noted beside it for
# ccache: trees with the same text share their objects.
top=$(cd "$(dirname "$0")/.." && pwd)
case " $* " in
*" c++-header "*)
  "$@" || exit
  # The same command without its output and its list of dependencies prints the text.
  count=$#
  while [ "$count" -gt 0 ]; do
    case $1 in
    -o) header=$2; shift 2; count=$((count - 2)); continue ;;
    -MF | -MT) shift 2; count=$((count - 2)); continue ;;
    -MD) ;;
    *) set -- "$@" "$1" ;;
    esac
    shift
    count=$((count - 1))
  done
  "$@" -E -P | sed "s|$top||g" | sha256sum >"$header.sum"
  exit
  ;;
esac
case $1 in
*clang*) ;;
*em++ | *em++.py) export CCACHE_COMPILERTYPE=clang ;; # a script that runs it
*) set -- "$@" -fpch-preprocess ;;
esac
# Paths below the top are hashed as relative ones: clones and work trees share what they compile.
CCACHE_BASEDIR=$top CCACHE_NOHASHDIR=1 CCACHE_PCH_EXTSUM=1 CCACHE_SLOPPINESS=pch_defines,time_macros exec ccache "$@"
