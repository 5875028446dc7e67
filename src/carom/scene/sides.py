"""The four cushions of a table, where their surfaces differ."""

from __future__ import annotations

from carom.scene.restitution import Bounce
from carom.scene.schema import Friction, Model

__all__ = ["Side", "Sides"]


class Side(Model):
    """A cushion of a table with a surface of its own.

    Parameters
    ----------
    restitution : number from 0 to 1, or a form of the normal speed; default: the table's
    friction : number >= 0, or inf; default: the table's

    Raises CaromError, one line per problem.
    """

    restitution: Bounce | None = None
    friction: Friction | None = None


class Sides(Model):
    """The cushions of a table by name, in the order of their numbers: counterclockwise from the bottom one.

    Parameters
    ----------
    bottom, right, top, left : Side
        Where y is least, x is greatest, y is greatest, x is least. The jaws at its ends belong to a cushion. Default: the
        surface of the table.

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> table = carom.scene.Table(preset="carom", friction=0.2, sides={"right": {"restitution": 0.83}})
    >>> table.sides.right.restitution.value, table.sides.left.restitution
    (0.83, None)
    """

    bottom: Side = Side()
    right: Side = Side()
    top: Side = Side()
    left: Side = Side()
