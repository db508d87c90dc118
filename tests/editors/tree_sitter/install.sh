#!/bin/sh
# Builds the generator of tree-sitter's parsers out of Debian's source package, into the folder that it prints; once:
# afterwards it only prints it.
#   install.sh           build what is missing, and print the folder
#   install.sh --where   print the folder, there or not
set -eu
here=$(cd "$(dirname "$0")" && pwd)
sum=$(cat "$here/install.sh" "$here/generator/main.rs" "$here/generator/Cargo.toml" | cksum | cut -d ' ' -f 1)
folder=${XDG_CACHE_HOME:-$HOME/.cache}/ncvet-tests/tree-sitter-$sum
if [ "${1:-}" = --where ] || [ -x "$folder/generate" ]; then
  echo "$folder"
  exit
fi
fresh=$folder.$$
trap 'rm -rf "$fresh"' EXIT
mkdir -p "$fresh/lists/partial" "$fresh/source" "$fresh/build/.cargo"
cd "$fresh"
# apt checks the signatures. Machines list no sources, as a rule.
echo "deb-src http://deb.debian.org/debian bookworm main" >sources.list
apt_() {
  apt-get -qq -o "Dir::Etc::SourceList=$fresh/sources.list" -o Dir::Etc::SourceParts=- \
    -o "Dir::State::Lists=$fresh/lists" -o APT::Sandbox::User=root "$@" >&2
}
apt_ update
apt_ source --download-only tree-sitter
tar -xf tree-sitter_*.orig.tar.* -C source --strip-components=1
# Of the command line only the generator is built; the crates that it uses are Debian's.
cp -R "$here/generator" build/src
mv build/src/Cargo.toml build
cp -R source/cli/src/generate build/src
cat >build/.cargo/config.toml <<'EOF'
[source.crates-io]
replace-with = "debian"
[source.debian]
directory = "/usr/share/cargo/registry"
EOF
cd build
RUST_BINDING_VERSION=0 cargo build --release --offline --quiet >"$fresh/build.log" 2>&1 || {
  tail -n 20 "$fresh/build.log" >&2
  exit 1
}
mkdir -p "$folder"
mv target/release/generate "$folder"
echo "$folder"
