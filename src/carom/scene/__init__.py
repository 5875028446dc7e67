"""What a user declares: balls, floor, walls and their shapes, how long to run; read from Python or TOML, and validated."""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
