"""``shapeblend completion``: scripts for shells."""

from __future__ import annotations

import click


@click.command()
@click.argument("shell", type=click.Choice(["bash", "zsh", "fish"]))
@click.pass_context
def completion(context: click.Context, shell: str) -> None:
    """Print a script that completes this command in a shell.

    \b
    bash, in ~/.bashrc:                     eval "$(shapeblend completion bash)"
    zsh, in ~/.zshrc:                       eval "$(shapeblend completion zsh)"
    fish, in ~/.config/fish/config.fish:    shapeblend completion fish | source
    """  # noqa: D301  # click knows \\b
    from click.shell_completion import get_completion_class

    script = get_completion_class(shell)
    assert script is not None
    click.echo(script(context.find_root().command, {}, "shapeblend", "_SHAPEBLEND_COMPLETE").source())
