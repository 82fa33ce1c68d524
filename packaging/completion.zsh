#compdef bemprecomp bemsim bemshape bemmeasure bemrecode bemview bemrender
# Completion for zsh of the programs of bem. Options and subcommands are those that the program itself prints with --help.

local -a invocation subcommands found
invocation=(${~words[1]})
subcommands=(${(f)"$(_call_program subcommands $invocation --help 2>/dev/null |
  sed -nE '/^Subcommands:/,/^$/s/^ {2}([a-z][a-z-]*).*/\1/p')"})
if (( $#subcommands && CURRENT > 2 )) && [[ $words[2] != -* ]]; then
  invocation+=($words[2])
fi
if [[ $PREFIX == -* ]]; then
  found=(${(f)"$(_call_program options $invocation --help 2>/dev/null |
    sed -nE 's/^ {2,6}(-.*)/\1/; T; s/ {2}.*//; p' | tr ', ' '\n\n' | grep -xE -- '--[a-z][a-z0-9-]*')"})
  compadd -- $found
elif (( $#subcommands && CURRENT == 2 )); then
  compadd -- $subcommands
else
  _files
fi
