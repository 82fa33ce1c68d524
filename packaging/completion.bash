# Completion for bash of the programs of bem. Options and subcommands are those that the program itself prints with --help.

_bem_help() {  # PROGRAM [SUBCOMMAND]
  "$@" --help 2>/dev/null
}

_bem_options() {  # reads a help text
  sed -nE 's/^ {2,6}(-.*)/\1/; T; s/ {2}.*//; p' | tr ', ' '\n\n' | grep -xE -- '--[a-z][a-z0-9-]*'
}

_bem_subcommands() {  # reads a help text
  sed -nE '/^Subcommands:/,/^$/s/^ {2}([a-z][a-z-]*).*/\1/p'
}

_bem() {
  local program=$1 word=$2 found
  local command=("$program") subcommands
  subcommands=$(_bem_help "$program" | _bem_subcommands)
  if [[ -n $subcommands && $COMP_CWORD -gt 1 && ${COMP_WORDS[1]} != -* ]]; then
    command+=("${COMP_WORDS[1]}")
  fi
  if [[ $word == -* ]]; then
    found=$(_bem_help "${command[@]}" | _bem_options)
  elif [[ -n $subcommands && $COMP_CWORD -eq 1 ]]; then
    found=$subcommands
  else
    compopt -o default 2>/dev/null
    COMPREPLY=()
    return
  fi
  mapfile -t COMPREPLY < <(compgen -W "$found" -- "$word")
}

complete -F _bem bemprecomp bemsim bemshape bemmeasure bemrecode bemview bemrender
