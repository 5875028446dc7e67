from .engine import engine as engine
from .engine import register as register
from .read import PooltoolShot as PooltoolShot
from .read import read as read
from .systems import to_system as to_system
