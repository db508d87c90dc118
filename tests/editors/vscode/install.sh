#!/bin/sh
# Installs VS Code for the test into the folder that it prints; once: afterwards it only prints it.
#   install.sh           install what is missing, and print the folder
#   install.sh --where   print the folder, there or not
set -eu
here=$(cd "$(dirname "$0")" && pwd)
sum=$(cat "$here/package.json" "$here/package-lock.json" | cksum | cut -d ' ' -f 1)
folder=${XDG_CACHE_HOME:-$HOME/.cache}/ncvet-tests/vscode-$sum
if [ "${1:-}" = --where ] || [ -d "$folder/node_modules" ]; then
  echo "$folder"
  exit
fi
fresh=$folder.$$
trap 'rm -rf "$fresh"' EXIT
mkdir -p "$fresh"
cp "$here/package.json" "$here/package-lock.json" "$fresh"
# The packages' own scripts would fetch programs from elsewhere. Only what has to be compiled is, with the headers that
# Node's package brings.
npm_config_nodedir=$(node -p 'require("path").resolve(process.execPath, "../..")')
npm_config_yes=true
export npm_config_nodedir npm_config_yes
npm_() { npm "$@" --no-audit --no-fund >>"$fresh/npm.log" 2>&1 || { tail -n 20 "$fresh/npm.log" >&2; exit 1; }; }
cd "$fresh"
npm_ ci --ignore-scripts
npm_ rebuild argon2
PATH=$fresh/node_modules/.bin:$PATH
cd node_modules/code-server/lib/vscode
npm_ install --omit=dev --ignore-scripts
ln -sfn node_modules node_modules.asar
for native in @vscode/spdlog @parcel/watcher kerberos node-pty; do npm_ rebuild $native; done
mv "$fresh" "$folder" # fails when another one was quicker, which is as good
trap - EXIT
echo "$folder"
