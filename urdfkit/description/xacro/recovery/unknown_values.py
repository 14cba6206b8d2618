"""Unknown values: what stands for a value that could not be computed, and the failure to compute with it."""

from urdfkit.description.xacro.evaluation.failures import Failure


class Unknown(str):
    """A value that could not be computed; its text is the expression."""

    __slots__ = ()


class Recorded(Failure):
    """A failure whose cause is recorded already.

    Args:
        name: what an expression reads an unknown value by: a property, or ``arg`` and an argument.
        value: that value.
    """

    def __init__(self, name: str = "", value: str = "") -> None:
        super().__init__("other", "")
        self.name, self.value = name, value


class Arguments(dict[str, str]):
    """The values of ``$(arg …)``, some of which may be unknown."""

    def __getitem__(self, name: str) -> str:
        """Return a value.

        Raises:
            Recorded: it is unknown.
        """
        value = super().__getitem__(name)
        if type(value) is Unknown:
            raise Recorded(f"arg {name}", value)
        return value
