"""mouse completion: the script that completes commands and options in a shell."""

import click


@click.command()
@click.argument("shell", type=click.Choice(["bash", "zsh", "fish"]))
def command(shell: str) -> int:
    """Print the script that completes commands and options in SHELL.

    For bash: mouse completion bash > ~/.local/share/bash-completion/completions/mouse
    """
    from click.shell_completion import get_completion_class

    from mouse_cli.cli.main import cli

    click.echo(get_completion_class(shell)(cli, {}, "mouse", "_MOUSE_COMPLETE").source())
    return 0
