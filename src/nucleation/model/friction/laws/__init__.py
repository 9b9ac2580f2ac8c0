"""The laws of the friction coefficient, one file each; its name is the law's name."""
