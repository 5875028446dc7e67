from .ranking import TrackRanking as TrackRanking
from .ranking import fit_tracks as fit_tracks
from .result import TrackFit as TrackFit
