"""Remove datasets of earlier parameters or code, which the present configuration does not use."""

from pathlib import Path

from nucleation.pipeline import check, keys

wanted = set(snakemake.params.wanted)
for path in check.files(Path(snakemake.params.results)):
    key = keys.key_in(path)
    if key and key not in wanted:
        Path(path).unlink()
        print(f"removed {path}")
