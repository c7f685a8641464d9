"""The command that prints a script with which a shell completes."""

from __future__ import annotations

import re
from typing import Literal

# studies or cases may stand behind these commands: as the first word, or as any
_FIRST, _ANY, _CASES = "check|run|advise|export", "reproduce", "verify"

# Each completes as the script above it does, and adds names to that.
_BASH = """
_contactstudy_names() {{
  local cur="${{COMP_WORDS[COMP_CWORD]}}" prev="${{COMP_WORDS[COMP_CWORD-1]}}" names=""
  {main} "$@"
  case "${{COMP_WORDS[1]}}" in
    {first}) (( COMP_CWORD == 2 )) && names="{studies}" ;;
    {any}) [[ "$prev" != -* ]] && names="{studies}" ;;
    {cases_of}) [[ "$prev" != -* ]] && names="{cases}" ;;
    new) [[ "$prev" == --like ]] && names="{studies}" ;;
  esac
  [[ "$cur" == -* ]] || COMPREPLY+=( $(compgen -W "$names" -- "$cur") )
}}
complete -F _contactstudy_names contactstudy
"""
_ZSH = """
_contactstudy_names() {{
  local -a names
  case $words[2] in
    {first}) (( CURRENT == 3 )) && names=({studies}) ;;
    {any}) [[ $words[CURRENT-1] != -* ]] && names=({studies}) ;;
    {cases_of}) [[ $words[CURRENT-1] != -* ]] && names=({cases}) ;;
    new) [[ $words[CURRENT-1] == --like ]] && names=({studies}) ;;
  esac
  local added=1
  compadd -a names && added=0
  {main} "$@" && added=0
  return added
}}
(( $+functions[compdef] )) || {{ autoload -Uz compinit && compinit }}
compdef _contactstudy_names contactstudy
"""
_FISH = """
function __fish_contactstudy_first
    set -l words (commandline -opc)
    test (count $words) -eq 2; and contains -- $words[2] (string split '|' '{first}')
end
complete -c contactstudy -n __fish_contactstudy_first -a '{studies}'
complete -c contactstudy -n '__fish_seen_subcommand_from {any}' -a '{studies}'
complete -c contactstudy -n '__fish_seen_subcommand_from {cases_of}' -a '{cases}'
complete -c contactstudy -n '__fish_seen_subcommand_from new' -l like -r -a '{studies}'
"""
_MORE = {"bash": _BASH, "zsh": _ZSH, "fish": _FISH}


def completion(shell: Literal["bash", "zsh", "fish"]) -> None:
    """Print a script with which a shell completes commands, options, studies and files.

    bash, zsh: eval "$(contactstudy completion bash)"; fish: contactstudy completion fish | source
    """
    from contactstudy.commands import app
    from contactstudy.study.loading import shipped_studies
    from contactstudy.verification.cases import CASES

    script = app.generate_completion(prog_name=app.name[0], shell=shell)
    main = re.search(r"^(_\w+)\(\) \{", script, re.MULTILINE)  # fish has none
    more = _MORE[shell].format(
        main=main and main[1],
        first=_FIRST,
        any=_ANY,
        cases_of=_CASES,
        studies=" ".join(shipped_studies()),
        cases=" ".join(case.name for case in CASES),
    )
    print(script + more)
