"""Print what the workflow can be asked for."""

listing = snakemake.params.listing
width = max(map(len, listing))
for name, text in listing.items():
    print(f"{name:{width}}  {text}")
