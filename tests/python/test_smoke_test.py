"""The default experiment with reference results of the FMU itself.

With BLESS=1 in the environment the results are written again, by FMPy.
"""

import os
import zipfile

import fmpy
import numpy as np
import pytest
from conftest import ROOT

ASSETS = ROOT / "fmu-build" / "assets"
STIMULI, RESULTS = ASSETS / "default-in.csv", ASSETS / "default-ref.csv"
FOLDER = "extra/org.fmi-standard.fmi-ls-ref"
#: As in fmu-build/src/smoke_test.rs; relative to the largest value of a column.
TOLERANCE = 2e-3
#: Results stand at the ends of the rests of the inputs.
EVERY = 0.1  # s

#: N and µm at the ends of the rests: partial slip, reversals, gross slip in both directions.
PATH = [
    (100, 1),
    (120, 2),
    (90, -1),
    (90, -4),
    (100, -4.5),
    (110, 4),
    (100, 3),
    (80, 3.5),
    (100, -1),
    (100, 0),
]


def stimuli():
    """Rows of time, load and displacement: each move takes half the time of a step of the path."""
    rows = [(0.0, 100.0, 0.0)]
    for k, (load, micrometres) in enumerate(PATH):
        for part in (0.5, 1.0):
            rows.append((round(EVERY * (k + part), 12), float(load), micrometres * 1e-6))
    return rows


def table(path):
    return np.genfromtxt(path, delimiter=",", names=True)


def outputs(fmu):
    """Real outputs without the stiffnesses, which jump where the contact begins to slide."""
    reals = [
        name for name, v in fmu.variables.items() if v.causality == "output" and v.type == "Real"
    ]
    return [name for name in reals if not name.endswith("_stiffness")]


def simulated(fmu_path, columns):
    experiment = fmpy.read_model_description(str(fmu_path)).defaultExperiment
    return fmpy.simulate_fmu(
        str(fmu_path),
        start_time=float(experiment.startTime),
        stop_time=float(experiment.stopTime),
        output_interval=float(experiment.stepSize),
        input=table(STIMULI),
        output=columns,
    )


def interpolated(start_contact, columns):
    """A master whose inputs reach their values at the end of a step, with ten times its size."""
    given = table(STIMULI)
    names = given.dtype.names[1:]
    contact = start_contact(**{name: given[name][0] for name in names})
    rows = [contact.get(*columns)]
    for time in EVERY * np.arange(1, len(PATH) + 1):
        for part in (time - EVERY / 2, time):
            at = {name: np.interp(part, given["time"], given[name]) for name in names}
            contact.step(EVERY / 2, **at)
        rows.append(contact.get(*columns))
    return dict(zip(columns, np.array(rows).T))


def at_rests(result, columns):
    """Rows of a result at the ends of the rests."""
    wanted = EVERY * np.arange(len(PATH) + 1)
    rows = [np.argmin(np.abs(result["time"] - time)) for time in wanted]
    assert np.allclose(result["time"][rows], wanted, atol=1e-9)
    return {name: result[name][rows] for name in columns}


def agree(found, expected, columns):
    for name in columns:
        scale = np.max(np.abs(expected[name]))
        assert np.max(np.abs(found[name] - expected[name])) <= TOLERANCE * scale, name


def bless(fmu_path, fmu):
    names = ["normal_force", "tangential_displacement"]
    lines = [
        ",".join(["time", *names]),
        *(",".join(f"{value:.12g}" for value in row) for row in stimuli()),
    ]
    STIMULI.write_text("\n".join(lines) + "\n", encoding="utf-8")
    columns = outputs(fmu)
    found = at_rests(simulated(fmu_path, columns), columns)
    lines = [",".join(["time", *columns])]
    for k in range(len(PATH) + 1):
        lines.append(
            ",".join(
                f"{value:.10g}" for value in (EVERY * k, *(found[name][k] for name in columns))
            )
        )
    RESULTS.write_text("\n".join(lines) + "\n", encoding="utf-8")


@pytest.fixture(scope="module")
def reference(fmu_path, fmu):
    if os.environ.get("BLESS"):
        bless(fmu_path, fmu)
    return table(RESULTS)


@pytest.mark.usefixtures("reference")
def test_the_inputs_are_those_of_this_file():
    given = table(STIMULI)
    assert given.dtype.names == ("time", "normal_force", "tangential_displacement")
    assert np.allclose(np.array(given.tolist()), stimuli(), rtol=1e-11, atol=0)


def test_fmpy_gives_the_reference_results(reference, fmu_path):
    columns = list(reference.dtype.names[1:])
    agree(at_rests(simulated(fmu_path, columns), columns), reference, columns)


def test_another_master_with_other_steps_gives_them(reference, start_contact):
    columns = list(reference.dtype.names[1:])
    agree(interpolated(start_contact, columns), reference, columns)


def test_the_experiment_slips_both_ways_and_wears(reference):
    """Else agreement would say little."""
    force, limit = reference["tangential_force"], 0.6 * reference["normal_reaction"]
    assert np.any(force > 0.999 * limit) and np.any(force < -0.999 * limit)
    assert np.any(
        (reference["stick_radius"] > 0) & (reference["stick_radius"] < reference["contact_radius"])
    )
    assert np.all(np.diff(reference["wear_volume"]) >= 0) and reference["wear_volume"][-1] > 0


def test_the_columns_are_outputs(reference, fmu):
    assert set(reference.dtype.names[1:]) <= set(outputs(fmu))
    assert {"tangential_force", "wear_volume", "contact_radius"} <= set(reference.dtype.names)


def test_the_fmu_has_the_files(reference, fmu_path):
    with zipfile.ZipFile(fmu_path) as archive:
        for path in (STIMULI, RESULTS):
            assert archive.read(f"{FOLDER}/{path.name}").decode() == path.read_text(
                encoding="utf-8"
            )
        assert b'name="default"' in archive.read(f"{FOLDER}/smoke-test.exp")
