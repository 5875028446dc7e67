"""Impulsive motion from a Lagrangian and its constraints.

Constraints are imposed at an instant, and the configuration does not change during it. The generalised momenta along the virtual
displacements that the constraints allow do not jump (the method of the paper's sections 2 and 3.3, after Neimark and Fufaev,
*Dynamics of Nonholonomic Systems*, 1972). The same jump follows from the balance of impulse and momentum with one Lagrange
multiplier for each constraint. Both methods are implemented; they share only the mass matrix and the constraint rows, and the
tests compare them.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import sympy as sp

from carom.derive import percussion as contact_mass
from carom.derive.percussion import (
    EnergyGain,
    Instant,
    Jump,
    Percussion,
    compile_jump,
    impulses_of,
    integrate,
    prescribe_poisson_impulses,
    relations_before,
    solve_by_displacements,
    solve_by_multipliers,
    split_rows,
    targets,
    value_of,
)
from carom.derive.system import (
    ConstraintRow,
    Contact,
    Expr,
    Matrix,
    Speeds,
    constraint_row,
    displacement_basis,
    displacement_limit,
    is_zero,
    make_speeds,
    mass_matrix,
    named_constraints,
    tidy,
)
from carom.errors import CaromError


class ImpulsiveMotion:
    """The jump of a mechanical system at an instant; its arguments follow ``sympy.physics.mechanics.LagrangesMethod``.

    Parameters
    ----------
    lagrangian : Expr
        Lagrangian or kinetic energy, quadratic in the speeds. Forces of finite size have no effect in an instant.
    coordinates : sequence of Expr
        Generalised coordinates, ``dynamicsymbols``.
    speeds : sequence of Expr, optional
        Quasi-velocities, if the energy is written in terms of them. Default: the time derivatives of the coordinates.
    hol_coneqs, nonhol_coneqs : mapping or sequence, optional
        Permanent constraints: expressions of the coordinates that vanish; expressions linear in the speeds that vanish.
    before : mapping or sequence, optional
        Constraints that held until the instant and exert no impulse (a floor that the body leaves).
    imposed : mapping or sequence, optional
        Constraints that begin at the instant and hold afterwards: name to expression, or a sequence of expressions.
    instant : mapping or sequence, optional
        Constraints that act only during the instant: virtual displacements respect them, the speeds afterwards need not.
        They leave the equations open; close them with :meth:`close`, or give ``restitution``.
    restitution : mapping, optional
        Name of an ``instant`` constraint to Newton's coefficient of restitution for it.
    contacts : sequence of Contact, optional
        Contact points with restitution and friction.
    impulse : mapping, optional
        Known external impulses: speed to generalised impulse.
    at : mapping, optional
        Configuration at the instant, coordinate to value. Default: any configuration.
    forcelist, bodies, frame : optional
        Accepted and ignored, so that the arguments of a ``LagrangesMethod`` can be passed on unchanged.

    Raises
    ------
    CaromError
        A constraint that is not linear in the speeds, an unknown symbol, a singular mass matrix, constraints that contradict each
        other; the message names the constraint.

    Examples
    --------
    A rod of length 2 l that falls freely, upright to the wall, and is caught at its left end:

    >>> import sympy as sp
    >>> from sympy.physics.mechanics import dynamicsymbols
    >>> from carom.derive import ImpulsiveMotion
    >>> m, l = sp.symbols("m l", positive=True)
    >>> y, theta = dynamicsymbols("y theta")
    >>> energy = m * y.diff() ** 2 / 2 + m * l**2 / 3 * theta.diff() ** 2 / 2
    >>> motion = ImpulsiveMotion(energy, [y, theta], imposed={"hook": y.diff() - l * theta.diff()})
    >>> motion.solve().after[theta.diff()]
    (l*thetadot0 + 3*ydot0)/(4*l)
    >>> motion.virtual_displacements()
    Matrix([
    [  1],
    [1/l]])
    """

    def __init__(
        self,
        lagrangian: Expr,
        coordinates: Sequence[Expr],
        *,
        speeds: Sequence[Expr] | None = None,
        hol_coneqs: Mapping[str, Expr] | Iterable[Expr] | None = None,
        nonhol_coneqs: Mapping[str, Expr] | Iterable[Expr] | None = None,
        before: Mapping[str, Expr] | Iterable[Expr] | None = None,
        imposed: Mapping[str, Expr] | Iterable[Expr] | None = None,
        instant: Mapping[str, Expr] | Iterable[Expr] | None = None,
        restitution: Mapping[str, Expr] | None = None,
        contacts: Sequence[Contact] = (),
        impulse: Mapping[Expr, Expr] | None = None,
        at: Mapping[Expr, Expr] | None = None,
        forcelist: Any = None,
        bodies: Any = None,
        frame: Any = None,
    ) -> None:
        """Validate the arguments and convert them to matrices."""
        del forcelist, bodies, frame
        self.coordinates = tuple(coordinates)
        self.speeds: Speeds = make_speeds(self.coordinates, speeds)
        self.at = {k: sp.sympify(v) for k, v in (at or {}).items()}
        for q in self.at:
            if q not in self.coordinates:
                raise CaromError(f"at: {q} is not a coordinate; expected some of {list(self.coordinates)}")
        self.lagrangian = sp.sympify(lagrangian)
        self.mass = mass_matrix(self.lagrangian, self.coordinates, self.speeds, self.at)
        bounce = {str(k): sp.sympify(v) for k, v in (restitution or {}).items()}

        def rows(
            given: Mapping[str, Expr] | Iterable[Expr] | None, prefix: str, open_ended: bool = False
        ) -> list[ConstraintRow]:
            return [
                constraint_row(
                    n, c, self.coordinates, self.speeds, self.at, bounce.pop(n, None) if open_ended else sp.S.Zero
                )
                for n, c in named_constraints(given, prefix).items()
            ]

        self.permanent = rows(hol_coneqs, "holonomic") + rows(nonhol_coneqs, "nonholonomic")
        self.past = rows(before, "before")
        self.imposed = rows(imposed, "imposed") + rows(instant, "instant", open_ended=True)
        if bounce:
            raise CaromError(f"restitution: no instant constraint is named {', '.join(bounce)}")
        self.contacts = tuple(contacts)
        self.contact_rows = {c.name: self._rows_of(c) for c in self.contacts}
        names = [r.name for r in [*self.permanent, *self.imposed]] + [c.name for c in self.contacts]
        twice = sorted({n for n in names if names.count(n) > 1})
        if twice:
            raise CaromError(f"constraints: the name {', '.join(twice)} is given twice")
        self.impulse = sp.zeros(self.speeds.count, 1)
        for u, value in (impulse or {}).items():
            if u not in self.speeds.names:
                raise CaromError(f"impulse: {u} is not a speed; expected some of {list(self.speeds.names)}")
            self.impulse[self.speeds.names.index(u)] = sp.sympify(value)
        self.pre_relations = relations_before([*self.permanent, *self.past], self.speeds.before)

    # -- input ------------------------------------------------------------------------------------------------

    def _rows_of(self, contact: Contact) -> list[ConstraintRow]:
        """Return the constraint rows of a contact: normal, then tangents."""
        pairs = [("n", contact.normal, contact.restitution)]
        pairs += [(f"t{i + 1}", t, contact.tangential_restitution) for i, t in enumerate(contact.tangents)]
        return [
            constraint_row(f"{contact.name}.{k}", c, self.coordinates, self.speeds, self.at, e) for k, c, e in pairs
        ]

    @property
    def u0(self) -> Matrix:
        """Speeds just before, with the constraints that held until then substituted."""
        return sp.Matrix([self.pre_relations.get(u, u) for u in self.speeds.before])

    @property
    def u1(self) -> Matrix:
        """Symbols of the speeds just after."""
        return sp.Matrix(self.speeds.after)

    def velocity(self, expr: Expr, jump: Jump | None = None) -> Expr:
        """Return a velocity (an expression of the speeds) just before the instant or, given its ``jump``, just after it."""
        row = self.speeds.plain(sp.sympify(expr)).xreplace(self.at)
        values = list(self.u0) if jump is None else [jump.after[u] for u in self.speeds.names]
        return tidy(row.xreplace(dict(zip(self.speeds.dummies, values, strict=True))))

    # -- rows that act during the instant -----------------------------------------------------------------------------

    def _modes(self, modes: Mapping[str, str] | str | None) -> dict[str, str]:
        """Return the mode of each contact; default: "smooth" where it has no friction, else "stick"."""
        wanted = {c.name: modes for c in self.contacts} if isinstance(modes, str) else dict(modes or {})
        for name, mode in wanted.items():
            if name not in self.contact_rows:
                raise CaromError(f"modes: no contact is named {name}; expected one of {list(self.contact_rows)}")
            if mode not in ("stick", "slide", "smooth", "open"):
                raise CaromError(f"modes: contact {name}: expected one of stick, slide, smooth, open, got {mode}")
        return {c.name: wanted.get(c.name, "smooth" if c.friction == 0 else "stick") for c in self.contacts}

    def acting(self, modes: Mapping[str, str] | str | None) -> tuple[list[ConstraintRow], Matrix]:
        """Return the constraint rows that act during the instant, and the directions of their impulses as columns."""
        rows = [*self.permanent, *self.imposed]
        columns = [r.coefficients.T for r in rows]
        for contact in self.contacts:
            mode = self._modes(modes)[contact.name]
            normal, *tangents = self.contact_rows[contact.name]
            if mode == "open":
                continue
            rows.append(normal)
            columns.append(normal.coefficients.T)
            if mode == "stick":
                rows += tangents
                columns += [t.coefficients.T for t in tangents]
            elif mode == "slide":
                # Coulomb: the tangential impulse opposes the slip and is mu times the normal one
                slip = self.slip(contact.name)
                for s, t in zip(slip, tangents, strict=True):
                    columns[-1] = columns[-1] - contact.friction * s * t.coefficients.T
        if not rows:
            return [], sp.zeros(self.speeds.count, 0)
        return rows, sp.Matrix.hstack(*columns)

    def slip(self, name: str) -> list[Expr]:
        """Return the unit direction of the contact's slip just before the instant."""
        values = [value_of(t, self.u0) for t in self.contact_rows[name][1:]]
        if not values:
            raise CaromError(f"contact {name}: modes: expected a contact with tangents to slide along, got one without")
        size = tidy(sp.sqrt(sum((v**2 for v in values), sp.S.Zero))) if len(values) > 1 else sp.Abs(values[0])
        if is_zero(size):
            raise CaromError(
                f"contact {name}: does not slip before the instant, so the direction of sliding is undefined"
            )
        return [sp.sign(values[0])] if len(values) == 1 else [v / size for v in values]

    def _instant(self, modes: Mapping[str, str] | str | None) -> Instant:
        return Instant(self.mass, self.u0, *self.acting(modes), self.impulse)

    def contact(self, name: str) -> tuple[Contact, list[ConstraintRow]]:
        """Return the contact of that name and its constraint rows: normal, then tangents."""
        for contact in self.contacts:
            if contact.name == name:
                return contact, self.contact_rows[name]
        raise CaromError(f"contact: none is named {name}; expected one of {', '.join(self.contact_rows) or 'none'}")

    def redundancy(self, modes: Mapping[str, str] | str | None = None) -> dict[str, dict[str, Expr]]:
        """Return each redundant acting constraint with the linear combination of the others that implies it.

        Raises CaromError where two constraints contradict each other (equal coefficients, different drift or restitution).
        """
        return split_rows(self.acting(modes)[0])[1]

    # -- first derivation: virtual displacements ----------------------------------------------------------------------

    def virtual_displacements(
        self, independent: Sequence[Expr] | None = None, modes: Mapping[str, str] | str | None = None
    ) -> Matrix:
        """Return columns that span the virtual displacements: those along which no acting impulse does work.

        ``independent`` names the speeds to keep as parameters, as the paper keeps phi' in (6). Where these cannot serve as
        parameters (the paper's own psi = 0), CaromError names the speeds that can.
        """
        _, columns = self.acting(modes)
        return displacement_basis(self.speeds.names, columns, independent)

    def displacement_limit(self, independent: Expr, towards: Mapping[Expr, Expr]) -> Matrix:
        """Return the direction of the only virtual displacement at a configuration where ``independent`` cannot parametrise it.

        The column with ``independent`` = 1 has poles there; multiplied by its common denominator it has a limit. This is the
        step from the paper's (14) to (15), a factor sin psi / sin theta, for any system with one degree of freedom left.
        """
        column = self.virtual_displacements([independent])
        if column.cols != 1:
            raise CaromError(f"displacement limit: expected one freedom, got {column.cols}")
        return displacement_limit(column, towards)

    def jump_equations(self, modes: Mapping[str, str] | str | None = None) -> list[Expr]:
        """Return the linear equations for the speeds just after: momenta along virtual displacements, then restitution."""
        instant = self._instant(modes)
        shift = self.mass * (self.u1 - self.u0) - self.impulse
        _, wanted = targets(instant)
        equations = [sp.Eq(tidy(sp.expand(x)), 0) for x in self.virtual_displacements(modes=modes).T * shift]
        equations += [
            sp.Eq(sp.expand((instant.rows[i].coefficients * self.u1)[0]), tidy(v)) for i, v in sorted(wanted.items())
        ]
        return equations

    # -- solutions ------------------------------------------------------------------------------------------------------

    def solve(self, method: str = "multipliers", modes: Mapping[str, str] | str | None = None) -> Jump:
        """Solve for the jump in closed form.

        Parameters
        ----------
        method : "multipliers" or "virtual"
            Impulse and momentum with Lagrange multipliers, or virtual displacements; both give the same jump.
        modes : mapping or str, optional
            Mode of each contact: "stick", "slide" (in one direction throughout), "smooth" or "open" (no impulse); a single word
            applies to all. Default: "smooth" where mu = 0, else "stick", with Coulomb's friction cone as a condition.

        Warns
        -----
        EnergyGain
            Newton's rule creates energy for these speeds.
        FrictionJam
            A sliding contact jams (Painlevé), so no single phase of sliding ends the impact.
        """
        if method not in ("multipliers", "virtual"):
            raise CaromError(f"method: expected 'multipliers' or 'virtual', got {method!r}")
        instant, poisson = self._instant(modes), dict[str, Expr]()
        chosen = self._modes(modes)
        self._check_hypotheses(chosen)
        by_poisson = {c.name: c for c in self.contacts if c.hypothesis == "poisson" and chosen[c.name] != "open"}
        if by_poisson:
            restitution = {f"{name}.n": c.restitution for name, c in by_poisson.items()}
            instant, poisson = prescribe_poisson_impulses(instant, restitution, set(chosen))
        kept, redundant = split_rows(instant.rows)
        if method == "multipliers":
            u1, impulses = solve_by_multipliers(instant)
        else:
            u1 = solve_by_displacements(instant)
            impulses = impulses_of(instant, kept, u1)
        return self._finish(u1, {**poisson, **impulses}, redundant, chosen)

    def _check_hypotheses(self, chosen: Mapping[str, str]) -> None:
        for c in self.contacts:
            if c.hypothesis == "stronge" and chosen[c.name] == "stick" and c.restitution != 0 and c.tangents:
                slips = [value_of(t, self.u0) for t in self.contact_rows[c.name][1:]]
                if not all(is_zero(s) for s in slips):
                    raise CaromError(
                        f"contact {c.name}: hypothesis 'stronge': the work of a contact that slips and then sticks depends on the "
                        "course of the impact; use percussion(...), which follows it, or modes='slide'"
                    )

    def close(self, equations: Sequence[Expr], modes: Mapping[str, str] | str | None = None) -> list[Jump]:
        """Return every real jump that satisfies the linear jump equations and the given closing equations.

        The equations contain the symbols ``speeds.before`` and ``speeds.after`` and may be nonlinear (the paper's third
        hypothesis, conservation of energy). Raises CaromError where they leave a family of solutions or have none.
        """
        instant = self._instant(modes)
        kept, redundant = split_rows(instant.rows)
        linear = [e.lhs - e.rhs for e in self.jump_equations(modes) if not isinstance(e, sp.logic.boolalg.BooleanAtom)]
        extra = [
            (e.lhs - e.rhs if isinstance(e, sp.Equality) else sp.sympify(e)).xreplace(self.pre_relations)
            for e in equations
        ]
        found = sp.solve(linear + extra, list(self.speeds.after), dict=True)
        jumps = []
        for root in found:
            u1 = sp.Matrix([root.get(u, u) for u in self.speeds.after])
            if u1.has(*self.speeds.after):
                raise CaromError("close: equations: they leave a family of solutions; give one more")
            u1 = u1.applyfunc(tidy)
            jumps.append(self._finish(u1, impulses_of(instant, kept, u1), redundant, self._modes(modes)))
        if not jumps:
            raise CaromError("close: equations: expected a common solution, but no speeds meet all the equations")
        return jumps

    def energy(self, speeds: Matrix) -> Expr:
        """Return the part of the kinetic energy that is quadratic in the given speeds."""
        return tidy((speeds.T * self.mass * speeds)[0] / 2)

    def _finish(
        self, u1: Matrix, impulses: dict[str, Expr], redundant: dict[str, dict[str, Expr]], chosen: Mapping[str, str]
    ) -> Jump:
        # The difference of squares keeps symbolic results short: (u1 - u0) M (u1 + u0) / 2
        change = tidy(((u1 - self.u0).T * self.mass * (u1 + self.u0))[0] / 2)
        notes, free, conditions = [], [], dict[str, Expr]()
        for name, how in redundant.items():
            if any(name.startswith(f"{c.name}.") and chosen[c.name] == "slide" for c in self.contacts):
                raise CaromError(
                    f"contact {name}: redundant while it slides; its normal impulse is undetermined, and so is its friction"
                )
            symbol = sp.Symbol(f"Lambda_{{{name}}}", real=True)
            free.append(symbol)
            impulses[name] = symbol
            for other, c in how.items():
                impulses[other] = tidy(impulses[other] - c * symbol)
            said = " + ".join(f"({c})*[{n}]" for n, c in how.items())
            notes.append(
                f"{name} is redundant: it equals {said}; rigid bodies leave the split of their impulses undetermined"
            )
        for contact in self.contacts:
            name, mode, (normal, *tangents) = contact.name, chosen[contact.name], self.contact_rows[contact.name]
            slip = self.slip(name) if mode == "slide" else []
            gain = contact_mass.slide_gain(self.delassus(name), contact.friction, slip) if mode == "slide" else None
            approach = value_of(normal, self.u0)
            conditions |= contact_mass.contact_conditions(contact, mode, approach, impulses, slip, gain)
            if mode == "slide":  # the slip must not have ended during the impact
                left = zip(slip, tangents, strict=True)
                still = tidy(sum((component * value_of(row, u1) for component, row in left), sp.S.Zero))
                conditions[f"{name} goes on sliding"] = sp.Ge(still, 0)
        after = {u: u1[i] for i, u in enumerate(self.speeds.names)}
        if change.is_positive:
            text = f"the jump gains the energy {change}: Newton's restitution with friction or redundancy creates it"
            notes.append(text)
            if any(c.hypothesis == "newton" for c in self.contacts) or any(r.closing for r in self.imposed):
                warnings.warn(text, EnergyGain, stacklevel=3)
        return Jump(after, impulses, change, redundant, tuple(free), conditions, tuple(notes))

    # -- one contact --------------------------------------------------------------------------------------------------

    def delassus(self, name: str) -> Matrix:
        """Return the inverse mass that a contact feels; see :func:`carom.derive.percussion.delassus`."""
        return contact_mass.delassus(
            self.mass, self.contact(name)[1], [*self.permanent, *self.imposed], f"contact {name}"
        )

    def jam_friction(self, name: str) -> Expr:
        """Return the friction coefficient above which some slip of the contact jams; oo where none does."""
        return contact_mass.jam_friction(self.delassus(name))

    def percussion(self, name: str, values: Mapping[Expr, Any], hypothesis: str | None = None) -> Percussion:
        """Follow one contact through its impact numerically: slip, reversal, stick, jam (:func:`percussion.integrate`).

        ``values`` gives every symbol and coordinate a number (rationals stay exact); ``hypothesis`` replaces the contact's
        own. Raises CaromError where a number is missing.
        """
        contact, rows = self.contact(name)

        def number(expr: Expr) -> Expr:
            value = sp.sympify(expr).subs(values)
            if value.free_symbols or not value.is_number:
                missing = ", ".join(sorted(str(s) for s in value.free_symbols)) or str(value)
                raise CaromError(f"percussion: values: expected a number for every symbol, got none for {missing}")
            return value

        g = self.delassus(name).applyfunc(number)
        start = [number(value_of(r, self.u0)) for r in rows]
        return integrate(
            g, start, number(contact.restitution), number(contact.friction), hypothesis or contact.hypothesis
        )

    def lambdify(self, jump: Jump, arguments: Sequence[Expr] | None = None) -> Callable[..., Any]:
        """Return ``jump`` as a compiled function of numbers; see :func:`carom.derive.percussion.compile_jump`."""
        return compile_jump(jump, self.speeds, arguments)
