# Where the theory is right, over the block's height and the weakening of friction: the role `map`,
# of a thousand runs that take seconds each, in batches.
MAP = f"{RESULTS}/map.nc"


rule gather_map:
    input:
        needed(lengths_of("map"), "study with role: map"),
    output:
        dataset=MAP,
        table=f"{RESULTS}/map.csv",
    log:
        f"{RESULTS}/logs/map.log",
    params:
        **made_by("gather_map.py"),
    message:
        "The map of lengths over height and weakening"
    script:
        "../scripts/gather_map.py"
