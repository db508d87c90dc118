# Completion of ncvet's command line for bash. Options come from the help of each command.
_ncvet() {
  local cur prev words cword split
  _init_completion -s || return
  local commands="check view trace explain rules dialects config init merge lsp dap help"
  local command= i
  for ((i = 1; i < cword; i++)); do
    if [[ " $commands " == *" ${words[i]} "* ]]; then
      command=${words[i]}
      break
    fi
  done
  case $prev in
  --dialect)
    mapfile -t COMPREPLY < <(compgen -W "auto $(_ncvet_dialects)" -- "$cur")
    return
    ;;
  --machine | --config | --baseline | --write-baseline)
    _filedir json
    return
    ;;
  --output | -o | --changed-lines | --check)
    _filedir
    return
    ;;
  --relative-to | --cache-dir)
    _filedir -d
    return
    ;;
  --profile)
    mapfile -t COMPREPLY < <(compgen -W "recommended strict all" -- "$cur")
    return
    ;;
  --format)
    local formats
    formats=$(_ncvet_formats "$command")
    mapfile -t COMPREPLY < <(compgen -W "$formats" -- "$cur")
    return
    ;;
  --fail-on)
    mapfile -t COMPREPLY < <(compgen -W "error warning style never" -- "$cur")
    return
    ;;
  --color)
    mapfile -t COMPREPLY < <(compgen -W "auto always never" -- "$cur")
    return
    ;;
  --fix)
    $split && mapfile -t COMPREPLY < <(compgen -W "safe all" -- "$cur")
    ;;
  --select | --ignore)
    # The last of a list that is separated by commas.
    local done=
    [[ $cur == *,* ]] && done=${cur%,*},
    mapfile -t COMPREPLY < <(compgen -P "$done" -W "$(_ncvet_rules)" -- "${cur##*,}")
    return
    ;;
  --severity)
    mapfile -t COMPREPLY < <(compgen -S = -W "$(_ncvet_rules)" -- "$cur")
    compopt -o nospace
    return
    ;;
  --report)
    mapfile -t COMPREPLY < <(compgen -S : -W "$(_ncvet_formats check)" -- "$cur")
    compopt -o nospace
    return
    ;;
  --jobs | -j | --stdin-filename | --exclude | --shard | --changed-since) return ;;
  esac
  $split && return
  if [[ -z $command ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$commands --help --version" -- "$cur")
  elif [[ $cur == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "--help $(_ncvet_options "$command")" -- "$cur")
  elif [[ $command == explain ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(_ncvet_rules)" -- "$cur")
  elif [[ $command == help ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$cur")
  elif [[ $command == init ]]; then
    _filedir -d
  elif [[ $command == check || $command == view || $command == trace || $command == config || $command == merge ]]; then
    _filedir
  fi
}
_ncvet_options() {
  ncvet "$1" --help 2>/dev/null | sed -n -E 's/^  (-[a-z], )?(--[a-z-]+).*/\2/p'
}
# What --help says of --format: names, separated by commas.
_ncvet_formats() {
  ncvet "$1" --help 2>/dev/null | tr '\n' ' ' |
    sed -n -E 's/.* --format FMT +(([a-z]+( \(default\))?, +)*[a-z]+).*/\1/p' | sed 's/(default)//; s/,//g'
}
# The first word of every line that is an id.
_ncvet_dialects() { ncvet dialects 2>/dev/null | sed -n 's/^\([a-z][a-z0-9-]*\).*/\1/p'; }
_ncvet_rules() { ncvet rules 2>/dev/null | sed -n 's/^\([a-z]*-[a-z0-9-]*\).*/\1/p'; }
complete -F _ncvet ncvet
