"""The sweep on Dask: all sets come out, with a worker killed on the way and after a stop, and the regimes are those of Mindlin."""

import os
import signal
import sys

import numpy as np
import pytest
from conftest import ROOT

distributed = pytest.importorskip("distributed", reason="Dask is not installed: see examples/sweep/sweep-requirements.txt")
pytest.importorskip("pyarrow", reason="pyarrow is not installed: see examples/sweep/sweep-requirements.txt")
SWEEP = ROOT / "examples" / "sweep"
sys.path.insert(0, str(SWEEP))

import dask  # noqa: E402
from contact import run_batch  # noqa: E402
from regimes import draw, full_slip  # noqa: E402
from sweep import LOSSES, parts, sets, sweep  # noqa: E402

COUNT, CYCLES = 240, 1e4


@pytest.fixture(scope="module")
def client():
    with dask.config.set({"distributed.scheduler.allowed-failures": LOSSES}):
        with distributed.Client(n_workers=2, threads_per_worker=1, dashboard_address=None) as client:
            client.upload_file(str(SWEEP / "contact.py"))
            yield client


@pytest.fixture(scope="module")
def swept(client, fmu_path, tmp_path_factory):
    """A sweep of which one worker is killed while it runs."""
    out, killed = tmp_path_factory.mktemp("sweep"), []

    def kill_one(_):
        if not killed:
            killed.append(next(iter(client.run(os.getpid).values())))
            os.kill(killed[0], signal.SIGKILL)

    table, run = sweep(client, fmu_path, out, COUNT, CYCLES, kill_one)
    return out, table.to_pydict(), run, killed


def test_every_set_comes_out_once_with_a_worker_killed(client, fmu_path, swept):
    _, results, run, killed = swept
    assert len(killed) == 1 and killed[0] not in client.run(os.getpid).values()
    loads, amplitudes = sets(COUNT)
    assert run == COUNT and results["load"] == loads.tolist() and results["amplitude"] == amplitudes.tolist()
    here = run_batch(fmu_path.read_bytes(), loads[:5].tolist(), amplitudes[:5].tolist(), CYCLES)
    for name in ("wear_volume", "force_amplitude", "regime"):
        assert results[name][:5] == [row[name] for row in here], name  # to the bit, whoever ran it


def test_started_again_it_runs_what_is_missing(client, fmu_path, swept):
    out, results, *_ = swept
    path, first, last = parts(out, COUNT)[3]
    path.unlink()
    table, run = sweep(client, fmu_path, out, COUNT, CYCLES, lambda _: None)
    assert run == last - first
    assert table.to_pydict() == results


def test_regimes_are_those_of_the_closed_form(swept):
    _, results, *_ = swept
    slips = np.array(results["amplitude"]) / full_slip(results["load"])
    expected = np.where(slips >= 1, "gross", np.where(np.sqrt(np.clip(1 - slips, 0, None)) > 0.95, "stick", "partial"))
    assert results["regime"] == expected.tolist()
    assert set(results["regime"]) == {"stick", "partial", "gross"}
    assert np.all(np.array(results["wear_volume"]) > 0)


def test_the_map_is_a_picture_and_counts(swept, tmp_path):
    _, results, *_ = swept
    text = draw(results, tmp_path / "map.png")
    assert (tmp_path / "map.png").stat().st_size > 20_000
    assert sum(results["regime"].count(name) for name in ("stick", "partial", "gross")) == COUNT
    assert f"'gross': {results['regime'].count('gross')}" in text


@pytest.mark.parametrize("path", sorted(SWEEP.glob("*.py")), ids=lambda path: path.name)
def test_it_is_short(path):
    assert len(path.read_text(encoding="utf-8").splitlines()) < 100
