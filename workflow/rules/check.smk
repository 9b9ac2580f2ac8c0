# What of the results is stale, incomplete, damaged or foreign, without running anything else.
localrules:
    check,


rule check:
    message:
        f"Check of {RESULTS}"
    script:
        "../scripts/check.py"
