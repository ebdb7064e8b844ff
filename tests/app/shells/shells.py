"""Asks bash, zsh and fish, each really run, what they offer for the last word of a command line."""
import os
import pathlib
import pty
import re
import select
import signal
import subprocess
import time

ASK_BASH = r"""
source "$1"; shift
COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1))
_weft
printf '%s\n' "${COMPREPLY[@]}"
"""

# Everything goes through compadd in the end: what fits is written down on its way. With -O, -A or -D nothing is offered.
ZSHRC = r"""
fpath=($folder $fpath)
autoload -U compinit; compinit -u -D
compadd() {
  if [[ " ${(j: :)@[1,(i)--]}" == *' -'[OAD]' '* ]]; then builtin compadd "$@"; return; fi
  local -a fitting; builtin compadd -A fitting "$@"; print -rl -- $fitting >> $folder/heard
  builtin compadd "$@"
}
end_answer() { print ' end' >> $folder/heard }
ask() { comppostfuncs=(end_answer); zle complete-word; BUFFER= }
zle -N ask; bindkey '^I' ask
print ' end' >> $folder/heard
"""


def ask_bash(script, lines, cwd, folder):
    answers = []
    for line in lines:
        words = re.split(r" |(?<=\S)(=)", line)  # `=` is a word of its own to bash
        done = subprocess.run(["bash", "-u", "-c", ASK_BASH, "bash", script, *filter(lambda w: w is not None, words)], cwd=cwd, capture_output=True, text=True)
        assert done.returncode == 0 and not done.stderr, f"{line}: {done.stderr}"
        answers.append(done.stdout.splitlines())
    return answers


def ask_fish(script, lines, cwd, folder):
    words = 'source $argv[1]; for line in $argv[2..-1]; complete -C "$line"; echo " end"; end'
    done = subprocess.run(["fish", "--no-config", "-c", words, script, *lines], cwd=cwd, capture_output=True, text=True, env={**os.environ, "HOME": str(folder)})
    assert done.returncode == 0 and not done.stderr, done.stderr
    return [[line.split("\t")[0] for line in answer.splitlines()] for answer in done.stdout.split(" end\n")[:-1]]


def ask_zsh(script, lines, cwd, folder):
    """In a terminal, as zsh completes nowhere else: each line, then Tab, then what came of it. Names of files come quoted."""
    here = pathlib.Path(folder, "zsh")
    here.mkdir(exist_ok=True)
    heard = here / "heard"
    heard.write_text("")
    here.joinpath("_weft").write_text(pathlib.Path(script).read_text())
    here.joinpath(".zshrc").write_text(f"folder='{here}'\n{ZSHRC}")
    shell, terminal = pty.fork()
    if shell == 0:
        os.chdir(cwd)
        os.execvpe("zsh", ["zsh", "-d", "-i"], {"PATH": os.environ["PATH"], "HOME": str(here), "ZDOTDIR": str(here), "TERM": "dumb", "LINES": "999", "COLUMNS": "200"})
    shown = b""

    def wait(answers):
        nonlocal shown
        until = time.monotonic() + 60
        while heard.read_text().count(" end\n") < answers:
            if select.select([terminal], [], [], 0.02)[0]:
                shown += os.read(terminal, 65536)
            assert time.monotonic() < until, f"zsh does not answer; its terminal shows {shown[-2000:].decode(errors='replace')}"
    try:
        wait(1)
        for number, line in enumerate(lines):
            os.write(terminal, line.encode() + b"\t")
            wait(number + 2)
    finally:
        os.kill(shell, signal.SIGKILL)
        os.waitpid(shell, 0)
        os.close(terminal)
    return [re.sub(r"\\(.)", r"\1", answer).splitlines() for answer in heard.read_text().split(" end\n")[1:-1]]


ASK = {"bash": ask_bash, "zsh": ask_zsh, "fish": ask_fish}


def ask(shell, script, lines, cwd, folder):
    """Per line what is offered, each word once: of a path its last part, without a slash behind it."""
    answers = ASK[shell](script, lines, cwd, folder)
    assert len(answers) == len(lines), f"{shell}: {len(answers)} answers to {len(lines)} lines"
    return [sorted({word.rstrip("/").rsplit("/", 1)[-1] for word in answer if word}) for answer in answers]
