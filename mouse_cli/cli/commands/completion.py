"""mouse completion: the script that completes commands and options in a shell."""

import click

_WORD = "COMPREPLY+=($value)"  # of the script for bash
_UNFINISHED = "            [[ $value == *= ]] && compopt -o nospace"  # a value follows
_ALL_COMMAS = ('string split ","', 'string split -m 1 ","')  # of that for fish: names have commas between


@click.command()
@click.argument("shell", type=click.Choice(["bash", "zsh", "fish"]))
def command(shell: str) -> int:
    """Print the completion script for SHELL.

    For bash: mouse completion bash > ~/.local/share/bash-completion/completions/mouse
    """
    from click.shell_completion import get_completion_class

    from mouse_cli.cli.main import COMPLETION, cli

    source = get_completion_class(shell)(cli, {}, "mouse", COMPLETION).source()
    click.echo(source.replace(_WORD, f"{_WORD}\n{_UNFINISHED}").replace(*_ALL_COMMAS))
    return 0
