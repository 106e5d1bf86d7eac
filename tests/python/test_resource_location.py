"""How importers say where the resources are, and what callbacks they bring (docs/guide/fmus.md): every form that was met."""

from ctypes import byref
from urllib.parse import quote

import pytest
from fmpy.fmi2 import fmi2CallbackFunctions, fmi2CoSimulation, fmi2ModelExchange
from fmu import FMU2Instance
from spoil import copy

LOCATIONS = {
    "NULL": lambda path: None,
    "empty": lambda path: b"",
    "file:///p": lambda path: b"file://" + quote(path).encode(),
    "file:/p": lambda path: b"file:" + quote(path).encode(),
    "file:////p": lambda path: b"file:///" + quote(path).encode(),
    "trailing slash": lambda path: b"file://" + quote(path).encode() + b"/",
    "not encoded": lambda path: b"file://" + path.encode(),
    "plain path": lambda path: path.encode(),
}


@pytest.fixture(scope="module")
def instance(fmu, tmp_path_factory):
    """In a folder whose name needs encoding, and looks encoded already."""
    folder = tmp_path_factory.mktemp("resources") / "Brücke %41 100 %"
    folder.mkdir()
    with FMU2Instance(copy(fmu, folder, {})) as instance:
        yield instance


def instantiate(instance, location, callbacks, kind=fmi2CoSimulation):
    """Another component of the same library, or None; it is freed at once."""
    guid = instance.fmu.description.guid.encode()
    component = instance.fmi2Instantiate(b"another", kind, guid, location, callbacks, 0, 1)
    if component is not None:
        instance.fmi2FreeInstance(component)
    return component


@pytest.mark.parametrize("location", LOCATIONS.values(), ids=LOCATIONS)
def test_resources_are_found_however_their_place_is_written(instance, location):
    """Without any location: beside the library."""
    place = location(str(instance.fmu.folder / "resources"))
    assert instantiate(instance, place, byref(instance.callbacks)) is not None
    assert not any("fmi2Instantiate" in text for _, _, _, text in instance.messages)


def test_callbacks_may_all_be_null(instance):
    """No struct at all, and a struct of nothing; also when something goes wrong and nobody listens."""
    place = str(instance.fmu.folder / "resources").encode()
    for callbacks in (None, byref(fmi2CallbackFunctions())):
        assert instantiate(instance, place, callbacks) is not None
        assert instantiate(instance, b"/nowhere", callbacks) is None


def test_model_exchange_is_refused(instance):
    """Co-simulation only, said in a message."""
    assert instantiate(instance, b"", byref(instance.callbacks), fmi2ModelExchange) is None
    assert "co-simulation" in instance.messages[-1][3]
