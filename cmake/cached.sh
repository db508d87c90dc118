#!/bin/sh
# Runs a compiler by ccache, precompiled headers included.
#
# ccache declines what uses a precompiled header unless it may trust the header's own time and
# defines, and needs g++ to name the header in the preprocessed text. A header that is being
# precompiled must not have that option: preprocessing would take the old precompiled one for it,
# and the cache give back a stale header.
case $1 in
*clang*) ;;
*)
  case " $* " in
  *" c++-header "*) ;;
  *) set -- "$@" -fpch-preprocess ;;
  esac
  ;;
esac
# Paths below the top are hashed as relative ones: clones and work trees share what they compile.
top=$(cd "$(dirname "$0")/.." && pwd)
CCACHE_BASEDIR=$top CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros exec ccache "$@"
