"""What finds the warnings of a script finds those of fmpy and those that an instance keeps."""

from scripts import run_with_warnings


def test_a_kept_message_is_found(fmu_path, tmp_path):
    own = tmp_path / "own.py"
    own.write_text(
        "import sys\nfrom fretting_contact.component import ContactFmu, FmuFile\n"
        "with FmuFile(sys.argv[1]) as file, ContactFmu(file) as contact:\n"
        "    contact.start(hardness=800.0)\n",
        encoding="utf-8",
    )
    _, (line,) = run_with_warnings(own, fmu_path)
    assert "hardness = 800 Pa" in line


def test_a_message_to_fmpy_is_found(fmu_path, tmp_path):
    simulated = tmp_path / "simulated.py"
    simulated.write_text(
        "import sys\nfrom fmpy import simulate_fmu\nsimulate_fmu(sys.argv[1], "
        "start_values={'hardness': 800})\n",
        encoding="utf-8",
    )
    _, (line,) = run_with_warnings(simulated, fmu_path)
    assert "hardness = 800 Pa" in line
