#!/bin/sh
# Prints the help text of a program in the form that help2man reads: synopsis first, short and long options apart, and after
# it the options of every subcommand. help2man calls it as `help_for_man.sh PROGRAM --help`.
set -eu
program=$1
name=$(basename "$program")

help_of() {
  COLUMNS=1000 "$program" "$@" --help | sed -E 's/^( +-[a-zA-Z]),--/\1, --/; s/ REQUIRED( |$)/\1/; s/ Excludes: --[a-z-]+//; s/^[A-Z][A-Za-z ]*:$/\n&/'
}

text=$(help_of)
printf '%s\n' "$text" | sed -nE "s/^  ($name .*)/\1/p; s/^[Uu]sage: //p" | sed '1s/^/Usage: /; 2,$s/^/  or:  /'
echo
printf '%s\n' "$text" | sed -E "/^  $name /d; /^[Uu]sage: /d"
printf '%s\n' "$text" | sed -nE '/^Subcommands:/,/^$/s/^ {2}([a-z][a-z-]*).*/\1/p' | while read -r subcommand; do
  printf '\nOptions of %s %s:\n' "$name" "$subcommand"
  help_of "$subcommand" | sed -nE '/^ {2}/p'
done
