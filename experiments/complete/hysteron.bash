# shellcheck shell=bash
# Completion of `hysteron` in bash: source this file, or install it where bash-completion looks for it.
_hysteron() {
  mapfile -t COMPREPLY < <("${COMP_WORDS[0]}" complete -- "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
  COMPREPLY=("${COMPREPLY[@]%%$'\t'*}")
}
complete -o bashdefault -o default -F _hysteron hysteron
