"""`urdfkit bag`: print the topics of a recording."""

import argparse
import json

from urdfkit.cli.parser import HelpFormatter


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the subcommands."""
    parser.epilog = "examples:\n  urdfkit bag info run.mcap\n  urdfkit bag info lab.bag --json"
    subcommands = parser.add_subparsers(dest="subcommand", metavar="SUBCOMMAND", required=True)
    summary = "print duration, topics, types and numbers of messages of a recording"
    info = subcommands.add_parser("info", help=summary, description=summary, formatter_class=HelpFormatter)
    info.add_argument("file", metavar="FILE", help="a .mcap, .db3 or .bag file, or a folder of ros2 bag")
    info.add_argument("--json", action="store_true", help="print one JSON value")


def run(arguments: argparse.Namespace) -> int:
    """Print the content of a recording."""
    from urdfkit.bridges.bag_file import BagFile

    with BagFile(arguments.file) as bag:
        duration = bag.end - bag.begin
        if arguments.json:
            topics = [{"name": each.name, "type": each.type, "messages": each.messages} for each in sorted(bag.topics)]
            values = {"file": str(bag.path), "ros": bag.ros, "begin": bag.begin, "end": bag.end, "messages": bag.count}
            print(json.dumps({**values, "topics": topics}, indent=1))
            return 0
        print(f"{bag.path}: ROS {bag.ros}, {bag.count} messages in {duration:.3f} s, from {bag.begin:.3f} s")
        width = max((len(each.name) for each in bag.topics), default=0)
        kinds = max((len(each.type) for each in bag.topics), default=0)
        for topic in sorted(bag.topics):
            begin, end = bag.period(topic.name) if topic.messages > 1 else (0.0, 0.0)
            rate = f"{(topic.messages - 1) / (end - begin):8.2f} Hz" if end > begin else ""
            print(f"{topic.name:{width}}  {topic.type:{kinds}}  {topic.messages:7} {rate}".rstrip())
    return 0
