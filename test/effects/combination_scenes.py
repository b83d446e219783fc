"""Scenes that combine the effects: one choice of each factor, as one would write it in a scene's file."""

from __future__ import annotations

import copy
from typing import Any

import yaml

from beardyn_core.choice import scene_from_text
from beardyn_core.scene.scene import Scene
from test.effects.covering import Row

Choice = tuple[str, Any]

CAGE = {
    "lubrication": True,
    "guidance": {"on": "cup", "clearance_mm": 0.15},
}
FULL_RIB = {"roller_end": True, "drilling": True, "lubrication": {"kind": "mixed"}}
THERMAL = {"time_scale": 300.0}  # 1000 took half a millimetre of end play in two blocks without a rib
GROWTH = {"from_s": 0.02, "to_s": 0.06}
FAULTS: list[dict[str, Any]] = [
    {"kind": "spall", "on": "cup", "row": 0, "azimuth_deg": 8, "width_mm": 6, "depth_um": 30, "length_mm": 25,
     "growth": GROWTH},
    {"kind": "dent", "on": "cone", "row": 1, "width_mm": 3, "depth_um": 30, "length_mm": 4, "offset_mm": 8,
     "rim_height_um": 4, "rim_width_mm": 1},
    {"kind": "elliptic", "on": "roller", "row": 0, "roller": 2, "width_mm": 4, "depth_um": 20},
    {"kind": "diameter", "row": 1, "roller": 3, "diameter_um": 5},
    {"kind": "worn_pocket", "row": 0, "pocket": 5, "clearance_mm": 0.5},
]  # fmt: skip
WAVES: list[dict[str, Any]] = [
    {"on": on, "row": row, "band": {"first": 2, "last": 20, "rms_um": 0.3}, "seed": 11}
    for on, row in (("cup", 0), ("cone", 1), ("roller", 0))
]
SUSPENDED = {
    "cup": "suspended",
    "box_centre_mm": [10, 0, 40],
    "suspension_centre_mm": [0, 0, 60],
    "load_offset_mm": [0, 3, 0],
    "box_inertia_kg_m2": [3, 3, 3],
}

FACTORS: dict[str, tuple[Choice, ...]] = {
    "traction": (
        ("none", None),
        ("coulomb", {"kind": "coulomb", "friction": 0.05}),
        ("mixed", {"kind": "mixed"}),
        ("load sharing", {"kind": "load_sharing"}),
    ),
    "cage": (
        ("none", False),
        ("free", CAGE),
        ("rotating", {"kind": "rotating"}),
        ("kinematic", {"kind": "kinematic"}),
    ),
    "film": (
        ("none", False),
        ("plain", True),
        ("thermal", {"thermal": "murch_wilson", "isoviscous": True}),
    ),
    "rib": (("none", False), ("plain", True), ("full", FULL_RIB)),
    # heat needs the audit: one factor for both
    "audit": (("none", False), ("audit", True), ("thermal", THERMAL)),
    "contact_damping": (("none", False), ("present", True)),
    "lamina_coupling": (("none", None), ("present", True)),
    "rolling_resistance": (("none", None), ("present", {"hysteresis": 0.01})),
    "drag": (("none", None), ("present", True)),
    "small_rib": (("none", None), ("present", True)),
    "seal": (("none", None), ("present", True)),
    "windage": (("none", None), ("present", True)),
    "structure": (("none", None), ("rings", True), ("modes", {"kind": "modes", "table": "high_speed"})),
    "gravity": (("none", False), ("present", True)),
    "faults": (("none", []), ("present", FAULTS)),
    "waviness": (("none", []), ("present", WAVES)),
    "mounting": (("held", {"cup": "held"}), ("suspended", SUSPENDED)),
    "tilt": (("locked", "locked"), ("free", "free")),
    "laminae": (("6", 6), ("20", 20)),
}
OUTSIDE = ("faults", "waviness", "mounting", "tilt", "laminae")  # factors that are no effect by name

# One line a scene, one digit a factor: every pair of choices of two factors occurs in one of them. Found by
# annealing; the greedy `covering_array` needs four scenes more, and each costs half a minute of compiling.
_TABLE = """
3120210010100010110
1210100010102100111
0220001000000101000
3212210110101111100
1300200000101000101
3321010101010110110
1021011111100001000
3002101000102000001
0101000100002011101
2020200001002000110
1122101110011011011
2112011001110100101
2310000110011011000
0011211101111110001
0302111111112111110
2201111011010010110
"""
ROWS: tuple[Row, ...] = tuple(
    {name: int(digit) for name, digit in zip(FACTORS, line, strict=True)} for line in _TABLE.split()
)


def label(row: Row) -> str:
    """What is special about a row: the choices that are not absent."""
    chosen = {name: FACTORS[name][index][0] for name, index in row.items()}
    return ", ".join(
        name if what == "present" else f"{name} {what}" for name, what in chosen.items() if what != "none"
    )


def scene_of(row: Row, tier: str = "full") -> Scene:
    """The scene of one row."""
    chosen = {name: copy.deepcopy(FACTORS[name][index][1]) for name, index in row.items()}
    effects = {name: value for name, value in chosen.items() if name not in OUTSIDE}
    if isinstance(effects["audit"], dict):
        effects["thermal"], effects["audit"] = effects["audit"], True
    if FACTORS["structure"][row["structure"]][0] == "modes":  # whose box stands in its table
        for key in ("box_centre_mm", "box_inertia_kg_m2"):
            chosen["mounting"].pop(key, None)
    if not effects["cage"]:
        effects["windage"] = None
        chosen["faults"] = [fault for fault in chosen["faults"] if fault["kind"] != "worn_pocket"]
    written = {
        "scene": "combination",
        "bearing": "HS130x230",
        "lubricant": "L055",
        "tier": tier,
        "end_play_mm": 0.02,
        "effects": effects,
        "operation": {"kind": "constant", "force_kN": [0, 0, 80], "speed_rpm": 1165},
        "mounting": {**chosen["mounting"], "journal_tilt": chosen["tilt"]},
        "defects": chosen["faults"],
        "waviness": chosen["waviness"],
        "numerics": {"laminae": chosen["laminae"]},
    }
    return scene_from_text(yaml.safe_dump(written), "combination")
