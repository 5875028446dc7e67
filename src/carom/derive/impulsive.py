"""Impulsive motion from a Lagrangian and its constraints.

Constraints are imposed at an instant; virtual displacements compatible with them are taken at the frozen configuration;
the generalised momenta along those displacements do not jump (the method of the paper's sections 2 and 3.3, after
Neimark and Fufaev, *Dynamics of Nonholonomic Systems*, 1972). The same jump follows from impulse and momentum with one
multiplier a constraint; both are here, share only the mass matrix and the rows, and the tests hold one against the
other.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import sympy as sp

from carom.derive import coupling, displacement
from carom.derive.cautions import EnergyGain
from carom.derive.contact import Contact
from carom.derive.derivations import Instant, by_multipliers, by_virtual, impulses_of, split_rows, targets, value_of
from carom.derive.jump import Jump
from carom.derive.linear import (
    Expr,
    Matrix,
    bound_columns,
    independent_rows,
    is_zero,
    solve_linear,
    tidy,
)
from carom.derive.percussion import Percussion
from carom.derive.setup import Row, Speeds, constraint_row, make_speeds, mass_matrix, named
from carom.errors import CaromError

__all__ = ["ImpulsiveMotion", "Jump"]


class ImpulsiveMotion:
    """The jump of a mechanical system at an instant, in the manner of ``sympy.physics.mechanics.LagrangesMethod``.

    Args:
        lagrangian: Lagrangian or kinetic energy; quadratic in the speeds, forces of finite size play no part.
        coordinates: generalised coordinates, ``dynamicsymbols``.
        speeds: quasi-velocities, where the energy is written in those; left out: time derivatives of the coordinates.
        hol_coneqs: permanent holonomic constraints, expressions of the coordinates that vanish.
        nonhol_coneqs: permanent constraints linear in the speeds, expressions that vanish.
        before: constraints that held until the instant and exert no impulse (a floor that the body leaves).
        imposed: constraints that the instant brings and that hold afterwards; name to expression, or a sequence.
        instant: constraints that act only during the instant: virtual displacements respect them, the speeds afterwards
            need not. They leave the equations open; close them with `close`, or give ``restitution``.
        restitution: name of an ``instant`` constraint to Newton's e for it.
        contacts: `Contact` points with restitution and friction.
        impulse: known impulses from outside: speed to generalised impulse.
        at: the configuration at the instant, coordinate to value; left out: any configuration.
        forcelist, bodies, frame: taken so that the arguments of a ``LagrangesMethod`` can be handed over as they are;
            forces of finite size do nothing in an instant.

    Raises:
        CaromError: a constraint not linear in the speeds, an unknown symbol, a singular mass matrix, constraints that
            contradict each other; each names the culprit.
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
        """Check what comes in and turn it into matrices."""
        del forcelist, bodies, frame
        self.coordinates = tuple(coordinates)
        self.speeds: Speeds = make_speeds(self.coordinates, speeds)
        self.at = {k: sp.sympify(v) for k, v in (at or {}).items()}
        for q in self.at:
            if q not in self.coordinates:
                raise CaromError(f"at: {q} is not a coordinate; expected some of {list(self.coordinates)}")
        self.lagrangian = sp.sympify(lagrangian)
        self.mass, self._drift_momentum = mass_matrix(self.lagrangian, self.coordinates, self.speeds, self.at)
        bounce = {str(k): sp.sympify(v) for k, v in (restitution or {}).items()}

        def rows(given: Mapping[str, Expr] | Iterable[Expr] | None, prefix: str, loose: bool = False) -> list[Row]:
            return [
                constraint_row(
                    n, c, self.coordinates, self.speeds, self.at, bounce.pop(n, None) if loose else sp.S.Zero
                )
                for n, c in named(given, prefix).items()
            ]

        self.permanent = rows(hol_coneqs, "holonomic") + rows(nonhol_coneqs, "nonholonomic")
        self.past = rows(before, "before")
        self.imposed = rows(imposed, "imposed") + rows(instant, "instant", loose=True)
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
        self.pre_relations = self._pre_relations()

    # -- what comes in ------------------------------------------------------------------------------------------------

    def _rows_of(self, contact: Contact) -> list[Row]:
        """Rows of a contact: normal, then tangents."""
        pairs = [("n", contact.normal, contact.restitution)]
        pairs += [(f"t{i + 1}", t, contact.tangential_restitution) for i, t in enumerate(contact.tangents)]
        return [
            constraint_row(f"{contact.name}.{k}", c, self.coordinates, self.speeds, self.at, e) for k, c, e in pairs
        ]

    def _pre_relations(self) -> dict[Expr, Expr]:
        """Speeds just before that the constraints of then determine, the last ones in terms of the first."""
        held = [*self.permanent, *self.past]
        if not held:
            return {}
        rows = sp.Matrix.vstack(*[r.coefficients for r in held])
        kept, dependent = independent_rows(rows)
        for i, how in dependent.items():
            gap = held[i].drift - sum((c * held[j].drift for j, c in how.items()), sp.S.Zero)
            if not is_zero(gap):
                raise CaromError(
                    f"constraints: {held[i].name} contradicts {', '.join(held[j].name for j in how) or 'itself'}"
                )
        system = rows.extract(kept, list(range(rows.cols)))
        bound = bound_columns(system)
        loose = [j for j in range(rows.cols) if j not in bound]
        right = -sp.Matrix([held[i].drift for i in kept])
        if loose:
            right -= system.extract(list(range(len(kept))), loose) * sp.Matrix([self.speeds.before[j] for j in loose])
        found = solve_linear(system.extract(list(range(len(kept))), bound), right, "constraints before the instant")
        return {self.speeds.before[j]: found[i] for i, j in enumerate(bound)}

    @property
    def u0(self) -> Matrix:
        """Speeds just before, with the constraints of then put in."""
        return sp.Matrix([self.pre_relations.get(u, u) for u in self.speeds.before])

    @property
    def u1(self) -> Matrix:
        """Symbols of the speeds just after."""
        return sp.Matrix(self.speeds.after)

    def momentum(self, moment: int) -> Matrix:
        """Generalised momenta just before (0) or just after (1) the instant, in the symbols of that moment."""
        speeds = self.speeds.after if moment else self.speeds.before
        return (self.mass * sp.Matrix(speeds) + self.speeds.plain(self._drift_momentum).xreplace(self.at)).applyfunc(
            tidy
        )

    def velocity(self, expr: Expr, jump: Jump | None = None) -> Expr:
        """Value of a velocity (an expression of the speeds) just before the instant, or just after it by ``jump``."""
        row = self.speeds.plain(sp.sympify(expr)).xreplace(self.at)
        values = list(self.u0) if jump is None else [jump.after[u] for u in self.speeds.names]
        return tidy(row.xreplace(dict(zip(self.speeds.dummies, values, strict=True))))

    # -- rows that act during the instant -----------------------------------------------------------------------------

    def _modes(self, modes: Mapping[str, str] | str | None) -> dict[str, str]:
        """Mode of each contact: stick, slide or smooth; by default as its friction says."""
        wanted = {c.name: modes for c in self.contacts} if isinstance(modes, str) else dict(modes or {})
        for name, mode in wanted.items():
            if name not in self.contact_rows:
                raise CaromError(f"modes: no contact is named {name}; expected one of {list(self.contact_rows)}")
            if mode not in ("stick", "slide", "smooth", "open"):
                raise CaromError(f"modes: contact {name}: expected stick, slide, smooth or open, got {mode}")
        return {c.name: wanted.get(c.name, "smooth" if c.friction == 0 else "stick") for c in self.contacts}

    def acting(self, modes: Mapping[str, str] | str | None) -> tuple[list[Row], Matrix]:
        """Rows that act in the instant, and the directions (columns) of their impulses."""
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
        """Unit direction of the contact's slip just before the instant."""
        values = [value_of(t, self.u0) for t in self.contact_rows[name][1:]]
        if not values:
            raise CaromError(f"contact {name}: has no tangents to slide along")
        size = tidy(sp.sqrt(sum((v**2 for v in values), sp.S.Zero))) if len(values) > 1 else sp.Abs(values[0])
        if is_zero(size):
            raise CaromError(f"contact {name}: does not slip before the instant, so it has no direction to slide in")
        return [sp.sign(values[0])] if len(values) == 1 else [v / size for v in values]

    def _instant(self, rows: list[Row], columns: Matrix) -> Instant:
        return Instant(self.mass, self.u0, rows, columns, self.impulse)

    def contact(self, name: str) -> tuple[Contact, list[Row]]:
        """The contact of that name, and its rows: normal, then tangents."""
        for contact in self.contacts:
            if contact.name == name:
                return contact, self.contact_rows[name]
        raise CaromError(f"contact: none is named {name}; expected one of {', '.join(self.contact_rows) or 'none'}")

    def redundancy(self, modes: Mapping[str, str] | str | None = None) -> dict[str, dict[str, Expr]]:
        """Each superfluous acting constraint and the combination of others that says the same.

        Raises CaromError where two constraints contradict each other (same left side, another drift or closing).
        """
        rows, _ = self.acting(modes)
        return split_rows(rows)[1]

    # -- first derivation: virtual displacements ----------------------------------------------------------------------

    def virtual_displacements(
        self, independent: Sequence[Expr] | None = None, modes: Mapping[str, str] | str | None = None
    ) -> Matrix:
        """Columns that span the displacements along which no acting impulse does work.

        ``independent`` names the speeds to keep as parameters, as the paper keeps phi' in (6); CaromError says which
        others are possible where these cannot be (the paper's own psi = 0).
        """
        _, columns = self.acting(modes)
        return displacement.basis(self.speeds.names, columns, independent)

    def displacement_limit(self, independent: Expr, towards: Mapping[Expr, Expr]) -> Matrix:
        """Direction of the one virtual displacement at a configuration where ``independent`` fails as its parameter.

        The column with ``independent`` = 1 has poles there; cleared of its denominators it has a limit. This is the
        step from the paper's (14) to (15), a factor sin psi / sin theta, done for any system with one freedom left.
        """
        column = self.virtual_displacements([independent])
        if column.cols != 1:
            raise CaromError(f"displacement limit: expected one freedom, got {column.cols}")
        return displacement.limit(column, towards)

    def jump_equations(self, modes: Mapping[str, str] | str | None = None) -> list[Expr]:
        """Linear equations in the speeds just after: momenta along virtual displacements, then the closing ones."""
        rows, columns = self.acting(modes)
        shift = self.mass * (self.u1 - self.u0) - self.impulse
        kept, redundant = split_rows(rows)
        wanted = targets(self._instant(rows, columns), kept, redundant)
        equations = [sp.Eq(tidy(sp.expand(x)), 0) for x in self.virtual_displacements(modes=modes).T * shift]
        equations += [sp.Eq(sp.expand((rows[i].coefficients * self.u1)[0]), tidy(v)) for i, v in sorted(wanted.items())]
        return equations

    # -- answers ------------------------------------------------------------------------------------------------------

    def solve(self, method: str = "multipliers", modes: Mapping[str, str] | str | None = None) -> Jump:
        """The jump in closed form.

        Args:
            method: "multipliers" (impulse and momentum) or "virtual" (virtual displacements); they must agree.
            modes: for each contact "stick", "slide" (one direction throughout), "smooth", or "open" (no impulse);
                one word for all. Left out: smooth where mu = 0, else stick, with Coulomb's cone as a condition.

        Warns:
            EnergyGain: Newton's rule creates energy for the speeds given.
            FrictionJam: a sliding contact jams (Painlevé), so no single slide ends the impact.
        """
        if method not in ("multipliers", "virtual"):
            raise CaromError(f"method: expected multipliers or virtual, got {method}")
        rows, columns = self.acting(modes)
        chosen = self._modes(modes)
        self._check_hypotheses(chosen)
        instant, poisson = self._instant(rows, columns), dict[str, Expr]()
        if any(c.hypothesis == "poisson" and chosen[c.name] != "open" for c in self.contacts):
            instant, poisson = self._poisson(instant, chosen)
        kept, redundant = split_rows(instant.rows)
        if method == "multipliers":
            u1, impulses = by_multipliers(instant)
        else:
            u1 = by_virtual(instant)
            impulses = impulses_of(instant, kept, u1)
        impulses = {**poisson, **impulses}
        return self._finish(u1, impulses, redundant, chosen)

    def _check_hypotheses(self, chosen: Mapping[str, str]) -> None:
        for c in self.contacts:
            if c.hypothesis == "stronge" and chosen[c.name] == "stick" and c.restitution != 0 and c.tangents:
                slips = [value_of(t, self.u0) for t in self.contact_rows[c.name][1:]]
                if not all(is_zero(s) for s in slips):
                    raise CaromError(
                        f"contact {c.name}: the work of a contact that slips first and then sticks depends on the way "
                        "there; use percussion(...), which follows it, or slide"
                    )

    def _poisson(self, at: Instant, chosen: Mapping[str, str]) -> tuple[Instant, dict[str, Expr]]:
        """Poisson's rule: solve compression to its end, then hand (1 + e) of the normal impulse over as known."""
        normals = {f"{c.name}.n": c for c in self.contacts if c.hypothesis == "poisson" and chosen[c.name] != "open"}
        ends = [replace(r, closing=sp.S.Zero) if r.name.split(".")[0] in chosen else r for r in at.rows]
        _, squeeze = by_multipliers(replace(at, rows=ends))
        impulse, known, keep = at.impulse, {}, []
        for i, row in enumerate(at.rows):
            if row.name in normals:
                if row.name not in squeeze:
                    raise CaromError(f"contact {row.name}: redundant, so Poisson's rule cannot tell its impulse")
                known[row.name] = tidy((1 + normals[row.name].restitution) * squeeze[row.name])
                impulse = impulse + at.columns[:, i] * known[row.name]
            else:
                keep.append(i)
        columns = at.columns.extract(list(range(self.speeds.count)), keep)
        return replace(at, rows=[at.rows[i] for i in keep], columns=columns, impulse=impulse), known

    def close(self, equations: Sequence[Expr], modes: Mapping[str, str] | str | None = None) -> list[Jump]:
        """Every real jump that meets the linear jump equations and the user's own closing equations.

        The equations hold speeds symbols of before (``speeds.before``) and after (``speeds.after``) and may be
        nonlinear (the paper's third hypothesis, energy). Raises CaromError when they leave a family or have no root.
        """
        rows, columns = self.acting(modes)
        kept, redundant = split_rows(rows)
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
                raise CaromError("close: the equations leave a family of answers; give one more")
            u1 = u1.applyfunc(tidy)
            impulses = impulses_of(self._instant(rows, columns), kept, u1)
            jumps.append(self._finish(u1, impulses, redundant, self._modes(modes)))
        if not jumps:
            raise CaromError("close: no speeds meet all the equations")
        return jumps

    def energy(self, speeds: Matrix) -> Expr:
        """Part of the energy that is quadratic in the given speeds."""
        return tidy((speeds.T * self.mass * speeds)[0] / 2)

    def _finish(
        self, u1: Matrix, impulses: dict[str, Expr], redundant: dict[str, dict[str, Expr]], chosen: Mapping[str, str]
    ) -> Jump:
        # The difference of squares keeps symbolic results short: (u1 - u0) M (u1 + u0) / 2
        change = tidy(((u1 - self.u0).T * self.mass * (u1 + self.u0))[0] / 2)
        notes, conditions, free = [], {}, []
        impulses = dict(impulses)
        for name, how in redundant.items():
            if any(name.startswith(f"{c.name}.") and chosen[c.name] == "slide" for c in self.contacts):
                raise CaromError(
                    f"contact {name}: redundant while it slides; its impulse is undetermined and so is friction"
                )
            symbol = sp.Symbol(f"Lambda_{{{name}}}", real=True)
            free.append(symbol)
            impulses[name] = symbol
            for other, c in how.items():
                impulses[other] = tidy(impulses[other] - c * symbol)
            said = " + ".join(f"({c})*[{n}]" for n, c in how.items())
            notes.append(f"{name} is redundant: it equals {said}; rigid bodies leave the split of their impulses open")
        for contact in self.contacts:
            conditions.update(coupling.conditions(self, contact, impulses, chosen[contact.name]))
            if chosen[contact.name] == "slide":  # it must not have come to rest on the way
                _, rows = self.contact(contact.name)
                left = zip(self.slip(contact.name), rows[1:], strict=True)
                still = tidy(sum((way * value_of(row, u1) for way, row in left), sp.S.Zero))
                conditions[f"{contact.name} goes on sliding"] = sp.Ge(still, 0)
        after = {u: u1[i] for i, u in enumerate(self.speeds.names)}
        if change.is_positive:
            text = f"the answer gains the energy {change}: Newton's restitution with friction or redundancy creates it"
            notes.append(text)
            if any(c.hypothesis == "newton" for c in self.contacts) or any(r.closing for r in self.imposed):
                warnings.warn(text, EnergyGain, stacklevel=3)
        return Jump(after, impulses, change, redundant, tuple(free), conditions, tuple(notes))

    # -- contacts as a whole: see carom.derive.coupling ----------------------------------------------------------------

    def delassus(self, name: str) -> Matrix:
        """Inverse mass that the contact feels; `coupling.delassus`."""
        return coupling.delassus(self, name)

    def jam_friction(self, name: str) -> Expr:
        """Friction above which some slip of the contact jams; `coupling.jam_friction`."""
        return coupling.jam_friction(self, name)

    def newton_minors(self, name: str) -> list[Expr]:
        """Minors of what Newton's rule takes from a sticking contact; `coupling.newton_minors`."""
        return coupling.newton_minors(self, name)

    def percussion(self, name: str, values: Mapping[Expr, Any], hypothesis: str | None = None) -> Percussion:
        """The contact followed through its impact at given numbers; `coupling.percussion`."""
        return coupling.percussion(self, name, values, hypothesis)

    def lambdify(self, jump: Jump, arguments: Sequence[Expr] | None = None) -> Callable[..., Any]:
        """``jump`` as a compiled function of numbers; see `carom.derive.compiled.compile_jump`."""
        from carom.derive.compiled import compile_jump

        return compile_jump(jump, self.speeds, arguments)
