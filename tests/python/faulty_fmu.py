"""A small bridge FMU in C, faulty/bridge.c, and everything that can be wrong with an FMU."""

import io
import subprocess
import zipfile
from dataclasses import dataclass, field
from pathlib import Path

SOURCE = Path(__file__).with_name("faulty") / "bridge.c"
LIBRARY = "binaries/linux64/faulty.so"
DESCRIPTION = "modelDescription.xml"
CAPABLE = 'canHandleVariableCommunicationStepSize="true" canGetAndSetFMUstate="true" canSerializeFMUstate="true" providesDirectionalDerivative="true"'

UNITS = """<UnitDefinitions><Unit name="N"><BaseUnit kg="1" m="1" s="-2"/></Unit>
<Unit name="m"><BaseUnit m="1"/></Unit><Unit name="m/s"><BaseUnit m="1" s="-1"/></Unit></UnitDefinitions>"""


def description(n=49, capabilities=CAPABLE):
    """modelDescription.xml of bridge.c."""
    series = [("force", "input", "N"), ("displacement", "output", "m"), ("velocity", "output", "m/s")]
    variables, outputs = [], []
    for k, (what, causality, unit) in enumerate(series):
        for i in range(n):
            more = ' start="0"' if causality == "input" else ""
            variables.append(
                f'<ScalarVariable name="support[{i + 1}].{what}" valueReference="{k * n + i}" causality="{causality}" '
                f'variability="continuous"><Real unit="{unit}"{more}/></ScalarVariable>'
            )
            if causality == "output":
                outputs.append(f'<Unknown index="{k * n + i + 1}" dependencies=""/>')
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="Faulty" guid="{{faulty}}" generationTool="the tests">
<CoSimulation modelIdentifier="faulty" {capabilities}/>
{UNITS}
<DefaultExperiment startTime="0" stopTime="0.5" stepSize="1e-3"/>
<ModelVariables>{"".join(variables)}</ModelVariables>
<ModelStructure><Outputs>{"".join(outputs)}</Outputs><InitialUnknowns>{"".join(outputs)}</InitialUnknowns></ModelStructure>
</fmiModelDescription>"""


def keep(entries):
    """A change of the archive's entries, name to bytes: none."""
    return entries


@dataclass
class Fault:
    """What is wrong, what `ttb check` must find, and how `ttb run` must end."""

    name: str
    found: set[str]
    # None: not asserted. Crashes and hangs need the FMU in a process of its own, states that are not restored a test at the start.
    code: int | None = 4
    says: str = ""
    defines: list[str] = field(default_factory=list)
    replace: list[tuple[str, str]] = field(default_factory=list)
    entries: object = keep
    reached: float | None = None  # s of results kept
    checked: int = 1  # exit code of `ttb check`: 0 after remarks alone

    def __str__(self):
        return self.name.replace(" ", "-")


def compile_library(defines, folder):
    """The shared library with some faults."""
    library = Path(folder) / ("-".join(["faulty", *defines]).replace("=", "-") + ".so")
    if not library.is_file():
        flags = [f"-D{define}" for define in defines]
        subprocess.run(["cc", "-O1", "-w", "-shared", "-fPIC", *flags, "-o", library, SOURCE, "-lm"], check=True)
    return library.read_bytes()


def pack(fault, folder, libraries):
    """The FMU of a fault."""
    text = description()
    for old, new in fault.replace:
        assert old in text, old
        text = text.replace(old, new)
    entries = {DESCRIPTION: text.encode(), LIBRARY: compile_library(fault.defines, libraries)}
    path = Path(folder) / "theirs.fmu"
    changed = fault.entries(entries)
    if isinstance(changed, bytes):
        path.write_bytes(changed)
        return path
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in changed.items():
            archive.writestr(name, content)
    return path


def zipped(entries):
    """The bytes of an archive."""
    memory = io.BytesIO()
    with zipfile.ZipFile(memory, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in entries.items():
            archive.writestr(name, content)
    return memory.getvalue()


def without(name):
    """Drops an entry."""
    return lambda entries: {key: value for key, value in entries.items() if key != name}


def moved(old, new):
    """Renames an entry."""
    return lambda entries: {new if key == old else key: value for key, value in entries.items()}


def holding(name, content):
    """Sets an entry."""
    return lambda entries: {**entries, name: content}


def cut(name):
    """The first half of an entry."""
    return lambda entries: {**entries, name: entries[name][: len(entries[name]) // 2]}


def laughs():
    """Entities that would become 10^10 characters."""
    levels = "".join(f'<!ENTITY l{i} "{f"&l{i - 1};" * 10}">' for i in range(1, 10))
    return f'<!DOCTYPE x [<!ENTITY l0 "ha">{levels}]>\n<fmiModelDescription description="&l9;"'


ROOT = "<fmiModelDescription"
FLAG = 'canGetAndSetFMUstate="true"'

# Faults of the archive and of the description.
ARCHIVE = [
    Fault("no archive", {"archive"}, says="zip", entries=lambda e: b"this is no archive"),
    Fault("an empty file", {"archive"}, says="zip", entries=lambda e: b""),
    Fault("cut off", {"archive"}, says="zip", entries=lambda e: zipped(e)[:2000]),
    Fault("a path with ..", {"archive"}, says="..", entries=holding("../evil", b"x")),
    Fault("an absolute path", {"archive"}, says="absolute", entries=holding("/etc/evil", b"x")),
    Fault("a zip bomb", {"archive"}, says="larger than", entries=holding("resources/bomb", bytes(300 << 20))),
    Fault("an entry twice", {"archive"}, says="twice", entries=holding("binaries//linux64/faulty.so", b"x")),
    Fault("no description", {"no-description"}, says=DESCRIPTION, entries=without(DESCRIPTION)),
    Fault("description in a folder", {"no-description"}, says=DESCRIPTION, entries=moved(DESCRIPTION, "theirs/" + DESCRIPTION)),
    Fault("malformed XML", {"description"}, says="well-formed", replace=[("</ModelVariables>", "</ModelVariable>")]),
    Fault("XML cut off", {"description"}, says="ends before", replace=[("</fmiModelDescription>", "")]),
    Fault("another document", {"description"}, says="root", entries=holding(DESCRIPTION, b"<html></html>")),
    Fault("an XML bomb", {"xml-entities"}, 0, replace=[(ROOT, laughs())]),
    Fault("deep XML", {"description"}, says="nested", replace=[("<ModelVariables>", "<a>" * 10000 + "</a>" * 10000 + "<ModelVariables>")]),
    Fault("FMI 3", {"fmi-version"}, says="3.0", replace=[('fmiVersion="2.0"', 'fmiVersion="3.0"')]),
    Fault("FMI 1", {"fmi-version"}, says="1.0", replace=[('fmiVersion="2.0"', 'fmiVersion="1.0"')]),
    Fault("model exchange only", {"no-co-simulation"}, says="model exchange", replace=[("<CoSimulation", "<ModelExchange")]),
    Fault("no model identifier", {"description"}, says="modelIdentifier", replace=[('modelIdentifier="faulty"', "")]),
    Fault("model identifier with ..", {"description"}, says="modelIdentifier", replace=[('r="faulty"', 'r="../../faulty"')]),
    Fault(
        "names twice", {"duplicate-name"}, says="support[3].force", replace=[('"support[4].force"', '"support[3].force"')]
    ),
    Fault(
        "a value reference twice",
        {"duplicate-reference"},
        says="value reference",
        replace=[('force" valueReference="3"', 'force" valueReference="2"')],
    ),
    Fault("an unknown unit", {"unit-undefined"}, 0, replace=[('<Unit name="N">', '<Unit name="kp">')]),
    Fault("an empty GUID", {"guid-empty", "no-instance"}, says="GUID", replace=[('guid="{faulty}"', 'guid=""')]),
    Fault("another program needed", {"needs-tool"}, 0, replace=[("<CoSimulation", '<CoSimulation needsExecutionTool="true"')]),
    Fault("a fixed input", {"variable"}, 0, replace=[('"input" variability="continuous"', '"input" variability="fixed"')]),
    Fault("an input without start", {"variable"}, 0, replace=[('unit="N" start="0"', 'unit="N"')]),
    Fault("a time that ends before it begins", {"experiment"}, 0, replace=[('stopTime="0.5"', 'stopTime="-1"')]),
]

# Faults of the library, static ones first.
LIBRARIES = [
    Fault("no binary", {"no-binary"}, says="no platform", entries=without(LIBRARY)),
    Fault("a binary for Windows only", {"no-binary"}, says="win64", entries=moved(LIBRARY, "binaries/win64/faulty.dll")),
    Fault("a text for a binary", {"library"}, says="cannot be loaded", entries=holding(LIBRARY, b"#!/bin/sh\n")),
    Fault("a library of FMI 1", {"library"}, says="1.0", defines=["OLD_LIBRARY"]),
    Fault("a missing function", {"missing-symbol"}, says="fmi2Terminate", defines=["NO_TERMINATE"]),
    Fault("states without functions", {"flag-without-symbol"}, 0, says="cannot save and restore", defines=["NO_STATES"]),
    Fault("derivatives without function", {"flag-without-symbol"}, 0, defines=["NO_DERIVATIVES"]),
    Fault("a function missing that all must have", {"incomplete-library"}, 0, defines=["NO_CANCEL"]),
    Fault("a wrong GUID", {"no-instance"}, says="GUID", defines=['GUID="{other}"']),
    Fault("a GUID unchecked", {"guid-unchecked"}, 0, defines=["GUID_UNCHECKED"]),
    Fault("no instance", {"no-instance"}, says="no licence", defines=["INSTANTIATE_NULL"]),
    Fault("a crash at birth", {"crash"}, None, defines=["INSTANTIATE_CRASH"]),
    Fault("a hang at birth", {"hang"}, None, defines=["INSTANTIATE_HANG"]),
    Fault("a crash at the end", {"crash"}, None, defines=["FREE_CRASH"]),
    Fault("a crash without terminate", {"abort"}, 0, defines=["FREE_ONLY_AFTER_TERMINATE"]),
    Fault("no initialization", {"failed"}, says="no equilibrium", defines=["INITIALIZATION_ERROR"]),
    Fault("one form of URI", {"resource-uri"}, 0, defines=["URI_PICKY"]),
    Fault("a crash at one form of URI", {"crash"}, 0, defines=["URI_CRASH"]),
    Fault("URI not decoded", {"resource-uri"}, 0, defines=["URI_NOT_DECODED"]),
    Fault("NULL logged", {"logger-call"}, 0, defines=["LOG_NULL"]),
    Fault("odd formats logged", {"logger-call"}, 0, defines=["LOG_FORMAT"]),
    Fault("another environment logged", {"logger-call"}, 0, defines=["LOG_ENVIRONMENT=s"]),
    Fault("a number for an environment logged", {"logger-call"}, 0, defines=["LOG_ENVIRONMENT=((void*)1)"]),
    Fault("NULL for an environment logged", {"logger-call"}, 0, defines=["LOG_ENVIRONMENT=NULL"]),
    Fault("a folder changed", {"process-state"}, 0, defines=["CHANGES_FOLDER"]),
    Fault("permissions changed", {"process-state"}, 0, defines=["CHANGES_UMASK"]),
    Fault("signals ignored", {"process-state"}, 0, defines=["CHANGES_SIGNALS"]),
    Fault("rounding changed", {"process-state"}, 0, defines=["CHANGES_ROUNDING"]),
    Fault("files closed", {"process-state"}, None, defines=["CLOSES_FILES"]),
    Fault("a process left", {"leaves-processes"}, None, defines=["LEAVES_PROCESS"]),
    Fault("one instance in all", {"no-instance"}, 0, defines=["SECOND_NULL"]),
    Fault("a crash of the second instance", {"crash"}, 0, defines=["SECOND_CRASH"]),
    Fault("a library cut off", {"library"}, says="cut off", entries=cut(LIBRARY)),
    Fault("an empty library", {"library"}, says="empty file", entries=holding(LIBRARY, b"")),
    Fault("prints", {"prints"}, 0, defines=["PRINTS"]),
    Fault("prints errors", {"prints"}, 0, defines=["STDERR_CHATTER"]),
    Fault("writes files", {"writes-files"}, 0, defines=["WRITES_FILE"]),
    Fault("state in a global", {"not-repeatable", "step-elsewhere"}, 0, defines=["STATIC_STATE"]),
    Fault("state shared by instances", {"instances", "step-elsewhere"}, 0, defines=["STATIC_STATE", "SHARED_STATE"]),
    Fault("an output that is random", {"not-repeatable"}, None, defines=["RANDOM"]),
    Fault("reset keeps something", {"reset"}, 0, defines=["RESET_KEEPS"]),
    Fault("memory grows", {"memory-growth"}, 0, defines=["LEAKS"]),
    Fault("states leak", {"state-leak"}, 0, defines=["STATE_LEAK"]),
]

# Faults of steps.
STEPS = [
    Fault("NaN late", {"nan"}, says="NaN", defines=["NAN_LATE"], reached=0.3),
    Fault("infinity late", {"infinite"}, says="inf", defines=["INF_LATE"], reached=0.3),
    Fault("discard late", {"discard"}, says="fmi2Discard", defines=["DISCARD_LATE"], reached=0.3),
    Fault("error late", {"failed"}, says="singular", defines=["ERROR_LATE"], reached=0.3),
    Fault("fatal late", {"fatal"}, says="fmi2Fatal", defines=["FATAL_LATE"], reached=0.3),
    Fault("pending late", {"pending"}, says="fmi2Pending", defines=["PENDING_LATE"], reached=0.3),
    Fault("crash late", {"crash"}, None, defines=["STEP_CRASH"]),
    Fault("abort late", {"abort"}, None, defines=["STEP_ABORT"]),
    Fault("exit late", {"exit"}, says="exit(0)", defines=["STEP_EXIT"], reached=0.3),
    Fault("exit at once late", {"exit"}, says="exit(7)", defines=["STEP_EXIT_AT_ONCE"], reached=0.3),
    Fault("an end of the thread late", {"abort"}, says="exit(0)", defines=["STEP_ENDS_THREAD"], reached=0.3),
    Fault("an end late", {"ends"}, code=3, says="fmi2Discard", defines=["ENDS_LATE"], reached=0.3, checked=0),
    Fault("hang late", {"hang"}, None, defines=["STEP_HANG"]),
    Fault("warnings", {"warnings"}, 0, defines=["WARNS"]),
    Fault("a fixed step", {"step-halved", "step-jitter"}, None, defines=["FIXED_STEP"]),
    Fault("steps from any time", {"step-elsewhere"}, 0, defines=["ANY_TIME"], checked=0),
    Fault("NaN after a tiny step", {"step-tiny"}, 0, defines=["TINY_STEP_NAN"]),
]

# Faults of states and derivatives.
STATES = [
    Fault("set does nothing", {"roll-back", "derivatives", "serialize"}, 0, says="a step repeated from a restored state differs", defines=["SET_NOTHING"]),
    Fault("set forgets the velocity", {"roll-back", "derivatives", "serialize"}, 0, says="a step repeated from a restored state differs", defines=["SET_FORGETS_VELOCITY"]),
    Fault("set forgets the inputs", {"roll-back-inputs"}, 0, defines=["SET_FORGETS_INPUTS"]),
    Fault("set forgets something hidden", {"roll-back", "derivatives", "serialize"}, 0, says="a step repeated from a restored state differs", defines=["HISTORY"]),
    Fault("set works for near states", {"roll-back-later", "roll-back-inputs"}, 0, defines=["SET_ONLY_NEAR"]),
    Fault("get gives NULL", {"state-null"}, says="no saved state", defines=["STATE_NULL"]),
    Fault("free keeps the handle", {"free-state"}, 0, defines=["FREE_KEEPS_HANDLE"]),
    Fault("a serialized state of 2^60 bytes", {"serialize"}, 0, defines=["SERIALIZED_TOO_LARGE"]),
    Fault("get refuses", {"failed"}, says="no room", defines=["GET_STATE_ERROR"]),
    Fault("get disturbs", {"roll-back-save", "roll-back-first"}, 0, defines=["SAVE_DISTURBS"]),
    Fault("a serialized state too small", {"serialize"}, 0, defines=["SERIALIZED_TOO_SMALL"]),
    Fault("a serialized state without motion", {"serialize"}, 0, defines=["SERIALIZED_WITHOUT_MOTION"]),
    Fault("wrong derivatives", {"derivatives"}, 0, defines=["WRONG_DERIVATIVES"]),
    Fault("derivatives of wrong sign", {"derivatives"}, 0, defines=["WRONG_SIGN_DERIVATIVES"]),
]

# What looks odd and is allowed: `ttb check` finds nothing, and a run is that of the plain FMU.
NO_DERIVATIVES = ('providesDirectionalDerivative="true"', "")
ONCE = [("<CoSimulation", '<CoSimulation canBeInstantiatedOnlyOncePerProcess="true"')]
SOUND = [
    Fault("plain", set(), 0),
    Fault("units without base", set(), 0, replace=[('<Unit name="N"><BaseUnit kg="1" m="1" s="-2"/></Unit>', '<Unit name="N"/>')]),
    Fault("a unit that says nothing", set(), 0, replace=[('<Real unit="m/s"/>', '<Real unit=""/>')]),
    Fault("a minus zero", set(), 0, defines=["NEGATIVE_ZERO"], replace=[NO_DERIVATIVES]),
    Fault("outputs that share a reference", set(), 0, replace=[('displacement" valueReference="50"', 'displacement" valueReference="49"')]),
    Fault("an output that is an input", set(), 0, replace=[('displacement" valueReference="50"', 'displacement" valueReference="0"'), NO_DERIVATIVES]),
    Fault("derivatives of both kinds", set(), 0, defines=["MIXED_DERIVATIVES"]),
    Fault("derivatives of the instant", set(), 0, defines=["INSTANT_DERIVATIVES"]),
    Fault("no category where there are none", set(), 0, defines=["LOG_NO_CATEGORY"]),
    Fault("one instance where more are not promised", set(), 0, defines=["SECOND_NULL"], replace=ONCE),
    Fault("a crash of the second where more are not promised", set(), 0, defines=["SECOND_CRASH"], replace=ONCE),
]

ALL = ARCHIVE + LIBRARIES + STEPS + STATES
