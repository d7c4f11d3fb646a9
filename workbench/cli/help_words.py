"""Verbs whose help names what an option or argument takes in this project's words, not by the types of Python."""

from __future__ import annotations

from typing import Any

from typer.core import TyperCommand


class Verb(TyperCommand):
    """A verb of the command line."""

    def get_params(self, ctx: Any) -> list[Any]:
        """Its options and arguments, `--help` among them."""
        return in_own_words(super().get_params(ctx))


def in_own_words(params: list[Any]) -> list[Any]:
    """The options and arguments: a flag takes nothing, and an argument's name says what it is."""
    for param in params:
        if param.param_type_name == "argument":
            param.display_type = _nothing
        elif param.is_flag:
            param.metavar = ""
    return params


def _nothing(_: Any) -> str:
    return ""
