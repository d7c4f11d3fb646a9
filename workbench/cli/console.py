"""Consoles on which what comes from files steers no terminal: escape sequences are shown as letters."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Iterable
from typing import IO

from rich.console import Console, ConsoleOptions, RenderableType
from rich.segment import Segment

from workbench.files.streams import own_output, ready_streams

# Of what a terminal obeys, line breaks alone; the signs of Unicode that turn the direction of writing are left out too.
_TURNING = "\u061c\u200e\u200f\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069\u2028\u2029"
_STEERING = {code: "�" for code in (*range(0x20), *range(0x7F, 0xA0), *map(ord, _TURNING)) if code != ord("\n")}


class QuietConsole(Console):
    """As rich's, for texts that nobody has looked at: what is printed cannot colour, move or rename anything.

    Raises BrokenPipeError where nobody reads it any more, as other writing does.
    """

    @property
    def file(self) -> IO[str]:
        """Where it prints: standard error, or standard output as far as it is the command's own."""
        return sys.stderr if self.stderr else own_output()

    @file.setter
    def file(self, new_file: IO[str]) -> None:
        """Refused: what it says would go astray."""
        raise AttributeError("it prints to a standard stream: make another console")

    def on_broken_pipe(self) -> None:
        """Let the command end: rich would say that it has failed."""
        raise BrokenPipeError(errno.EPIPE, os.strerror(errno.EPIPE))

    def render(self, renderable: RenderableType, options: ConsoleOptions | None = None) -> Iterable[Segment]:
        """The pieces of what is printed, rich's own codes among them."""
        for segment in super().render(renderable, options):
            yield segment if segment.control else Segment(segment.text.translate(_STEERING), segment.style)


ready_streams()
# Names, paths and messages come from files: brackets and colons in them are what they are, no markup.
# Nor is anything looked for in them to be coloured, which takes a minute where a name has 200,000 letters.
# Lines are wrapped between words for a reader; what another program reads stays one line.
out_console = QuietConsole(markup=False, emoji=False, highlight=False, soft_wrap=not sys.stdout.isatty())
err_console = QuietConsole(stderr=True, markup=False, emoji=False, highlight=False, soft_wrap=not sys.stderr.isatty())
