"""All tables: name of a folder → its rows."""

import gltf_rows
import light_rows
import text_rows

ROWS = {}
for table in (gltf_rows.ROWS, light_rows.ROWS, text_rows.ROWS):
    assert not ROWS.keys() & table.keys(), "a folder has rows in two tables"
    ROWS.update(table)
