"""What the classes of a plugin are derived from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from taceva._taceva import Deadline, Training
    from taceva.plugin import Pose, Reading


@dataclass(frozen=True)
class Arg:
    """What is known of an argument besides its type and its default, in ``Annotated[int, Arg(range=(0, 9))]``."""

    help: str = ""
    unit: str | None = None
    range: tuple[float, float] | None = None
    changes_facts: bool = False


class _Provided:
    """What a class says of itself in its head, in the words of the manifest."""

    kind: ClassVar[str] = ""
    said: ClassVar[dict[str, Any]] = {}

    def __init_subclass__(cls, **said: Any) -> None:
        super().__init_subclass__()
        cls.said = {**cls.said, **said}


class Device(_Provided):
    """A device. What its constructor takes are its arguments; their types and defaults are part of the manifest."""

    @classmethod
    def discover(cls) -> list[str]:
        """Return the arguments that choose each device that is present, such as ``["index=0"]``; none where it cannot look."""
        return []

    def close(self) -> None:
        """Give back what the device holds; called once, in every state."""


class _Streaming(Device):
    def start(self, deadline: Deadline) -> None:
        """Begin to send; where there is nothing to begin, do nothing."""

    def stop(self) -> None:
        """End what `start` began; called in every state."""


class Sensor(_Streaming):
    """Gives pictures of a gel.

    Its head says at least ``source`` and ``frame=(width, height, format)``, where ``format`` is ``"gray8"``, ``"rgb8"``, ``"gray16"`` or
    ``"rgb16"``: ``class Camera(Sensor, source="real", frame=(640, 480, "rgb8"), rate_hz=30)``.
    """

    kind = "sensor"

    def capture(self, into: npt.NDArray[Any], deadline: Deadline) -> float | tuple[float, float]:
        """Wait for the next picture, write it into ``into`` and return when it was taken, as ``taceva.plugin.now`` counts.

        ``into`` is ``[height, width]`` or ``[height, width, 3]`` in the order red, green, blue: assign to its elements (``into[:] = …``), which
        refuses a picture of another size. Wait by ``deadline.rest(seconds)``.
        """
        raise NotImplementedError(f"{type(self).__name__} has no capture(into, deadline)")


class Force(_Streaming):
    """Measures how hard is pressed.

    Its head says at least ``source`` and ``axes``: ``class Scale(Force, source="real", axes=["Fz"], rate_hz=100)``. With ``tare=True`` it has a
    method ``zero(deadline)`` that takes the present load as zero.
    """

    kind = "force"

    def read(self, deadline: Deadline) -> Reading:
        """Wait for the next reading; wait by ``deadline.rest(seconds)``."""
        raise NotImplementedError(f"{type(self).__name__} has no read(deadline)")


class Robot(Device):
    """Moves the tip that presses on the gel.

    Its head says at least ``source``; better also ``workspace={"least_mm": [x, y, z], "greatest_mm": [x, y, z]}`` and
    ``limits={"speed_max_mm_s": 50.0}``, which are held to before it is asked. Poses are in mm and degrees in the frame of the sensor, z into the gel.

    With ``guarded_motion=True`` it has a method ``move_guarded(target, speed, force, deadline)`` that stops by itself at ``force`` (N) and
    returns ``(pose, time)`` there, or the time alone where it arrived. A robot that stops within 0.2 s when its program stops sending has a
    method ``move_expiring(target, speed, deadline)``, which is used for motions towards a surface.
    """

    kind = "robot"

    def pose(self, deadline: Deadline) -> tuple[Pose, float | tuple[float, float]]:
        """Return where the tip is and when it was there; nothing moves."""
        raise NotImplementedError(f"{type(self).__name__} has no pose(deadline)")

    def move_to(self, target: Pose, speed: float, deadline: Deadline) -> float | tuple[float, float]:
        """Move the tip to ``target`` along a straight line at ``speed`` (mm/s), wait until it rests there, and return when it did.

        Wait by ``deadline.rest(seconds)``, which raises as soon as the robot is halted. Whatever this raises, `halt` is called after it.
        """
        raise NotImplementedError(f"{type(self).__name__} has no move_to(target, speed, deadline)")

    def halt(self) -> None:
        """Stop the motion: called from another thread while ``move_to`` waits, in every state, and more than once.

        No motion is asked for after it until `clear_halt`, and that is seen to before this is called.
        """
        raise NotImplementedError(f"{type(self).__name__} has no halt()")

    def clear_halt(self, deadline: Deadline) -> None:
        """Make the device ready to move after a halt; nothing moves. A fault of the device itself is left for a person to acknowledge."""


class Lighting(Device):
    """Sets the light around the sensor. Its head says at least ``source`` and ``scenes``."""

    kind = "lighting"

    def set(self, scene: str, deadline: Deadline) -> None:
        """Set the light called ``scene``, and return once it is steady."""
        raise NotImplementedError(f"{type(self).__name__} has no set(scene, deadline)")


class Changer(Device):
    """Brings specimens or units of a sensor into place. Its head says at least ``source`` and ``holds``, the names of what it holds."""

    kind = "changer"

    def bring(self, name: str, deadline: Deadline) -> str | None:
        """Bring what is called ``name`` into place; return the name of what its own signals say is there, or ``None`` where it has none.

        The robot is halted meanwhile; return once nothing moves any more.
        """
        raise NotImplementedError(f"{type(self).__name__} has no bring(name, deadline)")


@dataclass(frozen=True)
class Samples:
    """What an estimator learns from.

    ``features`` is ``[samples, height, width, depth]``, float32; ``targets`` is ``[samples, channels]``, float64, in mm and N; ``channels``
    are the names of its columns; ``groups`` are numbers of contact points, where they are known.
    """

    features: npt.NDArray[np.float32]
    targets: npt.NDArray[np.float64]
    channels: list[str]
    groups: npt.NDArray[np.uint32] | None = None

    @classmethod
    def of(cls, features: Any, targets: Any, channels: Sequence[str], groups: Any = None) -> Samples:
        """Make it of buffers."""
        return cls(
            np.asarray(features),
            np.asarray(targets),
            list(channels),
            None if groups is None else np.asarray(groups, np.uint32),
        )


class Estimator(_Provided):
    """Learns to read the pictures. What its constructor takes are its settings."""

    kind = "estimator"

    def fit(self, training: Samples, validation: Samples | None, progress: Training) -> None:
        """Learn from ``training``; ``progress.advance()`` raises where the fit should end."""
        raise NotImplementedError(f"{type(self).__name__} has no fit(training, validation, progress)")

    def predict(self, features: npt.NDArray[np.float32]) -> npt.ArrayLike:
        """Return ``[samples, channels]`` for ``[samples, height, width, depth]``."""
        raise NotImplementedError(f"{type(self).__name__} has no predict(features)")

    def save(self) -> bytes:
        """Return the model as bytes, the same for the same model. No pickle: whoever loads one runs what is in it."""
        raise NotImplementedError(f"{type(self).__name__} has no save()")

    @classmethod
    def load(cls, data: bytes, channels: list[str], shape: tuple[int, int, int]) -> Self:
        """Return the model that `save` made ``data`` of; raise for any other bytes."""
        raise NotImplementedError(f"{cls.__name__} has no load(data, channels, shape)")


