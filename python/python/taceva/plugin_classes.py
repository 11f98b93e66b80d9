"""Base classes of the devices and estimators of a plugin."""

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
    """Properties of an argument other than its type and default, in ``Annotated[int, Arg(range=(0, 9))]``."""

    help: str = ""
    unit: str | None = None
    range: tuple[float, float] | None = None
    changes_facts: bool = False


class _Provided:
    """Facts from the keyword arguments of a class, with the names of the manifest."""

    kind: ClassVar[str] = ""
    said: ClassVar[dict[str, Any]] = {}

    def __init_subclass__(cls, **said: Any) -> None:
        super().__init_subclass__()
        cls.said = {**cls.said, **said}


class Device(_Provided):
    """A device. The parameters of its constructor are its arguments; their types and defaults are part of the manifest."""

    @classmethod
    def discover(cls) -> list[str]:
        """Return the arguments that select each present device, such as ``["index=0"]``; empty if devices cannot be listed."""
        return []

    def close(self) -> None:
        """Release the device; called once, in any state."""


class _Streaming(Device):
    def start(self, deadline: Deadline) -> None:
        """Start the stream, if the device has one."""

    def stop(self) -> None:
        """Stop the stream that `start` began; called in any state."""


class Sensor(_Streaming):
    """Camera of a gel.

    A subclass declares at least ``source`` and ``frame=(width, height, format)``, where ``format`` is ``"gray8"``, ``"rgb8"``, ``"gray16"`` or
    ``"rgb16"``: ``class Camera(Sensor, source="real", frame=(640, 480, "rgb8"), rate_hz=30)``.
    """

    kind = "sensor"

    def capture(self, into: npt.NDArray[Any], deadline: Deadline) -> float | tuple[float, float]:
        """Wait for the next frame, write it into ``into`` and return its time, on the clock of ``taceva.plugin.now``.

        ``into`` is ``[height, width]`` or ``[height, width, 3]`` in the order red, green, blue. Assign to its elements (``into[:] = …``), which
        rejects a frame of another size. Wait with ``deadline.rest(seconds)``.
        """
        raise NotImplementedError(f"{type(self).__name__} has no capture(into, deadline)")


class Force(_Streaming):
    """Force transducer.

    A subclass declares at least ``source`` and ``axes``: ``class Scale(Force, source="real", axes=["Fz"], rate_hz=100)``. With ``tare=True`` it
    also has a method ``zero(deadline)`` that sets the present load to zero.
    """

    kind = "force"

    def read(self, deadline: Deadline) -> Reading:
        """Wait for the next reading with ``deadline.rest(seconds)``, and return it in N and N·mm; Fz above 0 presses into the gel."""
        raise NotImplementedError(f"{type(self).__name__} has no read(deadline)")


class Robot(Device):
    """Robot that moves the tip.

    A subclass declares at least ``source``. Also declare ``workspace={"least_mm": [x, y, z], "greatest_mm": [x, y, z]}`` and
    ``limits={"speed_max_mm_s": 50.0}``: they are checked before each call. Poses are in mm and degrees in the frame of the sensor, z into the gel.

    With ``guarded_motion=True`` it has a method ``move_guarded(target, speed, force, deadline)`` that stops by itself at ``force`` (N). The method
    returns ``(pose, time)`` of that stop, or only the time if the tip reached the target. A robot that stops within 0.2 s after its program stops
    sending has a method ``move_expiring(target, speed, deadline)`` for motions towards a surface.
    """

    kind = "robot"

    def pose(self, deadline: Deadline) -> tuple[Pose, float | tuple[float, float]]:
        """Return the pose of the tip and its time, without moving."""
        raise NotImplementedError(f"{type(self).__name__} has no pose(deadline)")

    def move_to(self, target: Pose, speed: float, deadline: Deadline) -> float | tuple[float, float]:
        """Move the tip to ``target`` along a straight line at ``speed`` (mm/s), wait until it rests there, and return the time of arrival.

        Wait with ``deadline.rest(seconds)``, which raises as soon as the robot is halted. After any exception of this method, `halt` is called.
        """
        raise NotImplementedError(f"{type(self).__name__} has no move_to(target, speed, deadline)")

    def halt(self) -> None:
        """Stop the motion. Called from another thread while ``move_to`` waits, in any state, and more than once.

        No motion is requested from just before this call until `clear_halt`.
        """
        raise NotImplementedError(f"{type(self).__name__} has no halt()")

    def clear_halt(self, deadline: Deadline) -> None:
        """Make the device ready to move after a halt, without moving. A fault of the device stays until an operator acknowledges it."""


class Lighting(Device):
    """Lighting around the sensor. A subclass declares at least ``source`` and ``scenes``."""

    kind = "lighting"

    def set(self, scene: str, deadline: Deadline) -> None:
        """Set the light to ``scene``, and return once it is steady."""
        raise NotImplementedError(f"{type(self).__name__} has no set(scene, deadline)")


class Changer(Device):
    """Device that brings specimens or units of a sensor into place. A subclass declares at least ``source`` and ``holds``, the names of the items."""

    kind = "changer"

    def bring(self, name: str, deadline: Deadline) -> str | None:
        """Bring ``name`` into place. Return the name that the device senses, or ``None`` if the device cannot sense the name.

        The robot is halted meanwhile. Return once all motion has ended.
        """
        raise NotImplementedError(f"{type(self).__name__} has no bring(name, deadline)")


@dataclass(frozen=True)
class Samples:
    """Samples that an estimator is fitted on.

    ``features`` is ``[samples, height, width, depth]``, float32. ``targets`` is ``[samples, channels]``, float64, in mm and N. ``channels``
    has the names of the columns of ``targets``. ``groups`` has the number of the contact point of each sample, if known.
    """

    features: npt.NDArray[np.float32]
    targets: npt.NDArray[np.float64]
    channels: list[str]
    groups: npt.NDArray[np.uint32] | None = None

    @classmethod
    def of(cls, features: Any, targets: Any, channels: Sequence[str], groups: Any = None) -> Samples:
        """Create samples from buffers."""
        return cls(
            np.asarray(features),
            np.asarray(targets),
            list(channels),
            None if groups is None else np.asarray(groups, np.uint32),
        )


class Estimator(_Provided):
    """Model that predicts labels from frames. The parameters of its constructor are its settings."""

    kind = "estimator"

    def fit(self, training: Samples, validation: Samples | None, progress: Training) -> None:
        """Fit on ``training``. ``validation`` has samples for choosing settings, or is ``None``; ``progress.advance()`` raises on cancellation."""
        raise NotImplementedError(f"{type(self).__name__} has no fit(training, validation, progress)")

    def predict(self, features: npt.NDArray[np.float32]) -> npt.ArrayLike:
        """Return ``[samples, channels]`` in mm and N, in the order of the channels of the fit, for features ``[samples, height, width, depth]``."""
        raise NotImplementedError(f"{type(self).__name__} has no predict(features)")

    def save(self) -> bytes:
        """Return the model as bytes, equal for equal models. Do not use pickle: loading a pickle can run any code."""
        raise NotImplementedError(f"{type(self).__name__} has no save()")

    @classmethod
    def load(cls, data: bytes, channels: list[str], shape: tuple[int, int, int]) -> Self:
        """Return the model that `save` wrote to ``data``; raise for any other bytes."""
        raise NotImplementedError(f"{cls.__name__} has no load(data, channels, shape)")


