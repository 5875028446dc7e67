"""Files to which laws are fitted: a published set by its name, a table of rebounds, or films of contacts or of whole tracks."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from carom.data.published import Published, published_at
from carom.data.rebounds import Kind, Rebounds
from carom.data.where import Where
from carom.errors import CaromError, collected, shortened_list
from carom.fitting.setting import Setting
from carom.tracks.contact import Settings, View
from carom.tracks.film_files import Progress, are_films, is_track, rebounds_of_files, tracks_of_films
from carom.tracks.formats.text_table import Calibration
from carom.tracks.measurement import Measured
from carom.tracks.rebounds import Stage

__all__ = ["DataFiles"]


@dataclass(frozen=True)
class DataFiles:
    """One or more files that belong together, and what they do not say themselves."""

    paths: tuple[Path, ...]
    """One table of rebounds or published set, or one or more films."""
    calibration: Calibration | None = None
    """Scale and frame rate of films."""
    view: View | None = None
    """Of films; None: by the motion."""
    kind: Kind | None = None
    """Of a table; None: by its columns."""
    stage: Stage | None = None
    """Of all rows of a table without that column, or of the contacts of films."""

    @property
    def name(self) -> str:
        """The files in a few words."""
        return shortened_list([str(path) for path in self.paths])

    @cached_property
    def published(self) -> Published | None:
        """The published set that is named; None where there are files. Raises CaromError for a set that cannot be fitted."""
        return published_at(self.paths[0])

    @cached_property
    def films(self) -> bool:
        """Whether contacts have to be measured first. Raises CaromError where tables are among several files."""
        return self.published is None and are_films(self.paths)

    def rebounds(self, setting: Setting, progress: Progress | None = None) -> Rebounds:
        """Return the rebounds; those of films are measured with the setting's ball. Raises CaromError with all problems."""
        if self.published is not None:
            return self.published.rebounds
        about = Settings(radius=setting.radius, kappa=setting.kappa, view=self.view)
        return rebounds_of_files(
            self.paths, self.calibration, about, kind=self.kind, stage=self.stage, progress=progress
        )

    def require_films(self) -> None:
        """Raise CaromError, with a line per file, where there are no whole tracks: a table, or a view from the side."""
        faults: list[str] = []
        for path in self.paths:
            with collected(faults):
                if path.is_file() and not is_track(path):
                    raise CaromError(f"{path}: expected a track with `whole`, got a table of rebounds; omit `whole`")
        if self.view == "side":
            faults.append("`view`: expected above with `whole` (balls on a table), got side")
        if faults:
            raise CaromError(*faults)

    def tracks(self, setting: Setting, where: Where = (), progress: Progress | None = None) -> Measured:
        """Return the tracks of films, all measured as one with the setting's ball and noise; ``where`` names shots or balls."""
        about = Settings(radius=setting.radius, kappa=setting.kappa, view="above", noise=setting.noise)
        return tracks_of_films(self.paths, self.calibration, about, where=where, progress=progress)
