"""Manifest tables of the classes of a plugin."""

from __future__ import annotations

import inspect
import json
import types
import typing
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from taceva.plugin_classes import Arg, Device, Estimator


def _value(value: Any) -> str:
    """Return ``value`` in TOML syntax."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, (str, Path)):
        return json.dumps(str(value), ensure_ascii=False)
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_value, value)) + "]"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {_value(item)}" for key, item in value.items()) + " }"
    raise TypeError(f"{value!r}: expected a number, a text, a flag, a list or a dict")


def table(key: str, given: type[Device | Estimator]) -> str:
    """Return the manifest table of the class ``given`` with ``key``: the head of the class and the arguments of its constructor."""
    said = dict(given.said)
    documented = (inspect.getdoc(given) if "__doc__" in vars(given) and given.__doc__ else None) or key
    lines = {
        "kind": given.kind,
        "key": key,
        "title": said.pop("title", documented.splitlines()[0]),
    }
    frame = said.get("frame")
    if isinstance(frame, tuple) and len(frame) == 3:
        said["frame"] = dict(zip(("width", "height", "format"), frame, strict=True))
    lines.update(said)
    text = "".join(f"{name} = {_value(value)}\n" for name, value in lines.items())
    for argument in _arguments(given):
        text += "\n[[args]]\n" + "".join(f"{name} = {_value(value)}\n" for name, value in argument.items())
    return text


def _arguments(given: type[Device | Estimator]) -> list[dict[str, Any]]:
    """Return the arguments of the constructor as in a manifest."""
    if given.__init__ is object.__init__:
        return []
    hints = typing.get_type_hints(given.__init__, include_extras=True)
    arguments = []
    for parameter in list(inspect.signature(given.__init__).parameters.values())[1:]:
        if parameter.kind in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD):
            raise TypeError(f"{given.__name__}: expected arguments with names and types, got *{parameter.name}")
        hint = hints.get(parameter.name, Any)
        argument: dict[str, Any] = {"key": parameter.name, **_type(given, parameter.name, hint)}
        default = parameter.default
        if default is None:
            argument["optional"] = True
        elif default is not parameter.empty:
            argument["default"] = default
        arguments.append(argument)
    return arguments


def _type(given: type, name: str, hint: Any) -> dict[str, Any]:
    """Return the manifest entries of an argument of type ``hint``."""
    from taceva.plugin_classes import Arg

    notes: list[Arg] = []
    if typing.get_origin(hint) is typing.Annotated:
        hint, *rest = typing.get_args(hint)
        notes = [note for note in rest if isinstance(note, Arg)]
    if typing.get_origin(hint) in (typing.Union, types.UnionType):
        some = [one for one in typing.get_args(hint) if one is not type(None)]
        hint = some[0] if len(some) == 1 else hint
    if typing.get_origin(hint) is typing.Annotated:
        hint, *rest = typing.get_args(hint)
        notes += [note for note in rest if isinstance(note, Arg)]
    names = {int: "whole", float: "number", bool: "flag", str: "text", Path: "path"}
    said: dict[str, Any]
    if typing.get_origin(hint) is typing.Literal:
        said = {"type": "choice", "choices": list(typing.get_args(hint))}
    elif hint in names:
        said = {"type": names[hint]}
    else:
        raise TypeError(
            f"{given.__name__}: argument {name}: expected a type of int, float, bool, str, pathlib.Path or Literal, got {hint!r}"
        )
    for note in notes:
        if note.unit is not None:
            said["unit"] = note.unit
        if note.range is not None:
            said["range"] = list(note.range)
        if note.help:
            said["help"] = note.help
        if note.changes_facts:
            said["changes_facts"] = True
    return said
