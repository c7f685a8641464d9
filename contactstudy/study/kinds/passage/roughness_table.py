"""The table ``[roughness]``: measured third-octave levels that the map of trust shows."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import numpy as np

from contactstudy.exceptions import InputError
from contactstudy.irregularity.table import read_numbers
from contactstudy.validation import File, Parameters, raise_if

_METRES = {"m": 1.0, "cm": 1e-2, "mm": 1e-3}


@dataclass(frozen=True)
class RoughnessTable(Parameters):
    """Levels in dB re 1 um over the wavelength; rows of one wavelength are averaged by energy."""

    file: Annotated[str, File(), "CSV file with third-octave levels, drawn into a map"] = ""
    wavelength_column: Annotated[str, "column with the wavelength"] = "wavelength"
    wavelength_unit: Annotated[Literal["m", "cm", "mm"], "its unit"] = "m"
    level_column: Annotated[str, "column with the level in dB re 1 um"] = "level"

    def levels(self) -> list[list[float]]:
        """Wavelength in m and level in dB of each band, by wavelength; empty without a file.

        Raises
        ------
        InputError
            Naming file, line and value of everything that cannot be used.
        """
        if not self.file:
            return []
        path, columns = Path(self.file), (self.wavelength_column, self.level_column)
        if columns[0] == columns[1]:
            raise InputError(
                f"roughness.level_column = {columns[1]}: must be another column than "
                "roughness.wavelength_column"
            )
        table, lines, faults = read_numbers(path, columns)
        faults += [
            f"{path}, line {line}: the wavelength is {wave:g}; must be above 0"
            for (wave, _), line in zip(table, lines, strict=True)
            if wave <= 0.0
        ]
        raise_if(faults or ([] if len(table) else [f"{path}: has no rows"]))
        wave = table[:, 0] * _METRES[self.wavelength_unit]
        bands = np.unique(np.round(np.log10(wave), 6))
        energy = 10.0 ** (0.1 * table[:, 1])
        of_band = [energy[np.abs(np.log10(wave) - band) < 1e-5].mean() for band in bands]
        return [
            [float(f"{10.0**band:.6g}"), float(10.0 * np.log10(mean))]
            for band, mean in zip(bands, of_band, strict=True)
        ]
