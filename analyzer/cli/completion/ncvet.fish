# Completion of ncvet's command line for fish.
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

complete -c ncvet -f
set -l commands check trace explain rules dialects lsp
complete -c ncvet -n "not __fish_seen_subcommand_from $commands" -a check -d 'Lint files or folders'
complete -c ncvet -n "not __fish_seen_subcommand_from $commands" -a trace -d 'Print the motions of a program'
complete -c ncvet -n "not __fish_seen_subcommand_from $commands" -a explain -d 'Show the page of a rule'
complete -c ncvet -n "not __fish_seen_subcommand_from $commands" -a rules -d 'List the rules'
complete -c ncvet -n "not __fish_seen_subcommand_from $commands" -a dialects -d 'List the controls'
complete -c ncvet -n "not __fish_seen_subcommand_from $commands" -a lsp -d 'Run the language server'

complete -c ncvet -n '__fish_seen_subcommand_from explain' -a '(__ncvet_rules)'
complete -c ncvet -n '__fish_seen_subcommand_from rules' -l format -x -a 'text json' -d 'Format of the list'

set -l both '__fish_seen_subcommand_from check trace'
complete -c ncvet -n $both -F
complete -c ncvet -n $both -l dialect -x -a '(__ncvet_dialects)' -d Control
complete -c ncvet -n $both -l machine -r -d 'Machine profile'
complete -c ncvet -n $both -l config -r -d Configuration

set -l check '__fish_seen_subcommand_from check'
complete -c ncvet -n $check -l profile -x -a 'recommended strict all' -d 'Selection of rules'
complete -c ncvet -n $check -l select -x -a '(__ncvet_rule_list)' -d 'Only these rules'
complete -c ncvet -n $check -l ignore -x -a '(__ncvet_rule_list)' -d 'All but these rules'
complete -c ncvet -n $check -l severity -x -a '(__ncvet_rules)=' -d 'RULE=LEVEL'
complete -c ncvet -n $check -l format -x -a 'text json sarif gcc checkstyle html' -d 'Format of the report'
complete -c ncvet -n $check -l report -x -a 'text: json: sarif: gcc: checkstyle: html:' -d 'FMT:FILE, a further report'
complete -c ncvet -n $check -l fail-on -x -a 'error warning style never' -d 'Least severity that fails'
complete -c ncvet -n $check -l baseline -r -d 'Known findings'
complete -c ncvet -n $check -l write-baseline -r -d 'Write the current findings'
complete -c ncvet -n $check -l jobs -x -d 'Files at the same time'
complete -c ncvet -n $check -l stats -d 'Blocks, time, dialects'
complete -c ncvet -n $check -l fix -d 'Apply safe fixes'
complete -c ncvet -n $check -l diff -d 'Show safe fixes'
complete -c ncvet -n $check -l unsafe-fixes -d 'With --fix and --diff: also fixes that need a check'
complete -c ncvet -n $check -l color -x -a 'auto always never' -d 'Colours'
complete -c ncvet -n $check -l stdin-filename -x -d 'Name of standard input'
