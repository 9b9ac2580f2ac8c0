"""The replication of one paper, and studies of your own: configurations, rules, figures.

It uses the library ``nucleation``, which never imports it.
"""
