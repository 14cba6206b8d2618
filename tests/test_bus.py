import pytest

from urdfkit.bus import Bus, absolute
from urdfkit.errors import UsageError


@pytest.mark.parametrize(("name", "full"), [("a", "/a"), ("/a", "/a"), ("//a//b/", "/a/b"), ("a/b", "/a/b"), ("", "/")])
def test_names_become_absolute(name: str, full: str) -> None:
    assert absolute(name) == full


def test_subscribers_hear_in_order_until_they_close() -> None:
    bus, heard = Bus(), []
    first = bus.subscribe("a", "T", lambda message: heard.append(("first", message)))
    bus.subscribe("/a", "T", lambda message: heard.append(("second", message)))
    bus.publish("a", "T", 1)
    first.close()
    first.close()
    bus.publish("a", "T", 2)
    assert heard == [("first", 1), ("second", 1), ("second", 2)]
    assert (bus.topics[0].count, bus.latest("a")) == (2, 2)


def test_the_repr_of_a_subscription_names_its_topic_and_state() -> None:
    subscription = Bus().subscribe("odom", "nav_msgs/Odometry", print)
    assert repr(subscription) == "<Subscription to /odom [nav_msgs/msg/Odometry]>"
    subscription.close()
    assert repr(subscription) == "<Subscription to /odom [nav_msgs/msg/Odometry], closed>"


def test_a_topic_has_one_type() -> None:
    bus = Bus()
    bus.advertise("a", "T")
    with pytest.raises(UsageError, match="topic `/a` has type T, not U"):
        bus.publish("a", "U", 1)


def test_an_offer_nobody_hears_is_built_on_first_look_and_only_once() -> None:
    bus, built = Bus(), []
    topic = bus.advertise("a", "T")
    topic.offer(lambda: built.append("x") or "x", count=3)
    assert (topic.count, built) == (3, [])
    assert topic.latest == "x"
    assert topic.latest == "x"
    assert built == ["x"]
    topic.offer(lambda: "never looked at")
    topic.offer(lambda: "y")
    assert (bus.latest("a"), topic.count) == ("y", 5)


def test_an_offer_somebody_hears_is_a_message() -> None:
    bus, heard = Bus(), []
    topic = bus.advertise("a", "T")
    bus.subscribe("a", "T", heard.append)
    topic.offer(lambda: "x")
    assert (heard, topic.latest, topic.count) == (["x"], "x", 1)
    assert bus.has_subscribers("a")
    assert not bus.has_subscribers("b")


def test_a_message_replaces_an_offer() -> None:
    bus = Bus()
    bus.advertise("a", "T").offer(lambda: "old")
    bus.publish("a", "T", "new")
    assert bus.latest("a") == "new"
    assert bus.latest("never heard of") is None


def test_types_may_be_named_as_in_ros_1() -> None:
    bus, heard = Bus(), []
    topic = bus.advertise("/odom", "nav_msgs/msg/Odometry")
    bus.subscribe("/odom", "nav_msgs/Odometry", heard.append)
    bus.publish("/odom", "nav_msgs/Odometry", 1)
    assert heard == [1]
    assert bus.advertise("/new", "std_msgs/Bool").type == "std_msgs/msg/Bool"
    assert topic.type == "nav_msgs/msg/Odometry"


def test_a_message_that_takes_long_is_built_once_by_whoever_needs_it() -> None:
    bus, built, heard, builders = Bus(), [], [], []
    topic = bus.advertise("a", "T")
    waiting = bus.subscribe("a", "T", heard.append, defer=builders.append)
    topic.offer_later(lambda: built.append("x") or "x", count=2)
    assert (topic.count, built, heard) == (2, [], [])
    assert (builders.pop()(), bus.latest("a"), built) == ("x", "x", ["x"])
    bus.subscribe("a", "T", lambda message: heard.append(("now", message)))
    topic.offer_later(lambda: built.append("y") or "y")
    assert (heard, builders[0](), built, topic.count) == ([("now", "y")], "y", ["x", "y"], 3)
    topic.publish("z")
    assert heard[1:] == ["z", ("now", "z")]
    waiting.close()
    topic.offer_later(lambda: "w")
    assert (heard[-1], len(builders)) == (("now", "w"), 1)
