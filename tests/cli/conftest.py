"""The command in processes of its own, which are forked from one that has imported it."""

from __future__ import annotations

from subprocess import CompletedProcess
from typing import Protocol

import pytest
from reference.forking import Forked


class Command(Protocol):
    """The command with words and variables of the environment."""

    def __call__(self, *words: str, **environment: str) -> CompletedProcess[str]: ...


@pytest.fixture(scope="session")
def carom_command(tmp_path_factory: pytest.TempPathFactory, forked: Forked) -> Command:
    """The real command, whose output is no terminal."""
    folder = tmp_path_factory.mktemp("command")

    def command(*words: str, **environment: str) -> CompletedProcess[str]:
        return CompletedProcess(words, *forked(folder, *words, **environment))

    return command
