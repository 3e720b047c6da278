"""All tables: name of a folder → its rows."""

import gltf_rows
import text_rows

ROWS = {}
for table in (text_rows.ROWS, gltf_rows.ROWS):
    assert not ROWS.keys() & table.keys(), "a folder has rows in two tables"
    ROWS.update(table)
