# bash completion of weft: the commands and options that --help lists, and files. zsh reads it after `bashcompinit`.
_weft() {
  local current=${COMP_WORDS[COMP_CWORD]} words=("${COMP_WORDS[0]}") found=
  [ "$COMP_CWORD" -gt 1 ] && words+=("${COMP_WORDS[1]}")
  if [ "$COMP_CWORD" = 1 ]; then
    found=$("${words[@]}" --help | sed -n '/^Subcommands:/,$s/^  \([a-z]\{1,\}\) .*/\1/p')
  elif [ "${current#-}" != "$current" ]; then
    found=$("${words[@]}" --help | grep -o -- '--[a-z][a-z-]*')
  fi
  COMPREPLY=($(compgen -W "$found" -- "$current"))
}
complete -o default -F _weft weft
