"""FMUs in FMPy: an FMU unzipped once, and instances that keep the messages they log."""

from ctypes import byref, c_double, c_int, c_uint, POINTER
from functools import cached_property
from itertools import count
from pathlib import Path

import numpy as np
from fmpy import calloc, extract, free, read_model_description
from fmpy.fmi2 import (
    FMU2Slave,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
)
from fmpy.logging import addLoggerProxy


class Fmu:
    """An FMU file."""

    def __init__(self, path):
        self.path = Path(path)

    @cached_property
    def description(self):
        """modelDescription.xml, not validated."""
        return read_model_description(str(self.path), validate=False)

    @cached_property
    def variables(self):
        """Variables by name."""
        return {v.name: v for v in self.description.modelVariables}

    @property
    def identifier(self):
        """Name of the library."""
        return self.description.coSimulation.modelIdentifier

    @cached_property
    def folder(self):
        """Where it is unzipped, beside the file."""
        return Path(extract(str(self.path), unzipdir=str(self.path.with_suffix(""))))

    def names(self, causality):
        """Names of all variables of a causality, in the order of the description."""
        return [v.name for v in self.description.modelVariables if v.causality == causality]

    def references(self, names):
        """Value references."""
        return [self.variables[name].valueReference for name in names]


# FMPy keeps one logger for all FMI 2.0 instances (its C proxy formats the variadic arguments), so messages find their
# instance by the component environment.
_inboxes = {}
_numbers = count(1)


@fmi2CallbackLoggerTYPE
def _log(environment, name, status, category, message):
    text = (name or b"").decode(), status, (category or b"").decode(), (message or b"").decode()
    _inboxes.get(environment, []).append(text)


class FMU2Instance(FMU2Slave):
    """An instance; `messages` are (instance name, status, category, text). A refused call raises FMICallException."""

    def __init__(self, fmu, name="instance", guid=None, debug=False):
        super().__init__(
            instanceName=name,
            guid=fmu.description.guid if guid is None else guid,
            unzipDirectory=str(fmu.folder),
            modelIdentifier=fmu.identifier,
        )
        self.fmu = fmu
        number = next(_numbers)
        self.messages = _inboxes[number] = []
        callbacks = fmi2CallbackFunctions()
        callbacks.logger = _log
        callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
        callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
        callbacks.componentEnvironment = number
        addLoggerProxy(byref(callbacks))
        self.instantiate(callbacks=callbacks, loggingOn=debug)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.freeInstance()

    def initialize(self, stop=None, **parameters):
        """Through initialization mode from t = 0, with Real parameters set before."""
        self.setupExperiment(startTime=0.0, stopTime=stop)
        self.set(parameters)
        self.enterInitializationMode()
        self.exitInitializationMode()
        return self

    def set(self, values):
        """Sets Reals by name."""
        self.setReal(self.fmu.references(values), list(values.values()))

    def get(self, *names):
        """Reads Reals by name: a number, or an array of several."""
        values = self.getReal(self.fmu.references(names))
        return values[0] if len(names) == 1 else np.array(values)


class Reals:
    """Some Reals of an instance, exchanged as one numpy vector."""

    def __init__(self, instance, names):
        self.instance = instance
        self.references = np.array(instance.fmu.references(names), dtype=np.uint32)
        self.orders = np.ones(len(names), dtype=np.int32)
        self.size = len(names)

    def get(self):
        """A new vector."""
        values = np.empty(self.size)
        self.instance.fmi2GetReal(self.instance.component, _pointer(self.references, c_uint), self.size, _pointer(values, c_double))
        return values

    def set(self, values):
        """Values at the beginning of the next step."""
        self.instance.fmi2SetReal(self.instance.component, _pointer(self.references, c_uint), self.size, _pointer(values, c_double))

    def set_rates(self, rates):
        """First derivatives over the next step."""
        references, orders = _pointer(self.references, c_uint), _pointer(self.orders, c_int)
        self.instance.fmi2SetRealInputDerivatives(self.instance.component, references, self.size, orders, _pointer(rates, c_double))


def _pointer(array, kind):
    return array.ctypes.data_as(POINTER(kind))
