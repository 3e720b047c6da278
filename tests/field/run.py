"""run.py NN-name: copies the folder of that name, runs every row that a table has for it, and says
which failed. Without a name: that every row has its folder, and every folder a row."""

import shutil
import sys
import unittest
from pathlib import Path

import tables
from checks import Tool

HERE = Path(__file__).parent


class Case(Tool):
    name = ""

    def runTest(self):
        rows = tables.ROWS[self.name]
        shutil.copytree(HERE / self.name, self.dir, dirs_exist_ok=True)
        for row in rows:
            with self.subTest(row=str(row)):
                row.check(self)


class Tables(unittest.TestCase):
    def runTest(self):
        folders = {path.name for path in HERE.glob("[0-9][0-9]-*")}
        self.assertEqual(folders, set(tables.ROWS))
        for name in folders:
            self.assertTrue((HERE / name / "PROVENANCE").is_file(), name)


if __name__ == "__main__":
    case = Tables()
    if len(sys.argv) > 1:
        case = Case()
        case.name = sys.argv[1]
    result = unittest.TextTestRunner().run(case)
    sys.exit(not result.wasSuccessful())
