"""Everything that touches the disk: text, TOML, JSON, units, modules named by a path, the cache folder."""
