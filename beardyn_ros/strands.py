"""Which messages of a topic go on from each other: a stray stamp must not carry the others along.

A topic of a run is a strand of stamps at regular steps. A message belongs to the strand that it goes on
from. What goes on from none, such as a stamp of zero or of next year, begins a strand of its own, which
waits: it may be the beginning of the next run, the run itself behind a hole, or a stray.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from time import monotonic

from beardyn_core.record.messages import header_frame, header_stamp
from beardyn_core.record.topics import Topic
from beardyn_ros.source_time import LONGEST_ANNOUNCEMENT_S

STEP_NS = {"force": 2_500_000, "imu": 2_500_000, "shaft": 2_500_000, "joint_states": 5_000_000}
BLOCK_NS = 20_000_000
TEMPERATURE = "temperature"  # one message for each part, all of one stamp
TEMPERATURE_NS = 200_000_000
STEPS_OVER = 4  # steps that a message may be ahead and still goes on
HOLE_NS = 60_000_000_000  # within which the publisher that is followed goes on behind a hole
BEGINNING_NS = 25_000_000  # no run begins with a later stamp
BELIEVED_AFTER = 5  # messages that go on from each other
MOST_WAITING = 16  # strands of one topic
WEAK_FOR_S = 5.0  # how long a beginning of fewer messages holds against one that goes on
FORGOTTEN_AFTER_S = 10.0


@dataclass(frozen=True)
class Waiting:
    """A message that waits for a decision, with its place in the order of arrival."""

    serial: int
    entry: Topic
    cdr: bytes
    source: bytes = b""


@dataclass
class Strand:
    """Messages of one topic that go on from each other.

    Parameters
    ----------
    first_ns, last_ns : int
        Stamps, [ns].
    window_ns : int
        How far the next stamp may be ahead, [ns].
    begun, extended : int
        Order of arrival of its first and of its latest message.
    waiting : list of Waiting
        Those that no file has yet.
    source : bytes
        Publisher of its first message; empty where the middleware does not name it.
    """

    first_ns: int
    last_ns: int
    window_ns: int
    begun: int
    extended: int
    count: int = 0
    begun_at: float = field(default_factory=monotonic)
    extended_at: float = field(default_factory=monotonic)
    waiting: list[Waiting] = field(default_factory=list)
    source: bytes = b""
    _parts: set[str] = field(default_factory=set)

    def leap_to(self, name: str, stamp: int, cdr: bytes) -> int | None:
        """Compute how far ahead a message is, [ns]; ``None`` when it does not go on from here."""
        leap = stamp - self.last_ns
        if name == TEMPERATURE and leap == 0:
            return None if header_frame(cdr) in self._parts else 0
        return leap if 0 < leap <= self.window_ns else None

    def extend(self, name: str, stamp: int, cdr: bytes, serial: int) -> None:
        """Take a message as the next one."""
        if name == TEMPERATURE:
            if stamp != self.last_ns:
                self._parts.clear()
            self._parts.add(header_frame(cdr))
        self.last_ns, self.extended, self.extended_at = stamp, serial, monotonic()
        self.count += 1

    def may_begin_a_run(self, origin_ns: int) -> bool:
        """Check whether its first stamp is one that a run begins with: near 0, or near the origin of one."""
        return is_beginning(self.first_ns, 0) or is_beginning(self.first_ns, origin_ns)


def is_beginning(stamp_ns: int, origin_ns: int) -> bool:
    """Check whether a stamp is one of the first of a run, [ns]."""
    latest = BEGINNING_NS + round(1e9 * LONGEST_ANNOUNCEMENT_S if origin_ns else 0.0)
    return -BLOCK_NS <= stamp_ns - origin_ns <= latest


class TopicStrands:
    """Strands of one topic.

    Parameters
    ----------
    name : str
    origin_ns : int
        Earliest stamp of the present run: 0, or a time of the source of its load, [ns].

    Attributes
    ----------
    main, old : Strand or None
        Of the present run, and of the run before it.
    waiting : list of Strand
        Undecided, oldest first.
    """

    def __init__(self, name: str, origin_ns: int = 0) -> None:
        self.name = name
        self.origin_ns = origin_ns
        self.main: Strand | None = None
        self.old: Strand | None = None
        self.waiting: list[Strand] = []

    def take(self, message: Waiting, is_open: bool, refuse: Callable[[Waiting], None]) -> Strand:
        """Find the strand of a message and let it go on.

        Parameters
        ----------
        message : Waiting
        is_open : bool
            Whether there is a present run.
        refuse : callable
            Gets messages that are waited for no longer.
        """
        name, cdr, serial = self.name, message.cdr, message.serial
        stamp = header_stamp(cdr)
        old = None if self._is_after_the_old_run(stamp) else self.old
        known = [each for each in (old, self.main, *self.waiting) if each is not None]
        leaps = ((each.leap_to(name, stamp, cdr), (-each.count, -each.begun), each) for each in known)
        followed = [(leap, age, each) for leap, age, each in leaps if leap is not None]
        if followed:
            strand = min(followed, key=lambda found: found[:2])[2]
        elif self._goes_on_behind_a_hole(message.source, stamp):
            assert self.main is not None
            strand = self.main
        elif self._is_late_word_of_the_old_run(stamp):
            assert self.old is not None
            strand = self.old
        else:
            strand = Strand(stamp, stamp, STEPS_OVER * step_of(name), serial, serial, source=message.source)
            if is_open and self.main is None:
                self.main = strand
            else:
                self.waiting.append(strand)
                if len(self.waiting) > MOST_WAITING:
                    self._drop(self._least(), refuse)
        strand.extend(name, stamp, cdr, serial)
        return strand

    def is_believed(self, strand: Strand) -> bool:
        """Check whether a waiting strand is the run itself: it goes on, and the present one has stopped."""
        main = self.main
        if main is None or strand.count < BELIEVED_AFTER or main.extended > strand.begun:
            return False
        if not strand.may_begin_a_run(self.origin_ns) or strand.first_ns > main.last_ns:
            return True
        if main.count >= BELIEVED_AFTER:
            return False  # the next run, whose truth is under way
        return not main.may_begin_a_run(self.origin_ns) or monotonic() - strand.begun_at > WEAK_FOR_S

    def believe(self, strand: Strand) -> list[Waiting]:
        """Let a waiting strand be the run itself; gives what waits."""
        self.main = strand
        self.waiting.remove(strand)
        found, strand.waiting = strand.waiting, []
        return found

    def _goes_on_behind_a_hole(self, source: bytes, stamp: int) -> bool:
        """Check whether a message ahead is of the publisher that the present run is of."""
        main = self.main
        return (
            main is not None
            and bool(source)
            and source == main.source
            and 0 < stamp - main.last_ns <= HOLE_NS
        )

    def _is_late_word_of_the_old_run(self, stamp: int) -> bool:
        """Check whether a message behind a hole is of the run before, as no run begins with its stamp."""
        if self.main is not None or self.old is None or self._is_after_the_old_run(stamp):
            return False
        return stamp > max(self.old.last_ns, BEGINNING_NS)

    def _is_after_the_old_run(self, stamp: int) -> bool:
        """Check whether a stamp is of the present run, which has begun where the one before had ended."""
        if self.old is None or self.old.last_ns >= self.origin_ns:
            return False
        margin_ns = 0 if self.name in STEP_NS else BLOCK_NS  # a block begins before the first of its samples
        return stamp + margin_ns >= self.origin_ns

    def begin_run(
        self, refuse: Callable[[Waiting], None], was_open: bool, origin_ns: int = 0
    ) -> list[Waiting]:
        """Begin with the next run; gives what has come of it, the rest is refused."""
        self.old, self.main, self.origin_ns = self.main, None, origin_ns
        beginnings = [each for each in self.waiting if each.may_begin_a_run(origin_ns)]
        if beginnings:
            self.main = max(beginnings, key=lambda each: (each.count >= BELIEVED_AFTER, each.begun))
        elif self.waiting and not was_open:
            self.main = max(self.waiting, key=lambda each: each.count)
        found: list[Waiting] = []
        for each in self.waiting:
            if each is self.main:
                found, each.waiting = each.waiting, []
            else:
                self._refuse_all(each, refuse)
        self.waiting.clear()
        return found

    def end(self, refuse: Callable[[Waiting], None]) -> list[Waiting]:
        """Decide what waits at the end of a run; gives its tail, the rest is refused."""
        main = self.main
        found: list[Waiting] = []
        for each in self.waiting:
            stopped = main is not None and main.extended < each.begun
            weak = main is not None and main.count < min(each.count, BELIEVED_AFTER)
            begins = each.may_begin_a_run(self.origin_ns)
            if stopped and each.count > 1 and (weak or not begins) and not found:
                found = each.waiting
            else:
                self._refuse_all(each, refuse)
        self.waiting.clear()
        return found

    def forget_strays(self, refuse: Callable[[Waiting], None]) -> None:
        """Refuse short strands that nothing has come of for long."""
        since = monotonic() - FORGOTTEN_AFTER_S
        for each in [each for each in self.waiting if each.extended_at < since]:
            if each.count < BELIEVED_AFTER:
                self._drop(each, refuse)

    def _least(self) -> Strand:
        return min(self.waiting, key=lambda each: (each.count, each.begun))

    def _drop(self, strand: Strand, refuse: Callable[[Waiting], None]) -> None:
        self.waiting.remove(strand)
        self._refuse_all(strand, refuse)

    def _refuse_all(self, strand: Strand, refuse: Callable[[Waiting], None]) -> None:
        for message in strand.waiting:
            refuse(message)
        strand.waiting = []


def step_of(name: str) -> int:
    """Return the usual step of the stamps of a topic, [ns]."""
    return STEP_NS.get(name, TEMPERATURE_NS if name == TEMPERATURE else BLOCK_NS)
