# Completion of ncvet's command line for bash.
_ncvet() {
  local cur prev words cword split
  _init_completion -s || return
  local commands="check trace explain rules dialects lsp"
  local command= i
  for ((i = 1; i < cword; i++)); do
    case ${words[i]} in
    check | trace | explain | rules | dialects | lsp)
      command=${words[i]}
      break
      ;;
    esac
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
  --profile)
    mapfile -t COMPREPLY < <(compgen -W "recommended strict all" -- "$cur")
    return
    ;;
  --format)
    mapfile -t COMPREPLY < <(compgen -W "text json sarif gcc checkstyle html" -- "$cur")
    return
    ;;
  --fail-on)
    mapfile -t COMPREPLY < <(compgen -W "error warning style never" -- "$cur")
    return
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
    mapfile -t COMPREPLY < <(compgen -W "json: sarif: gcc: checkstyle: html: text:" -- "$cur")
    compopt -o nospace
    return
    ;;
  --jobs | --stdin-filename) return ;;
  esac
  $split && return
  case $command in
  "") mapfile -t COMPREPLY < <(compgen -W "$commands --help --version" -- "$cur") ;;
  explain) mapfile -t COMPREPLY < <(compgen -W "$(_ncvet_rules)" -- "$cur") ;;
  rules) mapfile -t COMPREPLY < <(compgen -W "--format" -- "$cur") ;;
  check | trace)
    if [[ $cur == -* ]]; then
      local options="--dialect --machine --config --help"
      [[ $command == check ]] && options+=" --profile --select --ignore --severity --format --report
        --fail-on --baseline --write-baseline --jobs --stats --fix --diff --unsafe-fixes --color --stdin-filename"
      mapfile -t COMPREPLY < <(compgen -W "$options" -- "$cur")
    else
      _filedir
    fi
    ;;
  esac
}
# The first word of every line that is an id.
_ncvet_dialects() { ncvet dialects 2>/dev/null | sed -n 's/^\([a-z][a-z0-9-]*\).*/\1/p'; }
_ncvet_rules() { ncvet rules 2>/dev/null | sed -n 's/^\([a-z]*-[a-z0-9-]*\).*/\1/p'; }
complete -F _ncvet ncvet
