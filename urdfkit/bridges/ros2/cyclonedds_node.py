"""ROS 2 node by the ``cyclonedds`` wheel alone: its topics match those of real nodes with Fast DDS or Cyclone DDS.

Messages are written and read as CDR; the typed interface of the wheel takes 70 ms for an image.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from threading import Thread
from typing import Any

from urdfkit.bridges.node.node import Done, End, Quality, UnknownTypeError
from urdfkit.bridges.ros2.cyclonedds_types import hide_type_information, idl_type, ignore_type_lookups
from urdfkit.bridges.ros2.environment import on_this_machine
from urdfkit.bridges.service import Service
from urdfkit.errors import ResourceError
from urdfkit.messages import typestore
from urdfkit.messages.conversion import decode_cdr, encode_cdr

WAIT = 0.5
"""Seconds between two checks whether the node is closed."""
DISCOVERED = 10_000
"""Publishers that are listed."""
BATCH = 100
"""Messages read at once."""
SILENT = '<CycloneDDS><Domain Id="any"><Tracing><OutputFile>/dev/null</OutputFile></Tracing></Domain></CycloneDDS>'
"""Cyclone DDS would report the type information of other participants that it cannot read."""
LOCALHOST = """\
<CycloneDDS><Domain Id="any"><Tracing><OutputFile>/dev/null</OutputFile></Tracing>
<General><AllowMulticast>false</AllowMulticast><MaxMessageSize>65000B</MaxMessageSize><FragmentSize>64000B</FragmentSize>
<Interfaces><NetworkInterface address="127.0.0.1"/></Interfaces></General>
<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>99</MaxAutoParticipantIndex>
<Peers><Peer address="127.0.0.1"/></Peers></Discovery></Domain></CycloneDDS>"""
"""Discovery on this machine: without multicast, participants are searched for at the loopback ports of their
indices. Datagrams are as large as the loopback interface allows: with the default, 14,720 bytes in fragments of 1,344,
a reliable subscriber with Fast DDS received 6 instead of 29 images of 1.9 MB per second."""


class CycloneddsNode:
    """A participant of a domain.

    Args:
        domain: the ROS domain.
        environment: variables of the process.

    Raises:
        ResourceError: the domain cannot be joined.
    """

    description, ros, option = "cyclonedds", "ROS 2", "--ros2"

    def __init__(self, domain: int, environment: Mapping[str, str] = os.environ) -> None:
        from cyclonedds.core import DDSException, WaitSet
        from cyclonedds.domain import Domain, DomainParticipant

        configured = environment.get("CYCLONEDDS_URI")
        try:
            self._domain = Domain(domain, configured or (LOCALHOST if on_this_machine(environment) else SILENT))
            self._participant = DomainParticipant(domain)
            ignore_type_lookups(self._participant)
        except DDSException as error:
            reason = (
                f"Cyclone DDS cannot use the configuration CYCLONEDDS_URI={configured}"
                if configured
                else "Cyclone DDS finds no network interface that is up, or no free participant index"
            )
            raise ResourceError(f"cannot join ROS domain {domain}: {reason}") from error
        self._entities: list[Any] = []
        self._discovered: list[Any] = []
        self._topics: dict[str, str] = {}
        self._readers: tuple[tuple[Any, Callable[[bytes], None]], ...] = ()
        self._received, self._closed = WaitSet(self._participant), False
        self._thread = Thread(target=self._read, name="cyclonedds", daemon=True)
        self._thread.start()

    def writer(self, topic: str, type: str, quality: Quality) -> _CycloneddsWriter:
        """Create a publisher."""
        from cyclonedds.pub import DataWriter

        writer = DataWriter(self._participant, self._topic(topic, type), qos=_policies(quality))
        self._entities.append(writer)
        return _CycloneddsWriter(writer)

    def subscribe(self, topic: str, type: str, quality: Quality, receive: Callable[[bytes], None]) -> End:
        """Call `receive`, in the thread of the readers, with each message in CDR."""
        from cyclonedds.core import InstanceState, ReadCondition, SampleState, ViewState
        from cyclonedds.sub import DataReader

        reader = DataReader(self._participant, self._topic(topic, type), qos=_policies(quality))
        condition = ReadCondition(reader, SampleState.NotRead | ViewState.Any | InstanceState.Any)
        self._entities += (reader, condition)
        self._readers = (*self._readers, (reader, receive))
        self._received.attach(condition)

        def end() -> None:
            self._readers = tuple(each for each in self._readers if each[0] is not reader)
            self._received.detach(condition)
            self._entities = [each for each in self._entities if each not in (reader, condition)]

        return end

    def topics(self) -> dict[str, str]:
        """Return topic → type of the participants of the domain; they are discovered within a second."""
        self._topics.update(self._used())
        return dict(sorted(self._topics.items()))

    def types(self) -> dict[str, set[str]]:
        """Return topic → types of its publishers and subscribers."""
        found: dict[str, set[str]] = {}
        for name, type in self._used():
            found.setdefault(name, set()).add(type)
        return found

    def _used(self) -> Iterator[tuple[str, str]]:
        """Yield topic and type of each publisher and subscriber."""
        if not self._discovered:
            from cyclonedds.builtin import BuiltinDataReader, BuiltinTopicDcpsPublication, BuiltinTopicDcpsSubscription

            kinds = BuiltinTopicDcpsPublication, BuiltinTopicDcpsSubscription
            self._discovered = [BuiltinDataReader(self._participant, kind) for kind in kinds]
        for each in self._discovered:
            for sample in each.read(N=DISCOVERED):
                # A publisher that has left the graph is a sample without a name.
                if (sample.topic_name or "").startswith("rt/"):
                    type = sample.type_name.replace("::dds_::", "/").replace("::", "/").removesuffix("_")
                    yield sample.topic_name[2:], type

    def serve(self, service: Service, call: Callable[[Any, Done], None]) -> None:
        """Refuse the service: Cyclone DDS for Python has none.

        Raises:
            UnknownTypeError: always.
        """
        raise UnknownTypeError(f"Cyclone DDS does not serve {service.name}; rclpy does")

    def services(self) -> list[str]:
        """Refuse: Cyclone DDS for Python has no services.

        Raises:
            UnknownTypeError: always.
        """
        raise UnknownTypeError(
            "Cyclone DDS does not support services; they need rclpy: source a ROS 2 workspace, or pip install ros-rclpy"
        )

    def service_type(self, service: str) -> str:
        """Refuse, as `services` does."""
        return self.services()[0]

    def call(self, service: str, type: str, fields: Any) -> Any:
        """Refuse, as `services` does."""
        return self.services()

    encode, decode = staticmethod(encode_cdr), staticmethod(decode_cdr)

    def close(self) -> None:
        """Leave the domain."""
        self._closed = True
        self._thread.join(2 * WAIT)
        self._entities.clear()
        self._discovered.clear()
        del self._received, self._participant, self._domain

    def _read(self) -> None:
        """Read arrived messages. Callbacks of the library would deadlock with writers, which hold Python's lock."""
        from cyclonedds._clayer import ddspy_take
        from cyclonedds.core import InstanceState, SampleState, ViewState

        mask = SampleState.Any | ViewState.Any | InstanceState.Any
        while not self._closed:
            if not self._received.wait(round(WAIT * 1e9)):
                continue
            for reader, receive in self._readers:
                taken = ddspy_take(reader._ref, mask, BATCH)
                for data, sample in taken if isinstance(taken, list) else ():
                    if sample.valid_data:
                        receive(bytes(data))

    def _topic(self, topic: str, type: str) -> Any:
        from cyclonedds.topic import Topic

        if type not in typestore().fielddefs:
            raise UnknownTypeError(f"no message type `{type}`")
        made = Topic(self._participant, f"rt{topic}", idl_type(type))
        hide_type_information(made)
        return made


class _CycloneddsWriter:
    def __init__(self, writer: Any) -> None:
        from cyclonedds._clayer import ddspy_write

        self._writer, self._write = writer, ddspy_write

    def publish(self, data: bytes) -> None:
        """Publish a message, padded to whole words as Cyclone DDS requires; dropped if a subscriber is too slow."""
        self._write(self._writer._ref, data.ljust(-(-len(data) // 4) * 4, b"\0"))

    def is_matched(self) -> bool:
        """Return whether there is a subscriber."""
        return bool(self._writer.get_matched_subscriptions())


def _policies(quality: Quality) -> Any:
    from cyclonedds.qos import Policy, Qos

    reliability = Policy.Reliability.Reliable(0) if quality.reliable else Policy.Reliability.BestEffort
    durability = Policy.Durability.TransientLocal if quality.latched else Policy.Durability.Volatile
    return Qos(
        reliability,
        durability,
        Policy.History.KeepLast(quality.depth),
        Policy.DataRepresentation(use_cdrv0_representation=True),
    )
