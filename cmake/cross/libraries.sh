#!/bin/sh
# Builds the libraries that ncvet links for a system that Debian has no packages of them for, once,
# into a folder outside the tree, and prints that folder: a CMAKE_PREFIX_PATH.
#
#   cmake/cross/libraries.sh NAME TOOLCHAIN-FILE
#
# NAME tells such folders apart (windows, wasm). The sources are those of Debian's source packages
# llvm-toolchain-14 (of which only the Support library is built) and re2; the libraries that are
# headers only are Debian's own. Messages go to standard error.
set -eu
name=$1 toolchain=$2
here=$(cd "$(dirname "$0")" && pwd)
cache=${XDG_CACHE_HOME:-$HOME/.cache}/ncvet/cross
prefix=$cache/$name
stamp=$(cat "$here/libraries.sh" "$here/llvm/CMakeLists.txt" "$toolchain" | sha256sum)
if [ "$(cat "$prefix/stamp" 2>/dev/null)" = "$stamp" ]; then
  echo "$prefix"
  exit
fi
say() { echo "cross: $*" >&2; }

# apt checks the signatures. A machine whose sources are not listed gets a list of its own for this.
fetch() {
  mkdir -p "$cache/sources"
  cd "$cache/sources"
  ls "$1"_*.orig.tar.* >/dev/null 2>&1 && return
  lists=$cache/lists
  mkdir -p "$lists/partial"
  echo "deb-src http://deb.debian.org/debian bookworm main" >"$cache/sources.list"
  options="-o Dir::Etc::SourceList=$cache/sources.list -o Dir::Etc::SourceParts=- -o Dir::State::Lists=$lists -o APT::Sandbox::User=root"
  # shellcheck disable=SC2086 # options are words
  apt-get $options -qq update >&2
  # shellcheck disable=SC2086
  apt-get $options -qq source --download-only "$1" >&2
}

say "sources"
fetch llvm-toolchain-14
fetch re2
work=$cache/work-$name
rm -rf "$work" "$prefix"
mkdir -p "$work/llvm" "$work/re2" "$prefix"
tar -xf "$cache/sources"/llvm-toolchain-14_*.orig.tar.xz -C "$work/llvm" --strip-components=1 --wildcards \
  '*/llvm/include/llvm*' '*/llvm/lib/Support/*' '*/llvm/lib/Demangle/*' '*/llvm/cmake/*' \
  'llvm-toolchain-14_14.0.6/cmake/*'
tar -xf "$cache/sources"/re2_*.orig.tar.xz -C "$work/re2" --strip-components=1

launcher=
if command -v ccache >/dev/null; then launcher="-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache"; fi
# shellcheck disable=SC2086 # options are words
build() {
  cmake -S "$1" -B "$2" -G Ninja -DCMAKE_BUILD_TYPE=Release "-DCMAKE_TOOLCHAIN_FILE=$toolchain" \
    "-DCMAKE_INSTALL_PREFIX=$prefix" -DCMAKE_INSTALL_LIBDIR=lib $launcher $3 >"$2.log" 2>&1 &&
    cmake --build "$2" --target install ${NCVET_JOBS:+-j "$NCVET_JOBS"} >>"$2.log" 2>&1 || {
    tail -n 40 "$2.log" >&2
    exit 1
  }
}
say "LLVM's Support library for $name"
build "$here/llvm" "$work/build-llvm" "-DLLVM_SOURCE=$work/llvm"
say "re2 for $name"
# Debian leaves its tables out of the source package and makes them from its own data.
(cd "$work/re2/re2" && sed -i 's|^_UNICODE_DIR = .*|_UNICODE_DIR = "/usr/share/unicode"|' unicode.py &&
  perl make_perl_groups.pl >perl_groups.cc && /usr/bin/python3 make_unicode_groups.py >unicode_groups.cc &&
  /usr/bin/python3 make_unicode_casefold.py >unicode_casefold.cc)
build "$work/re2" "$work/build-re2" "-DRE2_BUILD_TESTING=OFF -DBUILD_SHARED_LIBS=OFF -DCMAKE_CXX_STANDARD=17"

mkdir -p "$prefix/include" "$prefix/share/cmake"
cp -r /usr/include/eigen3 /usr/include/nlohmann /usr/include/CLI "$prefix/include/"
cp -r /usr/share/cmake/nlohmann_json /usr/share/cmake/CLI11 "$prefix/share/cmake/"
mkdir -p "$prefix/share/eigen3"
cp -r /usr/share/eigen3/cmake "$prefix/share/eigen3/"
rm -rf "$work"
echo "$stamp" >"$prefix/stamp"
echo "$prefix"
