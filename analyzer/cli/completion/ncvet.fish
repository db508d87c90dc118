# Completion of ncvet's command line for fish. Options come from the help of each command.
function __ncvet_dialects
    echo auto
    ncvet dialects 2>/dev/null | string match -r '^[a-z][a-z0-9-]*'
end

function __ncvet_rules
    ncvet rules 2>/dev/null | string match -r '^[a-z]+-[a-z0-9-]+'
end

# The rules that can follow what is already written of a list separated by commas.
function __ncvet_rule_list
    set -l written (commandline -ct | string replace -r '[^,]*$' '')
    for rule in (__ncvet_rules)
        echo $written$rule
    end
end

# What --help says of --format: names, separated by commas.
function __ncvet_formats
    ncvet $argv[1] --help 2>/dev/null | string join ' ' \
        | string replace -rf '.* --format FMT +((?:[a-z]+(?: \(default\))?, +)*[a-z]+).*' '$1' \
        | string replace '(default)' '' | string split , | string trim
end

function __ncvet_command
    set -l words (commandline -opc)
    test (count $words) -gt 1; and echo $words[2]
end

# The options of the command, for words that begin with a dash.
function __ncvet_options
    string match -q -- '-*' (commandline -ct); or return
    echo --help
    ncvet (__ncvet_command) --help 2>/dev/null \
        | string replace -rf '^  (?:-[a-z], )?(--[a-z-]+).*' '$1'
end

# Whether the word before is one of these options.
function __ncvet_after
    contains -- (commandline -opc)[-1] $argv
end

set -l commands check view trace explain rules dialects config init merge lsp dap help
set -l values --dialect --profile --format --report --fail-on --color --select --ignore --severity \
    --jobs -j --stdin-filename --exclude --shard --changed-since
set -l first "not __fish_seen_subcommand_from $commands"
complete -c ncvet -f
complete -c ncvet -n $first -a check -d 'Find what is wrong in files and folders'
complete -c ncvet -n $first -a view -d 'Programs, findings and tool paths as a page'
complete -c ncvet -n $first -a trace -d 'The motions that the control would make'
complete -c ncvet -n $first -a explain -d 'The page of a rule'
complete -c ncvet -n $first -a rules -d 'All rules'
complete -c ncvet -n $first -a dialects -d 'All controls'
complete -c ncvet -n $first -a config -d 'Which settings count, and who gave them'
complete -c ncvet -n $first -a init -d 'Write a .ncvet.json to begin with'
complete -c ncvet -n $first -a merge -d 'One report of those of the parts of a check'
complete -c ncvet -n $first -a lsp -d 'Serve an editor'
complete -c ncvet -n $first -a dap -d 'Debug a program in an editor'
complete -c ncvet -n $first -a help -d 'The options of a command'

set -l inside "__fish_seen_subcommand_from $commands"
complete -c ncvet -n $inside -a '(__ncvet_options)'
complete -c ncvet -n "__fish_seen_subcommand_from check view trace config init merge; and not __ncvet_after $values" -F
complete -c ncvet -n "__fish_seen_subcommand_from explain; and not __ncvet_after --dialect" -a '(__ncvet_rules)'
complete -c ncvet -n '__ncvet_after --dialect' -a '(__ncvet_dialects)'
complete -c ncvet -n '__ncvet_after --profile' -a 'recommended strict all'
complete -c ncvet -n '__ncvet_after --format' -a '(__ncvet_formats (__ncvet_command))'
complete -c ncvet -n '__ncvet_after --report' -a '(__ncvet_formats check):'
complete -c ncvet -n '__ncvet_after --fail-on' -a 'error warning style never'
complete -c ncvet -n '__ncvet_after --color' -a 'auto always never'
complete -c ncvet -n '__ncvet_after --select --ignore' -a '(__ncvet_rule_list)'
complete -c ncvet -n '__ncvet_after --severity' -a '(__ncvet_rules)='
