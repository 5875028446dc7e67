from .constraints import Contact as Contact
from .constraints import contact_at as contact_at
from .impulsive import ImpulsiveMotion as ImpulsiveMotion
from .jump import EnergyGain as EnergyGain
from .jump import FrictionJam as FrictionJam
from .jump import ImpactWarning as ImpactWarning
from .jump import Jump as Jump
