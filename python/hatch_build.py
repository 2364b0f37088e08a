"""Gives the wheel the tag of the platforms that the FMU inside has libraries for."""

import os
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

VARIABLE = "FRETTING_WHEEL_TAG"


class PlatformTag(BuildHookInterface):
    """Takes the tag from the environment; `cargo fmu wheel` reads it from the libraries."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        if version == "editable":
            return  # uses the FMU of the checkout
        if not os.environ.get(VARIABLE):
            raise RuntimeError(f"{VARIABLE} is not set: build the wheel with `cargo fmu wheel`")
        build_data["pure_python"] = False
        build_data["tag"] = os.environ[VARIABLE]
