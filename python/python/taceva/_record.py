"""New recordings from arrays and from folders of other programs."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from taceva import _taceva
from taceva._arrays import column_order, in_order, numbers, real, with_units
from taceva._arrays import points as names_of_points
from taceva._bar import bar
from taceva._column_names import beside, named_columns
from taceva._counted import counted
from taceva._dataset import Dataset
from taceva._metrics import SIX


def from_arrays(
    path: str | os.PathLike[str],
    labels: Any,
    frames: Any = None,
    *,
    sensor: str,
    source: str,
    channels: Sequence[str] | None = None,
    units: Mapping[str, str] | None = None,
    points: Any = None,
    times: Any = None,
    scenes: Sequence[str] | None = None,
    reference: Any = None,
    serial: str = "unknown",
    gel: str = "unknown",
    opaque: bool | None = None,
    clock: str = "unknown",
    footprint_mm: tuple[float, float] | None = None,
) -> Dataset:
    """Write arrays as a recording for all commands and functions, and open it.

    Parameters
    ----------
    path
        New folder. An interrupted recording cannot be opened: remove its folder.
    labels
        ``[rows, channels]`` in the units of the channels; NaN for a missing label. Named columns (pandas, polars, Arrow, xarray, a dict of
        arrays) are matched by name.
    frames
        ``[rows, height, width]`` (gray) or ``[rows, height, width, 3]`` (red, green, blue), uint8 or uint16, stored without loss; ``None`` for no frames.
    sensor, serial, gel
        Sensor model, serial number of the unit, and id of its gel.
    source
        ``recorded`` by a real sensor, ``simulated``, or ``synthetic``: every output states it.
    channels
        Names of the labels; by default the named columns, or else the six of the paper. The recording has the six first, then others by
        name: see `Dataset.channels`.
    units
        Units of channels other than the six, such as ``{"Mz": "N·mm"}``; ``1`` by default.
    points, times, scenes
        Contact point, time in seconds and scene of each row. By default a column ``point_id`` of the labels is used.
    reference
        Reference frame of the untouched gel, with the size and type of ``frames``.
    opaque
        True if the gel lets no ambient light through; ``None`` if unknown.
    clock
        Clock of ``times``, as in the header of a recording: ``unix``, ``monotonic`` or ``unknown``.
    footprint_mm
        Width along x and height along y of the sensing surface, in mm.

    Raises
    ------
    DatasetError
        If ``path`` has a recording, or the disk is full.
    ValueError, TypeError
        For arrays of unequal lengths or wrong shapes.

    >>> import tempfile
    >>> import numpy as np
    >>> import taceva
    >>> frames = np.zeros((20, 24, 32), np.uint8)
    >>> folder = tempfile.mkdtemp() + "/gel"
    >>> taceva.from_arrays(folder, np.ones((20, 1)), frames, sensor="my gel", source="synthetic", channels=["Fz"]).frame_shape
    (24, 32, 1)
    """
    if isinstance(channels, str):
        raise TypeError(f"channels: expected a list of names, found the text {channels!r}")
    named = named_columns(labels, "labels")
    index = None if named is None else named.index
    if named is not None and list(named.columns) == [""]:
        labels, named = named.columns[""], None
    if named is not None:
        channels = named.channels() if channels is None else channels
        if not channels:
            raise ValueError(f"labels: no column is a channel: its columns are {', '.join(named.columns)}")
        points = named.column("point_id") if points is None else points
        # A single column is matched by position, unless it has the name of another channel.
        is_lone = len(named.columns) == 1 and len(channels) == 1 and next(iter(named.columns)) not in SIX
        labels = next(iter(named.columns.values())) if is_lone else named.array(channels, "labels")
    channels = list(SIX if channels is None else channels)
    listed = with_units(channels, dict(units or {}))
    if not channels and frames is None:
        raise ValueError("no channels and no frames: nothing to record, expected channels or frames")
    points, times, scenes = beside(points, index, "points"), beside(times, index, "times"), beside(scenes, index, "scenes")
    # Checked before anything is copied.
    rows = len(real(labels, "labels"))
    for name, column in {"frames": frames, "points": points, "times": times, "scenes": scenes}.items():
        if column is not None and len(column) != rows:
            raise ValueError(f"{name} has {counted(len(column), 'row')}, labels has {rows}")
    order = column_order(listed)
    table = np.ascontiguousarray(in_order(numbers(labels, "labels", allow_invalid=True), order))
    listed = listed if order is None else [listed[at] for at in order]
    if np.isinf(table).any():
        raise ValueError("labels: an infinite number; expected finite numbers, and NaN for an absent label")
    pictures = None if frames is None else pixels(frames, 3)
    _taceva.record(
        os.fspath(path),
        {
            "sensor": sensor,
            "serial": serial,
            "gel": gel,
            "opaque": opaque,
            "source": source,
            "clock": clock,
            "footprint_mm": footprint_mm,
        },
        listed,
        table,
        None if points is None else names_of_points(points),
        None if times is None else [float(time) for time in numbers(times, "times").tolist()],
        {} if scenes is None else {"scene": [str(scene) for scene in scenes]},
        pictures,
        None if reference is None else pixels(reference, 2),
        bar(),
    )
    return Dataset(path)


def import_recording(
    source: str | os.PathLike[str],
    map: str | os.PathLike[str],
    out: str | os.PathLike[str],
    *,
    replace: bool = False,
    ffmpeg: str | os.PathLike[str] | None = None,
    jobs: int = 0,
) -> Dataset:
    """Import a folder of another program by a map, like ``taceva import SOURCE --map MAP --out OUT``, and open the recording.

    ``taceva import SOURCE --draft`` writes a first map, a TOML file. ``replace`` replaces the recording at ``out`` once the new
    recording is complete. ``ffmpeg`` is a program that decodes clips with unsupported codecs.

    Raises
    ------
    DatasetError
        For an invalid map or file, and if ``out`` exists without ``replace``.
    """
    _taceva.import_recording(
        os.fspath(source),
        os.fspath(map),
        os.fspath(out),
        replace,
        None if ffmpeg is None else os.fspath(ffmpeg),
        jobs,
        bar(),
    )
    return Dataset(out)


def pixels(frames: Any, gray_axes: int) -> Any:
    """Return frames with an axis of samples, in native byte order and C order."""
    if hasattr(frames, "detach") and hasattr(frames, "cpu"):
        frames = frames.detach().cpu()
    found = np.asarray(frames)
    if found.dtype.kind != "u" or found.dtype.itemsize not in (1, 2):
        raise TypeError(f"frames: expected uint8 or uint16, found an array of {found.dtype}")
    if found.ndim == gray_axes:
        found = found[..., np.newaxis]
    return np.ascontiguousarray(found, dtype=found.dtype.newbyteorder("="))
