"""The floor of a scene: its surface, and how it slows down what rolls and spins on it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, ClassVar

from carom.core.jit.kernel import kernel
from carom.scene.restitution import Bounce, Constant
from carom.scene.ruled import FaultText, Ruled, put_fault
from carom.scene.schema import Drag, Friction, NotNegative, Slope, SpinDamping, SpinDrag, Spring
from carom.scene.wall import ContactParameters, contact


def gravity_on_slope(g: float, slope: Sequence[float]) -> tuple[float, float, float]:
    """Return gravity of size g along the axes of a floor that falls by ``slope`` per metre of its own along x and y."""
    x, y = slope
    return (g * x, g * y, -g * math.sqrt(1 - x * x - y * y))


@kernel
def _floor_rules(p: Any, out: Any) -> int:
    """Report laws that exclude each other; p: rolling_drag, spin_damping, spin_drag, and the slope along x and y."""
    i = put_fault(0, 0.0, 0.0, 0.0, 0, out) if p[1] > 0 and p[2] > 0 else 0
    if p[3] == 0 and p[4] == 0:
        return i
    if not p[3] * p[3] + p[4] * p[4] < 1:
        i = put_fault(1, 0.0, 0.0, 0.0, i, out)
    if p[0] > 0:
        i = put_fault(2, 0.0, 0.0, 0.0, i, out)
    return put_fault(3, 0.0, 0.0, 0.0, i, out) if p[2] > 0 else i


_ON_SLOPE = "the path of a ball on a tilted floor has a closed form only where the resistance is constant"


class Floor(Ruled):
    """The plane z = 0, under the balls.

    Parameters
    ----------
    restitution : number from 0 to 1, or a form of the normal speed; default: 0
    friction : >= 0, or inf: of impacts and of sliding
    tangential_restitution : -1 to 1; default: 0
    rolling_resistance : deceleration / g while rolling; default: 0
    spin_friction : |d omega_z / dt| = spin_friction g / (kappa a); default: 0
    rolling_drag : s/m: the rolling resistance grows with the speed v to rolling_resistance + rolling_drag v; default: 0
    spin_damping : 1/s: |d omega_z / dt| is greater by spin_damping |omega_z|; default: 0
    spin_drag : rad/m: it is greater by spin_drag v while the ball rolls; default: 0. Not with ``spin_damping``
    slope : (x, y): how far the floor falls per metre of its own along x and y, so that gravity has the part g slope along it:
        the sine of the angle, with its direction; default: (0, 0). Not with ``rolling_drag`` or ``spin_drag``

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> carom.Floor(restitution=0.5, friction=0.2, rolling_resistance=0.01).rolling_resistance
    0.01
    """

    rules: ClassVar = _floor_rules
    ruled: ClassVar = ("rolling_drag", "spin_damping", "spin_drag", "slope")
    fault_texts: ClassVar = (
        FaultText(
            "spin_drag", "0 with spin_damping > 0", "{spin_drag}",
            "take one law of the loss of spin: damping grows with the spin, drag with the speed of rolling",
        ),
        FaultText(
            "slope", "a floor that is less steep than upright", "{slope}",
            "the slope is the sine of the angle: 0.001 falls 1 mm per metre",
        ),
        FaultText("rolling_drag", "0 on a floor with a slope", "{rolling_drag}", _ON_SLOPE),
        FaultText("spin_drag", "0 on a floor with a slope", "{spin_drag}", _ON_SLOPE),
    )  # fmt: skip

    restitution: Bounce = Constant(value=0.0)
    friction: Friction
    tangential_restitution: Spring = 0.0
    rolling_resistance: NotNegative = 0.0
    spin_friction: NotNegative = 0.0
    rolling_drag: Drag = 0.0
    spin_damping: SpinDamping = 0.0
    spin_drag: SpinDrag = 0.0
    slope: Slope = (0.0, 0.0)

    @property
    def contact(self) -> ContactParameters:
        """Return the parameters of its surface as numbers."""
        return contact(self.restitution, self.friction, self.tangential_restitution)
