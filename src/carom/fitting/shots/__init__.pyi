from .drawn import drawn_films as drawn_films
from .film import FilmedEvent as FilmedEvent
from .film import FilmedShot as FilmedShot
from .fit import fit_shots as fit_shots
from .result import EventMatch as EventMatch
from .result import FittedShot as FittedShot
from .result import ShotsFit as ShotsFit
from .result import ShotsRanking as ShotsRanking
