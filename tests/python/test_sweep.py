"""Sweeps on Dask and on processes, also with a worker killed and after a stop."""

import json
import multiprocessing
import os
import signal
import subprocess
import sys

import numpy as np
import pytest
from conftest import ROOT
from fretting_contact import (
    ParameterError,
    SignalError,
    SweepResult,
    grid,
    read_sets,
    spread,
    sweep,
)
from fretting_contact.parameter_sets import SetsError
from fretting_contact.sweep_folder import SweepFolderError, parts
from fretting_contact.sweep_task import CyclicLife, run_batch

pytest.importorskip(
    "pyarrow", reason="pyarrow is not installed: see examples/sweep/sweep-requirements.txt"
)
SWEEP = ROOT / "examples" / "sweep"
sys.path.insert(0, str(SWEEP))

from regimes import draw, full_slip  # noqa: E402
from sweep import sets  # noqa: E402

COUNT, CYCLES, BATCH, LOSSES = 240, 1e4, 20, 10
COMMON = {"friction_coefficient": 0.6}


@pytest.fixture(scope="module", params=["dask", "processes"])
def swept(request, fmu_path, tmp_path_factory):
    """A sweep of which one worker is killed while it runs: folder, results, keywords to repeat it,
    pid of the worker.
    """
    out, killed = tmp_path_factory.mktemp("sweep"), []
    keywords = {"cycles": CYCLES, "out": out, "fmu": fmu_path, "batch": BATCH}
    if request.param == "processes":

        def kill_one(_):
            if not killed:
                killed.append(multiprocessing.active_children()[0].pid)
                os.kill(killed[0], signal.SIGKILL)

        keywords["processes"] = 2
        yield out, sweep(COMMON, sets(COUNT), **keywords, progress=kill_one), keywords, killed
        assert killed[0] not in [child.pid for child in multiprocessing.active_children()]
        return
    distributed = pytest.importorskip(
        "distributed", reason="Dask is not installed: see examples/sweep/sweep-requirements.txt"
    )
    import dask

    with dask.config.set({"distributed.scheduler.allowed-failures": LOSSES}):
        with distributed.Client(
            n_workers=2, threads_per_worker=1, dashboard_address=None
        ) as client:

            def kill_one(_):
                if not killed:
                    killed.append(next(iter(client.run(os.getpid).values())))
                    os.kill(killed[0], signal.SIGKILL)

            keywords["cluster"] = client.scheduler.address
            yield out, sweep(COMMON, sets(COUNT), **keywords, progress=kill_one), keywords, killed
            assert killed[0] not in client.run(os.getpid).values()


def test_every_set_comes_out_once_with_a_worker_killed(fmu_path, swept):
    _, results, _, killed = swept
    assert len(killed) == 1
    loads, amplitudes = sets(COUNT).columns.values()
    assert results.run == COUNT and results.missing == 0
    assert (
        results["normal_force"].tolist() == loads
        and results["displacement_amplitude"].tolist() == amplitudes
    )
    here = run_batch(
        fmu_path.read_bytes(),
        {**COMMON, "loading": "cyclic"},
        sets(COUNT).rows(0, 5),
        CyclicLife(CYCLES),
    )
    for name in ("wear_volume", "force_amplitude", "regime"):
        assert results[name][:5].tolist() == [row[name] for row in here], (
            name
        )  # to the bit, in any worker


def test_started_again_it_runs_what_is_missing(swept):
    out, results, keywords, _ = swept
    part = parts(out, COUNT, BATCH)[3]
    part.path.unlink()
    again = sweep(COMMON, sets(COUNT), **keywords, progress=lambda _: None)
    assert again.run == part.last - part.first
    assert {name: values.tolist() for name, values in again.columns.items()} == {
        name: values.tolist() for name, values in results.columns.items()
    }


def test_another_sweep_is_refused_in_the_same_folder(swept):
    _, _, keywords, _ = swept
    with pytest.raises(
        SweepFolderError, match="differs in parameters, sets, number of sets, task: give another"
    ):
        sweep({"radius": 0.02}, sets(COUNT - 1), **keywords | {"cycles": 5.0})


def test_regimes_are_those_of_the_closed_form(swept):
    _, results, *_ = swept
    slips = results["displacement_amplitude"] / full_slip(results["normal_force"])
    expected = np.where(
        slips >= 1,
        "gross",
        np.where(np.sqrt(np.clip(1 - slips, 0, None)) > 0.95, "stick", "partial"),
    )
    assert results["regime"].tolist() == expected.tolist()
    assert set(results["regime"]) == {"stick", "partial", "gross"}
    assert np.all(results["wear_volume"] > 0)


def test_the_map_is_a_picture_and_counts(swept, tmp_path):
    _, results, *_ = swept
    text = draw(results, tmp_path / "map.png")
    assert (tmp_path / "map.png").stat().st_size > 20_000
    regimes = results["regime"].tolist()
    assert sum(regimes.count(name) for name in ("stick", "partial", "gross")) == COUNT
    assert f"'gross': {regimes.count('gross')}" in text


def test_shares_of_a_job_array_are_the_whole(fmu_path, tmp_path):
    """As slurm.sh calls it: two jobs with half of the batches each, then one that gathers them."""
    command = [
        sys.executable,
        str(SWEEP / "sweep.py"),
        "--fmu",
        str(fmu_path),
        "--out",
        str(tmp_path),
        "--sets",
        "50",
    ]
    command += ["--cycles", "100"]
    for number, size in enumerate((30, 20)):
        done = subprocess.run(
            [*command, "--share", str(number), "2"], capture_output=True, text=True, timeout=60
        )
        assert done.stdout == f"{size} sets run\n", done.stderr
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert "in the last:" in done.stdout and "of 50 sets" not in done.stderr, done.stderr
    import pyarrow.parquet

    assert pyarrow.parquet.read_table(tmp_path / "all.parquet").num_rows == 50
    assert json.loads((tmp_path / "sweep.json").read_text())["number of sets"] == 50


@pytest.mark.parametrize("to_files", [False, True])
def test_a_refused_set_has_its_message_and_the_others_come_out(fmu_path, tmp_path, to_files):
    over = grid(
        {"normal_force": [100.0, 0.0], "radius": ["10 mm", -0.01], "hardness": [8e9, 800.0]}
    )
    results = sweep(
        {"profile": "parabola"},
        over,
        cycles=10,
        fmu=fmu_path,
        processes=1,
        progress=False,
        batch=4,
        out=tmp_path if to_files else None,
    )
    if to_files:  # read back
        results = sweep(
            {"profile": "parabola"}, over, cycles=10, fmu=fmu_path, batch=4, out=tmp_path
        )
        assert results.run == 0
    assert len(results) == 8
    refused = results["error"] != ""
    assert refused.tolist() == [False, False, True, True] * 2
    assert all("radius = -0.01" in text for text in results["error"][refused])
    assert results["regime"][:2].tolist() == ["partial"] * 2 and results["regime"][4] == "separated"
    assert np.isnan(results["wear_volume"][refused]).all()
    assert "hardness = 800 Pa" in results["warning"][1] and results["warning"][0] == ""


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"frequency": 0.0}, "frequency = 0 Hz makes no cycles: set a frequency above 0"),
        ({"profile_file": 3}, "profile_file is int: give a path"),
        ({"loading": "transient"}, "loading = 'transient', but 'cyclic' is needed"),
    ],
)
def test_a_set_that_makes_no_cycles_has_a_message(fmu_path, parameters, message):
    rows = run_batch(fmu_path.read_bytes(), {"loading": "cyclic"}, [parameters, {}], CyclicLife(10))
    assert message in rows[0]["error"] and rows[1]["error"] == ""
    assert rows[1]["wear_volume"] > 0


@pytest.mark.parametrize("cycles", [0, -5, float("nan"), float("inf")])
def test_a_number_of_cycles_that_is_none_is_refused(fmu_path, cycles):
    with pytest.raises(SignalError, match="cycles = .*: give a finite number above 0"):
        sweep({}, {"normal_force": [1.0]}, fmu=fmu_path, cycles=cycles)


def test_half_a_cycle_wears_half(fmu_path):
    half, whole = (
        run_batch(fmu_path.read_bytes(), {"loading": "cyclic"}, [{}], CyclicLife(cycles))[0]
        for cycles in (0.5, 1.0)
    )
    assert half["wear_volume"] / whole["wear_volume"] == pytest.approx(0.5, rel=1e-3)
    assert half["work_per_cycle"] / whole["work_per_cycle"] == pytest.approx(1.0, rel=1e-3)


@pytest.mark.parametrize("share", [(2, 2), (-1, 2)])
def test_a_share_that_is_none_is_refused(fmu_path, tmp_path, share):
    with pytest.raises(ValueError, match="give .number, count. with 0 <= number < count"):
        sweep({}, {"normal_force": [1.0]}, fmu=fmu_path, out=tmp_path, share=share)
    assert not list(tmp_path.iterdir())
    with pytest.raises(ValueError, match="and out, the folder of all shares"):
        sweep({}, {"normal_force": [1.0]}, fmu=fmu_path, share=(0, 1))


def test_a_script_without_a_main_guard_gets_a_message_that_says_so(tmp_path, fmu_path):
    script = tmp_path / "script.py"
    script.write_text(
        "from fretting_contact import sweep\nsweep({}, {'normal_force': [50.0]}, "
        "cycles=10, processes=1)\n"
    )
    done = subprocess.run(
        [sys.executable, str(script)],
        capture_output=True,
        text=True,
        timeout=60,
        env=os.environ | {"FRETTING_FMU": str(fmu_path)},
    )
    assert done.returncode == 1
    assert 'call sweep() under `if __name__ == "__main__":`' in done.stderr.splitlines()[-1]


def stiffness(contact):
    """A task that is not the usual one."""
    contact.step(tangential_displacement=1e-8)
    return {"stiffness": contact["tangential_stiffness"]}


def test_another_task_and_a_table_of_pandas(fmu_path):
    pandas = pytest.importorskip(
        "pandas", reason="pandas is not installed: see examples/sweep/sweep-requirements.txt"
    )
    over = pandas.DataFrame({"normal_force": [50.0, 400.0]})
    found = sweep(
        {"wear_coefficient": 0.0}, over, task=stiffness, fmu=fmu_path, processes=1, progress=False
    ).to_pandas()
    assert list(found.columns) == ["normal_force", "stiffness", "error", "warning"]
    # 2G*a of what sticks: nearly all, and a goes with the third root of the load
    assert found["stiffness"][1] / found["stiffness"][0] == pytest.approx(2.0, rel=0.01)


def test_a_map_has_a_mark_for_each_regime(swept):
    _, results, *_ = swept
    axes = results.plot("displacement_amplitude", "normal_force")
    assert [text.get_text() for text in axes.get_legend().get_texts()] == [
        "stick",
        "partial",
        "gross",
    ]
    assert axes.get_xscale() == "log" and len(axes.figure.axes) == 2


def test_an_unknown_column_is_answered_with_those_that_there_are():
    columns = {"radius": np.array(["10 mm"]), "load": np.ones(1), "wear_volume": np.ones(1)}
    results = SweepResult(columns, 1, 0)
    message = (
        r"loads is no column of the results \(did you mean load\?\); "
        "there are radius, load, wear_volume"
    )
    for use in (
        lambda: results["loads"],
        lambda: results.plot("load", "loads"),
        lambda: results.plot("load", "load", color="loads"),
    ):
        with pytest.raises(ParameterError, match=message):
            use()
    with pytest.raises(ParameterError, match="radius has texts, such as '10 mm': give a column"):
        results.plot("radius", "load")


def test_sets_from_a_file(tmp_path):
    path = tmp_path / "sets.csv"
    path.write_text(
        "profile,radius,resolution\nparabola,10 mm,64\ncone,0.02,128\n", encoding="utf-8"
    )
    assert read_sets(path).rows() == [
        {"profile": "parabola", "radius": "10 mm", "resolution": 64},
        {"profile": "cone", "radius": 0.02, "resolution": 128},
    ]
    path.write_text("profile,radius\nparabola\n", encoding="utf-8")
    with pytest.raises(SetsError, match=r"line 2: 1 value\(s\) for 2 name\(s\)"):
        read_sets(path)


def test_spread_sets_fill_their_ranges_evenly():
    over = {"normal_force": (10.0, 1000.0, "log"), "radius": (1.0, 2.0), "exponent": (2.0, 4.0)}
    columns = spread(over, 1000).columns
    shares = [
        np.log10(columns["normal_force"]) / 2 - 0.5,
        np.array(columns["radius"]) - 1,
        np.array(columns["exponent"]) / 2 - 1,
    ]
    for share in shares:
        counts, _ = np.histogram(share, bins=10, range=(0, 1))
        assert counts.sum() == 1000 and np.all(np.abs(counts - 100) <= 10)
    assert (
        spread(over, 10).columns["radius"] == columns["radius"][:10]
    )  # more sets are the same ones and further ones
    with pytest.raises(SetsError, match="low < high"):
        spread({"radius": (2.0, 1.0)}, 3)


@pytest.mark.parametrize("path", sorted(SWEEP.glob("*.py")), ids=lambda path: path.name)
def test_it_is_short(path):
    assert len(path.read_text(encoding="utf-8").splitlines()) < 100
