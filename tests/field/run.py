"""run.py NN-name, in the folder of a suite (tests/field, tests/truth): copies the folder of that name,
runs every row that the suite's tables have for it, and says which failed. Without a name: that every
row has its folder, and every folder a row."""

import shutil
import sys
import unittest
from pathlib import Path

SUITE = Path.cwd()
sys.path.insert(0, str(SUITE))

import tables  # noqa: E402
from checks import Tool  # noqa: E402


class Case(Tool):
    name = ""

    def runTest(self):
        rows = tables.ROWS[self.name]
        shutil.copytree(SUITE / self.name, self.dir, dirs_exist_ok=True)
        for row in rows:
            with self.subTest(row=str(row)):
                row.check(self)


class Tables(unittest.TestCase):
    def runTest(self):
        folders = {path.name for path in SUITE.glob("[0-9][0-9]-*")}
        self.assertEqual(folders, set(tables.ROWS))
        for name in folders:
            self.assertTrue((SUITE / name / "PROVENANCE").is_file(), name)


if __name__ == "__main__":
    case = Tables()
    if len(sys.argv) > 1:
        case = Case()
        case.name = sys.argv[1]
    result = unittest.TextTestRunner().run(case)
    sys.exit(not result.wasSuccessful())
