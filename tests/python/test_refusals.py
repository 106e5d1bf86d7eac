"""What an FMU must refuse: always fmi2Error with a message that says why, never a crash, never fmi2Discard."""

import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2Error
from fmu import FMU2Instance
from spoil import DESCRIPTION, copy, replaced

RESOURCE = {"TrainTrack": "resources/train-track.json", "Bridge": "resources/bridge.json"}


def refusal(instance, call, *arguments):
    """Makes the call, which must be refused; returns the message."""
    said = len(instance.messages)
    with pytest.raises(FMICallException) as caught:
        call(*arguments)
    assert caught.value.status == fmi2Error
    [(_, status, category, text)] = instance.messages[said:]
    assert (status, category) == (fmi2Error, "logStatusError")
    return text


def instantiation_refusal(fmu, **options):
    """The message of an instance that cannot be made."""
    instance = FMU2Instance.__new__(FMU2Instance)
    with pytest.raises(Exception, match="Failed to instantiate"):
        instance.__init__(fmu, **options)
    [(_, status, category, text)] = instance.messages
    assert (status, category) == (fmi2Error, "logStatusError")
    return text


def test_a_wrong_guid_is_refused_at_instantiation(fmu, tmp_path):
    """Architecture, invariant 6: the description belongs to another build."""
    guid = fmu.description.guid
    other = copy(fmu, tmp_path, {DESCRIPTION: replaced(guid, "{00000000-0000-0000-0000-000000000000}")})
    text = instantiation_refusal(other)
    assert guid in text and "{00000000-0000-0000-0000-000000000000}" in text
    assert "GUID" in instantiation_refusal(fmu, guid="")


@pytest.mark.parametrize(
    "change, reason",
    [
        (lambda content: None, "No such file"),
        (lambda content: content[: len(content) // 2], "is damaged"),
        (lambda content: b"", "is damaged"),
        (lambda content: b"\xff\xfe" + content, "UTF-8"),
        (replaced('"elements', '"elephants'), "elements"),
    ],
    ids=["missing", "cut off", "empty", "no text", "misspelt"],
)
def test_a_missing_or_damaged_resource_is_refused_by_name(fmu, tmp_path, change, reason):
    """No instance is made; the message names the file and what is wrong with it."""
    resource = RESOURCE[fmu.identifier]
    text = instantiation_refusal(copy(fmu, tmp_path, {resource: change}))
    assert resource in text and reason in text


@pytest.mark.parametrize(
    "side, name, value, reason",
    [
        ("train_track", "speed", -1.0, "speed is -1;"),
        ("train_track", "fastener_stiffness_factor", 0.0, "fastener_stiffness_factor is 0;"),
        ("train_track", "fastener_damping_factor", -0.1, "fastener_damping_factor is -0.1;"),
        ("train_track", "step_size", 0.0, "step_size is 0;"),
        ("train_track", "gamma", 0.4, "gamma is 0.4;"),
        ("train_track", "gamma", 1.5, "gamma is 1.5;"),
        ("train_track", "front_wheel", 1e6, "rail"),
        ("bridge", "damping_ratio", -0.01, "damping_ratio is -0.01;"),
        ("bridge", "damping_ratio", 1.5, "damping_ratio is 1.5;"),
        ("bridge", "stiffness_factor", 0.0, "stiffness_factor is 0;"),
        ("bridge", "step_size", -1e-3, "step_size is -0.001;"),
        ("bridge", "gamma", 1.5, "gamma is 1.5;"),
    ],
)
def test_an_impossible_parameter_is_refused_with_its_value(r1, side, name, value, reason):
    """At the latest when initialization ends."""

    def begin(instance):
        instance.enterInitializationMode()
        instance.exitInitializationMode()

    with FMU2Instance(getattr(r1, side)) as instance:
        instance.setupExperiment()
        instance.set({name: value})
        assert reason in refusal(instance, begin, instance)


def test_a_late_parameter_is_refused_and_the_run_goes_on(fmu):
    """docs/guide/fmus.md: error and message."""
    name = fmu.names("parameter")[0]
    with FMU2Instance(fmu) as instance:
        instance.initialize()
        before = instance.get(name)
        assert name in refusal(instance, instance.set, {name: 0.5 * before})
        assert instance.get(name) == before
        instance.doStep(0.0, 1e-3)


@pytest.mark.parametrize("value", [float("nan"), float("inf")])
def test_an_input_that_is_no_number_is_refused(fmu, value):
    """One NaN would make all later results NaN."""
    name = fmu.names("input")[0]
    references = fmu.references([name])
    with FMU2Instance(fmu) as instance:
        instance.initialize()
        assert name in refusal(instance, instance.set, {name: value})
        assert "derivative" in refusal(instance, instance.setRealInputDerivatives, references, [1], [value])
        instance.doStep(0.0, 1e-3)


def test_steps_that_cannot_be_done_are_refused(fmu):
    """Negative, NaN, or past the stop time: fmi2Error (FMPy retries fmi2Discard for ever)."""
    with FMU2Instance(fmu) as instance:
        instance.initialize(stop=1.0)
        for t, h in [(0.0, -1e-3), (0.0, float("nan")), (float("nan"), 1e-3), (0.9995, 1e-3)]:
            assert "step" in refusal(instance, instance.doStep, t, h)
        instance.doStep(0.0, 1e-3)


def test_calls_out_of_order_are_refused(fmu):
    """Stepping before initialization, initializing twice, setting outputs, asking for what is not there."""
    output, nowhere = fmu.names("output")[0], [10**6]
    with FMU2Instance(fmu) as instance:
        assert "initialization" in refusal(instance, instance.doStep, 0.0, 1e-3)
        instance.initialize()
        refusal(instance, instance.enterInitializationMode)
        refusal(instance, instance.exitInitializationMode)
        assert output in refusal(instance, instance.set, {output: 1.0})
        assert "1000000" in refusal(instance, instance.getReal, nowhere)
        refusal(instance, instance.getRealOutputDerivatives, fmu.references([output]), [1])
        refusal(instance, instance.setRealInputDerivatives, fmu.references(fmu.names("input")[:1]), [2], [0.0])
        instance.doStep(0.0, 1e-3)


def test_a_train_that_leaves_the_track_is_refused_by_name(r1):
    """The rail ends: fmi2Error with what, where and when; outputs can still be read, and fmi2Reset makes the instance usable again."""
    with FMU2Instance(r1.train_track) as train_track:
        train_track.initialize()
        text = refusal(train_track, train_track.doStep, 0.0, 5.0)
        assert "track" in text or "rail" in text
        train_track.get("wheel[1].contact_force")
        assert "failed step" in refusal(train_track, train_track.doStep, 0.0, 1e-3)
        train_track.reset()
        train_track.initialize().doStep(0.0, 1e-3)
