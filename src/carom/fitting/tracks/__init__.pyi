from .objective import TrackFit as TrackFit
from .ranking import TrackRanking as TrackRanking
from .ranking import fit_tracks as fit_tracks
