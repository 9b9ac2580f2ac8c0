# The linear theory, and what holds the solver against mathematics (docs/verification.md).
make_rule(
    "theory",
    call="nucleation.theory.curves:theory_dataset",
    shows="theory",
    priority=1,
    loads=plugins(settings.base),
    interface=asdict(settings.main_text_interface),
    message="Theory: critical lengths and friction curves",
    **CONFIGURED("material", "friction", "curves"),
)

# Single modes of homogeneous sliding, integrated in time, beside the spectrum.
make_rule(
    "dispersion",
    call="nucleation.verification.dispersion:files",
    shows="dispersion",
    priority=3,  # the verdicts wait for it, and nothing that it needs
    loads=plugins(settings.base),
    message="Dispersion: growth of single modes, time integration and theory",
    **CONFIGURED("material", "friction", "loading"),
)

# The same between two sliding layers, for Eqs. (7) and (8).
make_rule(
    "pair_modes",
    call="nucleation.verification.pair_modes:files",
    shows="pair_modes",
    loads=plugins(settings.base),
    message="Growth of single modes between two layers, time integration and theory",
    **CONFIGURED("material", "friction", "loading"),
)

# Orders of convergence on manufactured solutions, which depend on no configuration.
make_rule(
    "verification",
    call="nucleation.verification.orders:files",
    shows="verification",
    loads=EVOLUTIONS,
    message="Convergence: errors of manufactured solutions against element size and time step",
)

make_rule(
    "write_table_s1",
    call="nucleation.figures.paper.table_s1:files",
    shows="tables/table_s1",
    suffix="md",
    local=True,
    loads=plugins(settings.base),
    message="Table S1: parameters of the friction law",
    **CONFIGURED("friction"),
)
