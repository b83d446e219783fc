"""Enclaves of SROS 2: the rights are those that the nodes need, and strangers are refused."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import time
from fnmatch import fnmatchcase
from functools import partial
from importlib import import_module
from pathlib import Path
from xml.etree import ElementTree

import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.record.topics import TOPICS
from beardyn_ros.enclaves import (
    READER,
    RIGHTS,
    absolute,
    enclave_of,
    full_rights,
    main,
    make_keystore,
    policy,
)
from beardyn_ros.processes import Processes, free_domain_id, release_domain_id
from test.ros.graph import Graph
from test.ros.test_recorder import is_connected

SPACE = "axlebox"
PEER = Path(__file__).with_name("secure_peer.cpp")
FORCE = "rt/axlebox/force"
LINKS = ("identity_ca.cert.pem", "permissions_ca.cert.pem", "governance.p7s")
needs_openssl = pytest.mark.skipif(
    shutil.which("openssl") is None, reason="openssl is not installed (apt install openssl)"
)


def openssl(*words: str) -> str:
    done = subprocess.run(["openssl", *words], capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == 0, done.stderr
    return done.stdout


def allowed(names: tuple[str, ...], name: str) -> bool:
    return any(fnmatchcase(name, rule) for rule in absolute(names, SPACE))


# --- rights --------------------------------------------------------------------------------------------


def test_every_topic_of_the_table_has_who_publishes_it_and_is_recorded() -> None:
    for entry in TOPICS:
        name = entry.path()
        assert [part for part in RIGHTS if allowed(full_rights(part).publish, name)], f"{name} by nobody"
        for part in ("recorder", READER):
            assert allowed(full_rights(part).subscribe, name), f"{part} may not receive {name}"


def test_no_node_has_more_than_it_needs() -> None:
    for part in ("load", "recorder", "monitor", "follower", READER):
        for name in ("force", "vibration", "truth", "load/consumed", "/clock"):
            assert not allowed(full_rights(part).publish, *absolute((name,), SPACE)), (part, name)
    for part in ("monitor", "follower"):  # what a train has not
        for name in ("truth", "bodies", "contacts", "joint_states", "load/truth"):
            assert not allowed(full_rights(part).subscribe, *absolute((name,), SPACE)), (part, name)
    assert not RIGHTS[READER].publish


def test_nodes_of_a_run_have_the_rights_for_all_that_they_do(graph: Graph) -> None:
    graph.fake_twin()
    graph.node_process("recorder", output=str(graph.folder / "run.mcap"))
    for part in ("monitor", "follower"):
        graph.node_process(part)
    for part in ("recorder", "monitor", "follower"):
        is_connected(graph, part)
    graph.fake_load(duration=3600.0)
    graph.until_state("running")
    parts = [part for part in RIGHTS if part != READER]
    here = {(part, f"/{SPACE}") for part in parts}
    graph.until(lambda: here <= set(graph.node.get_node_names_and_namespaces()), "the five nodes")

    def last_service(part: str) -> bool:
        own = graph.node.get_service_names_and_types_by_node(part, f"/{SPACE}")
        return any(name.endswith("/get_type_description") for name, _ in own)

    for part in parts:
        graph.until(partial(last_service, part), f"services of {part}")
        rights = full_rights(part)
        for names, asked in (
            (rights.publish, graph.node.get_publisher_names_and_types_by_node),
            (rights.subscribe, graph.node.get_subscriber_names_and_types_by_node),
            (rights.serve, graph.node.get_service_names_and_types_by_node),
        ):
            found = [name for name, _ in asked(part, f"/{SPACE}")]
            assert found
            assert [name for name in found if not allowed(names, name)] == [], f"{part} has no right"
        assert graph.node.get_client_names_and_types_by_node(part, f"/{SPACE}") == []


# --- files ---------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def keystore(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A keystore for a domain that nobody else here uses."""
    folder = tmp_path_factory.mktemp("keystore") / "keys"
    make_keystore(folder, SPACE, 7)
    return folder


@needs_openssl
@pytest.mark.parametrize("part", RIGHTS)
def test_certificates_and_signed_documents_are_valid(part: str, keystore: Path) -> None:
    authority = str(keystore / "public/ca.cert.pem")
    own = keystore / "enclaves" / SPACE / part
    openssl("verify", "-CAfile", authority, str(own / "cert.pem"))
    subject = openssl("x509", "-in", str(own / "cert.pem"), "-noout", "-subject", "-nameopt", "RFC2253")
    assert subject.strip() == f"subject=CN={enclave_of(part, SPACE)}"
    key = openssl("pkey", "-in", str(own / "key.pem"), "-pubout")
    assert key == openssl("x509", "-in", str(own / "cert.pem"), "-noout", "-pubkey")
    for name in ("permissions", "governance"):
        text = openssl("smime", "-verify", "-text", "-in", str(own / f"{name}.p7s"), "-CAfile", authority)
        root = ElementTree.fromstring(text)
        assert [each.text for each in root.iter("id")] == ["7"]
    signed = openssl("smime", "-verify", "-text", "-in", str(own / "permissions.p7s"), "-CAfile", authority)
    grant = ElementTree.fromstring(signed).find("permissions/grant")
    assert grant is not None
    assert grant.findtext("subject_name") == f"CN={enclave_of(part, SPACE)}"
    assert grant.findtext("default") == "DENY"
    assert all((own / name).resolve().is_file() for name in LINKS)
    assert (own / "key.pem").stat().st_mode & 0o077 == 0
    assert (keystore / "private").stat().st_mode & 0o077 == 0


@needs_openssl
def test_a_document_that_was_changed_is_no_longer_valid(keystore: Path, tmp_path: Path) -> None:
    own = keystore / "enclaves" / SPACE / "monitor"
    changed = tmp_path / "permissions.p7s"
    changed.write_bytes((own / "permissions.p7s").read_bytes().replace(b"monitor/result", b"monitor/rEsult"))
    command = [
        "openssl",
        "smime",
        "-verify",
        "-in",
        str(changed),
        "-CAfile",
        str(keystore / "public/ca.cert.pem"),
    ]
    assert subprocess.run(command, capture_output=True, check=False, timeout=60).returncode != 0


@needs_openssl
def test_a_keystore_replaces_nothing_and_bad_words_are_sentences(
    keystore: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["keystore", str(keystore)]) == 2
    assert f"{keystore}: is there already" in capsys.readouterr().err
    for namespace, domain in (("a b", 0), ("", 0), ("axlebox", 233), ("axlebox", -1)):
        with pytest.raises(InputError):
            make_keystore(tmp_path / "new", namespace, domain)
    assert not (tmp_path / "new").exists()
    assert main(["keystore", str(tmp_path / "car"), "--namespace", "car/axle_1_left", "--domain", "3"]) == 0
    assert "/car/axle_1_left/twin" in capsys.readouterr().out
    assert (tmp_path / "car/enclaves/car/axle_1_left/twin/governance.p7s").resolve().is_file()


def test_the_policy_for_ros2_security_has_the_same_rights() -> None:
    root = ElementTree.fromstring(policy(SPACE))
    assert root.get("version") == "0.2.0"
    for enclave in root.iter("enclave"):
        part = str(enclave.get("path")).rpartition("/")[2]
        rights = full_rights(part)
        for verb, names in (
            ("publish", rights.publish),
            ("subscribe", rights.subscribe),
            ("reply", rights.serve),
        ):
            (listed,) = enclave.iterfind(f"profiles/profile/*[@{verb}='ALLOW']")
            assert [each.text for each in listed] == absolute(names, SPACE)
    assert len(list(root.iter("enclave"))) == len(RIGHTS)


@needs_openssl
def test_permissions_are_those_that_sros2_makes_of_the_policy(keystore: Path) -> None:
    from beardyn_ros.environment import prepare_environment

    prepare_environment()
    pytest.importorskip("sros2", reason="sros2 is not installed (apt install ros-$ROS_DISTRO-sros2)")
    from lxml import etree

    template = import_module("sros2.policy").get_transport_template("dds", "permissions.xsl")
    transform = etree.XSLT(etree.parse(str(template)))
    made = transform(etree.fromstring(policy(SPACE).encode()), allow_ros_discovery_topic="1")
    grants = {str(each.get("name")): each for each in made.iter("grant")}
    assert set(grants) == {enclave_of(part, SPACE) for part in RIGHTS}
    for name, grant in grants.items():
        own = etree.parse(str(keystore / f"enclaves{name}/permissions.xml")).find("permissions/grant")
        for verb in ("publish", "subscribe"):
            path = f"allow_rule/{verb}/topics/topic"
            assert {each.text for each in own.iterfind(path)} == {each.text for each in grant.iterfind(path)}


# --- security on ---------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def peer(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A DDS participant of a Fast DDS that has security."""
    program = tmp_path_factory.mktemp("peer") / "peer"
    if shutil.which("g++") is None:
        pytest.skip("there is no compiler (apt install g++)")
    command = ["g++", "-std=c++17", "-o", str(program), str(PEER), "-lfastrtps", "-lfastcdr"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=300)
    if done.returncode:
        pytest.skip("Fast DDS 2 with its headers is not installed (apt install libfastrtps-dev)")
    return program


class Peers:
    """Participants in a domain, and what each has written so far."""

    def __init__(self, program: Path, folder: Path, domain: int) -> None:
        self._program, self._folder, self._domain = program, folder, domain
        self._running: list[subprocess.Popen[bytes]] = []

    def start(self, name: str, role: str, topic: str, *enclave: Path) -> None:
        command = [str(self._program), role, topic, str(self._domain), *map(str, enclave)]
        # the profile is one of Fast DDS 3, and the libraries in the path are those of the wheels
        own = {key: value for key, value in os.environ.items() if not key.startswith(("FAST", "LD_LIBRARY"))}
        with (self._folder / name).open("wb") as log:
            self._running.append(subprocess.Popen(command, env=own, stdout=log, stderr=log))

    def lines(self, name: str) -> list[str]:
        return (self._folder / name).read_text(errors="replace").splitlines()

    def end(self) -> None:
        for each in self._running:
            each.kill()
            each.wait()


def until(peers: Peers, name: str, line: str, count: int = 1) -> None:
    deadline = time.monotonic() + 60.0
    while peers.lines(name).count(line) < count:
        assert time.monotonic() < deadline, f"{name}: {peers.lines(name)}"
        time.sleep(0.05)


@needs_openssl
def test_with_security_on_nodes_talk_and_strangers_are_refused(peer: Path, tmp_path: Path) -> None:
    domain = free_domain_id()
    peers = Peers(peer, tmp_path, domain)
    try:
        make_keystore(tmp_path / "keys", SPACE, domain)
        make_keystore(tmp_path / "others", SPACE, domain)
        own, others = tmp_path / "keys/enclaves" / SPACE, tmp_path / "others/enclaves" / SPACE
        peers.start("stranger", "subscribe", FORCE)
        peers.start("of_another_authority", "subscribe", FORCE, others / "recorder")
        for name in ("stranger", "of_another_authority"):
            until(peers, name, "ready")
        peers.start("monitor", "publish", FORCE, own / "monitor")
        until(peers, "monitor", "endpoint refused")
        peers.start("reader", "publish", "rt/axlebox/load/wrench", own / READER)
        until(peers, "reader", "endpoint refused")
        peers.start("recorder", "subscribe", FORCE, own / "recorder")
        until(peers, "recorder", "ready")
        peers.start("twin", "publish", FORCE, own / "twin")
        until(peers, "recorder", "received", 100)
        for name in ("stranger", "of_another_authority"):
            assert "received" not in peers.lines(name)
        peers.start("false_twin", "publish", FORCE)
        until(peers, "stranger", "received", 20)  # the false twin is there, for who has no security
        assert peers.lines("recorder").count("matched") == 1, "the false twin was matched"
        assert "received" not in peers.lines("of_another_authority")
    finally:
        peers.end()
        release_domain_id(domain)


@needs_openssl
def test_a_node_whose_middleware_has_no_security_does_not_start_without_it(tmp_path: Path) -> None:
    pytest.importorskip("rclpy", reason="rclpy is not installed (pip install .[ros])")
    from beardyn_ros.environment import prepare_environment

    prepare_environment()
    domain = free_domain_id()
    try:
        make_keystore(tmp_path / "keys", SPACE, domain)
        secured = {
            **os.environ,
            "ROS_DOMAIN_ID": str(domain),
            "ROS_SECURITY_ENABLE": "true",
            "ROS_SECURITY_STRATEGY": "Enforce",
            "ROS_SECURITY_KEYSTORE": str(tmp_path / "keys"),
        }
        with Processes(secured, tmp_path) as processes:
            words = ("-m", "beardyn_ros", "recorder", "--ros-args", "--enclave", "/axlebox/recorder")
            processes.start(
                "recorder", *words, "-p", "start_timeout:=1.0", "-p", f"output:={tmp_path}/r.mcap"
            )
            code = processes.wait("recorder", 60.0)
            log = processes.log("recorder")
            assert "Found security directory" in log
            if "security libraries" not in log:
                pytest.skip("this Fast DDS has security: the node has started with it")
            assert code == 2, log
            assert "Traceback" not in log
            assert re.search(r"^beardyn: the node cannot be made: .*security libraries", log, re.M)
    finally:
        release_domain_id(domain)
