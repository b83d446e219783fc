"""Enclaves of SROS 2: what each node may publish, receive and offer, and keys and certificates for it.

``python -m beardyn_ros.enclaves keystore FOLDER`` makes the folder that `ROS_SECURITY_KEYSTORE` names, in
the layout of ``ros2 security``, with openssl alone; ``python -m beardyn_ros.enclaves policy`` prints the same
rights as policy for ``ros2 security generate_artifacts``. Neither needs ROS 2.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Sequence
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree as Xml

from beardyn_core.base.errors import InputError
from beardyn_core.record.topics import TOPICS

EXIT_BAD_INPUT = 2
VALID_DAYS = 3650
READER = "reader"  # whoever looks and says nothing: RViz, a bridge, `ros2 topic echo`
_OF_OTHERS = ("", "load", "monitor", "follower")
_SIGNALS = (
    *(entry.name for entry in TOPICS if entry.name.partition("/")[0] not in _OF_OTHERS),
    "vibration/*",
    "values/*",
)
_LOAD = ("load/blocks", "load/truth", "load/wrench", "load/shaft")
_ROBOT = ("robot_description", "/tf", "/tf_static")
_MONITOR = ("monitor/result",)
_FOLLOWER = ("follower/estimate", "follower/residual")
_OF_TRAIN = ("vibration", "shaft", "temperature")
_OF_PARAMETERS = (
    "describe_parameters", "get_parameter_types", "get_parameters", "list_parameters", "set_parameters",
    "set_parameters_atomically", "get_type_description",
)  # fmt: skip
_OF_LIFECYCLE = (
    "change_state", "get_available_states", "get_available_transitions", "get_state", "get_transition_graph",
)  # fmt: skip
_OF_SIMULATOR = (
    "get_simulator_features", "get_simulation_state", "set_simulation_state", "step_simulation",
    "reset_simulation",
)  # fmt: skip


class Rights(NamedTuple):
    """What one node may do; names are relative to the namespace, or absolute, ``*`` is any ending."""

    publish: tuple[str, ...]
    subscribe: tuple[str, ...]
    serve: tuple[str, ...]


RIGHTS = {
    "twin": Rights(
        (*_SIGNALS, "load/consumed", *_ROBOT, "twin/transition_event", "/clock"),
        _LOAD,
        ("pause", "step", "reset", *_OF_SIMULATOR, *(f"twin/{name}" for name in _OF_LIFECYCLE)),
    ),
    "load": Rights(_LOAD, ("load/consumed", "truth"), ("load/pause", "load/step", "load/reset")),
    "recorder": Rights(
        (), (*_SIGNALS, *_LOAD, "load/consumed", *_MONITOR, *_FOLLOWER), ()
    ),
    "monitor": Rights((*_MONITOR, "values/*"), (*_OF_TRAIN, "load/blocks", "load/wrench"), ()),
    "follower": Rights((*_FOLLOWER, "values/*"), _OF_TRAIN, ()),
    READER: Rights((), (*_SIGNALS, *_LOAD, "load/consumed", *_MONITOR, *_FOLLOWER, *_ROBOT, "/rosout"), ()),
}  # fmt: skip


def full_rights(part: str) -> Rights:
    """Rights of a part with what every node has: diagnostics, log, clock, parameters."""
    own = RIGHTS[part]
    said = () if part == READER else ("/diagnostics",)
    return Rights(
        (*own.publish, *said, "/rosout", "/parameter_events"),
        (*own.subscribe, "/diagnostics", "/clock", "/parameter_events"),
        (*own.serve, *(f"{part}/{name}" for name in _OF_PARAMETERS)),
    )


def absolute(names: Iterable[str], namespace: str) -> list[str]:
    """Write names with their namespace, in order and each once."""
    space = f"/{namespace.strip('/')}"
    return sorted({name if name.startswith("/") else f"{space}/{name}" for name in names})


def enclave_of(part: str, namespace: str) -> str:
    """Name the enclave of a part: ``/axlebox/twin``."""
    return f"/{namespace.strip('/')}/{part}"


def policy(namespace: str) -> str:
    """Write the rights of all enclaves as a policy of ``ros2 security``.

    Parameters
    ----------
    namespace : str
        Of the axlebox.
    """
    root = Xml.Element("policy", version="0.2.0")
    enclaves = Xml.SubElement(root, "enclaves")
    for part in RIGHTS:
        rights = full_rights(part)
        enclave = Xml.SubElement(enclaves, "enclave", path=enclave_of(part, namespace))
        profile = Xml.SubElement(
            Xml.SubElement(enclave, "profiles"), "profile", ns=f"/{namespace.strip('/')}", node=part
        )
        for kind, entry, verb, names in (
            ("topics", "topic", "publish", rights.publish),
            ("topics", "topic", "subscribe", rights.subscribe),
            ("services", "service", "reply", rights.serve),
        ):
            listed = Xml.SubElement(profile, kind, {verb: "ALLOW"})
            for name in absolute(names, namespace):
                Xml.SubElement(listed, entry).text = name
    return _text(root)


def permissions(part: str, namespace: str, domain: int, now: datetime) -> str:
    """Write the permissions of one enclave: topics and services as DDS names them.

    Parameters
    ----------
    part : str
        Key of `RIGHTS`.
    namespace : str
    domain : int
        `ROS_DOMAIN_ID`.
    now : datetime
        They are valid from a day before that for `VALID_DAYS`.

    References
    ----------
    OMG DDS Security 1.1, 9.4.1.3; names of topics and services after the design of SROS 2 enclaves.
    """
    rights, enclave = full_rights(part), enclave_of(part, namespace)
    root = Xml.Element("dds")
    grant = Xml.SubElement(Xml.SubElement(root, "permissions"), "grant", name=enclave)
    Xml.SubElement(grant, "subject_name").text = f"CN={enclave}"
    validity = Xml.SubElement(grant, "validity")
    for tag, days in (("not_before", -1), ("not_after", VALID_DAYS)):
        Xml.SubElement(validity, tag).text = (now + timedelta(days=days)).strftime("%Y-%m-%dT%H:%M:%S")
    rule = Xml.SubElement(grant, "allow_rule")
    Xml.SubElement(Xml.SubElement(rule, "domains"), "id").text = str(domain)
    served = absolute(rights.serve, namespace)
    out = [f"rt{name}" for name in absolute(rights.publish, namespace)]
    out += [f"rr{name}Reply" for name in served]
    taken = [f"rt{name}" for name in absolute(rights.subscribe, namespace)]
    taken += [f"rq{name}Request" for name in served]
    for tag, names in (("publish", out), ("subscribe", taken)):
        topics = Xml.SubElement(Xml.SubElement(rule, tag), "topics")
        for name in ("ros_discovery_info", *names):
            Xml.SubElement(topics, "topic").text = name
    Xml.SubElement(grant, "default").text = "DENY"
    return _text(root)


def governance(domain: int) -> str:
    """Write the rules of the domain: nobody without a certificate, everything signed and encrypted."""
    root = Xml.Element("dds")
    rule = Xml.SubElement(Xml.SubElement(root, "domain_access_rules"), "domain_rule")
    Xml.SubElement(Xml.SubElement(rule, "domains"), "id").text = str(domain)
    for tag, value in (
        ("allow_unauthenticated_participants", "false"),
        ("enable_join_access_control", "true"),
        ("discovery_protection_kind", "ENCRYPT"),
        ("liveliness_protection_kind", "ENCRYPT"),
        ("rtps_protection_kind", "SIGN"),
    ):
        Xml.SubElement(rule, tag).text = value
    topic = Xml.SubElement(Xml.SubElement(rule, "topic_access_rules"), "topic_rule")
    for tag, value in (
        ("topic_expression", "*"),
        ("enable_discovery_protection", "true"),
        ("enable_liveliness_protection", "true"),
        ("enable_read_access_control", "true"),
        ("enable_write_access_control", "true"),
        ("metadata_protection_kind", "ENCRYPT"),
        ("data_protection_kind", "ENCRYPT"),
    ):
        Xml.SubElement(topic, tag).text = value
    return _text(root)


def _text(root: Xml.Element) -> str:
    Xml.indent(root)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{Xml.tostring(root, encoding="unicode")}\n'


class Authority:
    """Signs certificates and documents for one keystore.

    Parameters
    ----------
    folder : Path
        The keystore; a new authority is made in it.
    """

    def __init__(self, folder: Path) -> None:
        self.certificate, self._key = folder / "public/ca.cert.pem", folder / "private/ca.key.pem"
        with tempfile.TemporaryDirectory() as name:
            self._request(
                Path(name), "beardynCA", self._key,
                "-x509", "-extensions", "ca", "-days", str(VALID_DAYS), "-out", str(self.certificate),
            )  # fmt: skip
        for part in ("identity", "permissions"):
            (folder / f"public/{part}_ca.cert.pem").symlink_to("ca.cert.pem")
            (folder / f"private/{part}_ca.key.pem").symlink_to("ca.key.pem")

    def certify(self, subject: str, key: Path, certificate: Path) -> None:
        """Make a key, and a certificate of it for a subject."""
        with tempfile.TemporaryDirectory() as name:
            asked = Path(name) / "asked.pem"
            self._request(Path(name), subject, key, "-out", str(asked))
            _openssl(
                "x509", "-req", "-in", str(asked), "-CA", str(self.certificate), "-CAkey", str(self._key),
                "-set_serial", f"0x{os.urandom(16).hex()}", "-days", str(VALID_DAYS), "-sha256",
                "-extfile", str(Path(name) / "openssl.cnf"), "-extensions", "node", "-out", str(certificate),
            )  # fmt: skip

    def sign(self, document: Path) -> None:
        """Sign a document as S/MIME next to it, with the ending ``.p7s``."""
        _openssl(
            "smime", "-sign", "-text", "-in", str(document), "-out", str(document.with_suffix(".p7s")),
            "-signer", str(self.certificate), "-inkey", str(self._key),
        )  # fmt: skip

    def _request(self, folder: Path, subject: str, key: Path, *words: str) -> None:
        settings = folder / "openssl.cnf"
        settings.write_text(
            "[req]\nprompt = no\ndistinguished_name = name\n"
            f"[name]\nCN = {subject}\n"
            "[ca]\nbasicConstraints = critical,CA:TRUE,pathlen:1\n"
            "[node]\nbasicConstraints = CA:FALSE\n",
            encoding="utf-8",
        )
        _openssl(
            "req", "-new", "-config", str(settings), "-newkey", "ec", "-pkeyopt",
            "ec_paramgen_curve:prime256v1", "-nodes", "-sha256", "-keyout", str(key), *words,
        )  # fmt: skip


def _openssl(*words: str) -> None:
    try:
        done = subprocess.run(["openssl", *words], capture_output=True, text=True, check=False)
    except FileNotFoundError as error:
        raise InputError("openssl is not installed (apt install openssl)") from error
    if done.returncode:
        raise InputError(f"openssl {words[0]} has failed: {done.stderr.strip()}")


def make_keystore(folder: Path, namespace: str, domain: int) -> list[Path]:
    """Make a keystore with an enclave for every part.

    Parameters
    ----------
    folder : Path
        New, or empty.
    namespace : str
        Of the axlebox.
    domain : int
        `ROS_DOMAIN_ID` for which it is valid.

    Returns
    -------
    list of Path
        Folders of the enclaves.

    Raises
    ------
    InputError
        There is something in the folder, a number or name that cannot be, or openssl cannot do it.
    """
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise InputError(f"{folder}: is there already; give a new folder")
    if not 0 <= domain <= 232:
        raise InputError(f"domain {domain}: allowed are 0 to 232")
    if not all(part.isidentifier() for part in namespace.strip("/").split("/")):
        raise InputError(f"namespace '{namespace}': allowed are names of letters, digits, _ and / between")
    now, enclaves = datetime.now(UTC), folder / "enclaves"
    for name in ("public", "enclaves"):
        (folder / name).mkdir(parents=True)
    (folder / "private").mkdir(mode=0o700)
    authority = Authority(folder)
    rules = enclaves / "governance.xml"
    rules.write_text(governance(domain), encoding="utf-8")
    authority.sign(rules)
    made = []
    for part in RIGHTS:
        name = enclave_of(part, namespace)
        own = enclaves / name.strip("/")
        own.mkdir(parents=True)
        up = Path(*[".."] * len(own.relative_to(folder).parts))
        for which in ("identity", "permissions"):
            (own / f"{which}_ca.cert.pem").symlink_to(up / f"public/{which}_ca.cert.pem")
        (own / "governance.p7s").symlink_to(up / "enclaves/governance.p7s")
        authority.certify(name, own / "key.pem", own / "cert.pem")
        document = own / "permissions.xml"
        document.write_text(permissions(part, namespace, domain, now), encoding="utf-8")
        authority.sign(document)
        made.append(own)
    return made


def main(words: Sequence[str] | None = None) -> int:
    """Make a keystore or print the policy; gives the exit code."""
    parser = argparse.ArgumentParser(prog="python -m beardyn_ros.enclaves", description=__doc__)
    what = parser.add_subparsers(dest="what", required=True)
    keystore = what.add_parser("keystore", help="make keys, certificates and permissions")
    keystore.add_argument("folder", type=Path)
    keystore.add_argument(
        "--domain",
        type=int,
        default=int(os.environ.get("ROS_DOMAIN_ID") or 0),
        help="default ROS_DOMAIN_ID or 0",
    )
    for each in (keystore, what.add_parser("policy", help="print the rights for `ros2 security`")):
        each.add_argument("--namespace", default="axlebox", help="of the axlebox; default axlebox")
    args = parser.parse_args(words)
    if args.what == "policy":
        print(policy(args.namespace), end="")
        return 0
    try:
        made = make_keystore(args.folder, args.namespace, args.domain)
    except InputError as error:
        print(f"beardyn: {error}", file=sys.stderr)
        return EXIT_BAD_INPUT
    for own in made:
        print(f"/{own.relative_to(args.folder / 'enclaves').as_posix()}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
