from . import pooltool as pooltool
