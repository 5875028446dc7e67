"""The fields of pooltool's files, by version; a file with others is of another version and is refused.

An unknown field could change the shot, so none is passed over. No file says which version wrote it: a shot whose balls have ``e_t``
is read as one of the main branch (of 28 June 2026), any other as one of 0.6.0.
"""

from __future__ import annotations

from carom.tracks.formats.pooltool import Field

SYSTEM = ("cue", "table", "balls", "t", "events")
CUE = ("id", "V0", "phi", "theta", "a", "b", "cue_ball_id", "specs")
SPECS = ("brand", "M", "length", "tip_radius", "shaft_radius_at_tip", "shaft_radius_at_butt", "end_mass")
TABLE = ("cushion_segments", "pockets", "table_type", "model_descr", "height", "lights_height")
LINEAR, CIRCULAR = ("id", "p1", "p2", "direction"), ("id", "center", "radius")
POCKET = ("id", "center", "radius", "depth", "contains")
BALL = ("id", "state", "params", "ballset", "initial_orientation", "history", "history_cts")
PARAMS = ("m", "R", "u_s", "u_r", "u_sp_proportionality", "u_b", "e_b", "e_c", "f_c", "g")
STATE, EVENT, AGENT = ("rvw", "s", "t"), ("event_type", "agents", "time"), ("id", "agent_type", "initial", "final")
# what the main branch has besides
OF_MAIN = {CUE: ("model_name",), LINEAR: ("nose_radius",), PARAMS: ("e_t",)}
VERSIONS = {False: "pooltool 0.6.0", True: "pooltool's main branch of June 2026"}
TRANSITIONS = ("spinning_stationary", "rolling_stationary", "rolling_spinning", "sliding_rolling")
EVENTS = (
    "none", "ball_ball", "ball_linear_cushion", "ball_circular_cushion", "ball_pocket", "stick_ball", *TRANSITIONS,
)  # fmt: skip
EVENTS_OF_MAIN = ("ball_table",)
REMEDY = "the file is of another version or damaged: save the shot again with pooltool 0.6.0"


def check_fields(system: Field) -> bool:
    """Return whether a shot is of pooltool's main branch. CaromError where it has other fields than a known version, or fewer."""
    balls = system["balls"].parts()
    main = any("e_t" in ball["params"] for ball in balls.values() if "params" in ball)
    _same(system, SYSTEM, main)
    cue, table = system["cue"], system["table"]
    _same(cue, CUE, main)
    _same(cue["specs"], SPECS, main)
    _same(table, TABLE, main)
    cushions = table["cushion_segments"]
    _same(cushions, ("linear", "circular"), main)
    for parts, known in ((cushions["linear"], LINEAR), (cushions["circular"], CIRCULAR), (table["pockets"], POCKET)):
        for part in parts.parts().values():
            _same(part, known, main)
    for ball in balls.values():
        _same(ball, BALL, main)
        _same(ball["params"], PARAMS, main)
        _same(ball["state"], STATE, main)
    for event in system["events"].each():
        _same(event, EVENT, main)
        kinds = (*EVENTS, *EVENTS_OF_MAIN) if main else EVENTS
        if event["event_type"].text() not in kinds:
            raise event["event_type"].fault(f"an event of {VERSIONS[main]}", remedy=REMEDY)
        for agent in event["agents"].each():
            _same(agent, AGENT, main)
    return main


def _same(part: Field, known: tuple[str, ...], main: bool) -> None:
    names = (*known, *OF_MAIN.get(known, ())) if main else known
    for name in (*part.fields(), *names):
        if (name in part) != (name in names):
            asked, got = ("no", "one") if name in part else ("a", "none")
            place = f"{part.place}.{name}" if part.place else name
            expected = f"{asked} field of this name, as in files of {VERSIONS[main]}"
            raise Field(None, part.file, place).fault(expected, got, REMEDY)
