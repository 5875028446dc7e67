from . import engines as engines
from . import jax as jax
from . import pooltool as pooltool
from . import torch as torch
