"""The names of the environments, for Gymnasium's registry."""

from __future__ import annotations

from carom.files import import_optional

GAMES = ("ThreeCushion", "EightBall", "SumToThree", "AirHockey", "TableTennisReturn")


def register() -> None:
    """Register all environments with Gymnasium: ``carom/ThreeCushion-v0`` and so on, each with its vector environment.

    Raises MissingLibraryError without Gymnasium.
    """
    gymnasium = import_optional("gymnasium", "environments for learning")
    made = {"entry_point": "carom.env.gym:CaromEnv", "vector_entry_point": "carom.env.gym:CaromVectorEnv"}
    for game in GAMES:
        if (name := f"carom/{game}-v0") not in gymnasium.registry:
            gymnasium.register(name, **made, kwargs={"game": game})
