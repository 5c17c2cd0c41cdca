#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Waylode authors
# SPDX-License-Identifier: Apache-2.0
"""The checker of docs/methods/README.md finds what is planted."""
import tempfile
import unittest
from pathlib import Path

import check_methods_table

GOOD = """
| ID | what | file | test |
|---|---|---|---|
| W-eq1 | mean | `engine/a.cpp` | `Mean.IsTheMean` |
| S-1 | app | app | - |
"""


class Checker(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        for name in ("engine", "cli", "tests", "docs/methods"):
            (self.root / name).mkdir(parents=True)
        (self.root / "engine/a.cpp").write_text("double mean();\n")
        (self.root / "engine/a_test.cpp").write_text("TEST(Mean, IsTheMean) {}\nRC_GTEST_PROP(Mean,\n    Shifts, ()) {}\n")

    def faults(self, table: str, ids=("W-eq1", "S-1")) -> list[str]:
        (self.root / check_methods_table.TABLE).write_text(table)
        return check_methods_table.check(self.root, list(ids))

    def test_a_good_table_is_clean(self):
        self.assertEqual(self.faults(GOOD), [])

    def test_properties_count_as_tests(self):
        self.assertEqual(self.faults(GOOD.replace("Mean.IsTheMean", "Mean.Shifts")), [])

    def test_a_missing_id_is_found(self):
        self.assertIn("W-eq2 has 0 rows", self.faults(GOOD, ("W-eq1", "W-eq2", "S-1"))[0])

    def test_a_second_row_is_found(self):
        self.assertIn("W-eq1 has 2 rows", self.faults(GOOD + GOOD.splitlines()[3] + "\n")[0])

    def test_a_file_that_is_gone_is_found(self):
        self.assertIn("no such file: engine/b.cpp", self.faults(GOOD.replace("a.cpp", "b.cpp"))[0])

    def test_a_test_that_is_gone_is_found(self):
        self.assertIn("no such test: Mean.IsNot", self.faults(GOOD.replace("IsTheMean", "IsNot"))[0])

    def test_a_row_without_file_or_test_is_found(self):
        faults = self.faults("| W-eq1 | mean | soon | soon |\n| S-1 | app | app | - |\n")
        self.assertEqual(len(faults), 2)

    def test_only_what_belongs_elsewhere_may_say_so(self):
        self.assertIn("names no file", self.faults(GOOD.replace("`engine/a.cpp`", "app"))[0])

    def test_an_unknown_id_is_found(self):
        self.assertIn("W-eq99 is no ID", self.faults(GOOD + "| W-eq99 | x | `engine/a.cpp` | `Mean.IsTheMean` |\n")[0])

    def test_a_missing_table_is_found(self):
        self.assertEqual(check_methods_table.check(self.root, ["W-eq1"]), [f"{check_methods_table.TABLE} is gone"])


if __name__ == "__main__":
    unittest.main()
