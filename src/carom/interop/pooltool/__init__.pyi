from .engine import engine as engine
from .engine import register as register
