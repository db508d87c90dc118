#!/bin/sh
# Runs a compiler by ccache, precompiled headers included.
#
# ccache declines what uses a precompiled header unless it may trust the header's own time and
# defines, and needs g++ to name the header in the preprocessed text. The header itself is compiled
# each time: it holds the paths of its tree, and one from another tree would bring the text of that.
case " $* " in
*" c++-header "*) exec "$@" ;;
esac
case $1 in
*clang*) ;;
*) set -- "$@" -fpch-preprocess ;;
esac
# Paths below the top are hashed as relative ones: clones and work trees share what they compile.
top=$(cd "$(dirname "$0")/.." && pwd)
CCACHE_BASEDIR=$top CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros exec ccache "$@"
