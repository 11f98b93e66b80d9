"""Names of models, metrics and plugins for the functions of this package."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from pathlib import Path

from taceva import _taceva


@dataclass(frozen=True)
class FoundPlugin:
    """A plugin that was found."""

    id: str
    name: str
    version: str
    #: Kind of location, such as ``user`` or ``environment``.
    place: str
    #: Folder of its manifest.
    folder: Path
    #: Keys of its devices, for scenes.
    drivers: list[str]
    #: Keys of its models, for `evaluate`.
    estimators: list[str]


def models() -> dict[str, str]:
    """Return the names of models and presets for `evaluate`, each with a description; names from plugins come last.

    >>> import taceva
    >>> "ridge" in taceva.models() and "fast" in taceva.models()
    True
    """
    return dict(_taceva.model_names())


def metrics() -> dict[str, str]:
    """Return the names of metrics with their titles, and the names of groups with their members.

    >>> import taceva
    >>> taceva.metrics()["accuracy"]
    'mae, r2, smape'
    """
    return dict(_taceva.metric_titles())


def plugins() -> list[FoundPlugin]:
    """Return the plugins that the command ``taceva`` finds, in the folders and settings of the user and in this environment.

    A plugin that cannot be used causes a warning with the reason.
    """
    found, refused = _taceva.found_plugins()
    for reason in refused:
        warnings.warn(f"plugin not used: {reason}", stacklevel=2)
    return [FoundPlugin(**plugin) for plugin in found]
