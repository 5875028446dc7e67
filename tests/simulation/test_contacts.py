"""The table of the kinds of contact: what the loop resolves, what the log refers to, what is said."""

import pytest

import carom
from carom.simulation import contact_kinds as kinds
from carom.simulation.records import BALL, KINDS, POCKETED_EVENT, WALL


@pytest.mark.parametrize("code", kinds.CONTACTS)
def test_an_event_is_resolved_by_the_contact_of_its_kind(code, monkeypatch):
    names = {
        name: code for name in vars(kinds) for code, one in kinds.CONTACTS.items() if vars(kinds)[name] is one.meet
    }
    assert sorted(names.values()) == sorted(kinds.CONTACTS)
    for name, kind in names.items():
        monkeypatch.setattr(kinds, name, lambda *args, kind=kind: (kind, *args))
    assert kinds.resolve_event(code, "world", "features", "balls", 1, 2, "users") == (
        code, "world", "features", "balls", 1, 2, "users",
    )  # fmt: skip


def test_every_row_of_a_log_refers_to_what_its_kind_of_contact_meets():
    run = carom.simulate("pool-9ft")
    for row in run.log[run.log["met"] != KINDS.index("nothing")]:
        kind = BALL if KINDS[row["kind"]] == "in-cluster" else int(row["kind"])
        assert row["met"] == kinds.met_at(kind) == kinds.CONTACTS[kind].met
        assert 0 <= row["other"] < len(kinds.partner_names(run.scene, int(row["met"])))
    assert {WALL, BALL, POCKETED_EVENT} <= set(run.log["met"].tolist())


def test_what_is_met_is_that_of_the_table():
    for kind in range(len(KINDS)):
        assert kinds.met_at(kind) == (kinds.CONTACTS[kind].met if kind in kinds.CONTACTS else KINDS.index("nothing"))


def test_refusals_of_all_contacts_have_codes_of_their_own():
    codes = [code for one in kinds.CONTACTS.values() for code in one.refusals]
    assert len(codes) == len(set(codes)) == len(kinds.ALL_REFUSALS) > 0
