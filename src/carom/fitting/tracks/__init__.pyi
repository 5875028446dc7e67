from .fit import TrackRanking as TrackRanking
from .fit import fit_tracks as fit_tracks
from .model import TrackFit as TrackFit
