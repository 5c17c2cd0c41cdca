# SPDX-FileCopyrightText: The Waylode authors
# SPDX-License-Identifier: Apache-2.0
"""Planted violations must be found, at their line, and clean trees must pass."""
import tempfile
import unittest
from pathlib import Path

import check_docs_paths
import check_layers

TABLE = """# Page

| Module | May include | Never |
|---|---|---|
| `core` | std | anything of ours |
| `site`, `sample` | `core` | `pdr` |
| `pdr` | `core` `sample` | `site` |
| `cli` | `core` `site` | `pdr` |

`core` after the table is no row.
"""


class Tree(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.write("ARCHITECTURE.md", TABLE)
        self.write("engine/waylode/core/CMakeLists.txt", "waylode_module(core HEADERS a.hpp)\n")
        self.write("engine/waylode/sample/CMakeLists.txt",
                   "waylode_module(sample\n  HEADERS s.hpp\n  DEPENDS core\n  LIBRARIES fmt::fmt)\n")

    def write(self, name: str, text: str):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


class CheckLayers(Tree):
    def test_accepts_what_the_table_allows(self):
        self.write("engine/waylode/pdr/a.cpp",
                   '#include "waylode/pdr/a.hpp"\n#include "waylode/sample/s.hpp"\n')
        self.write("cli/main.cpp", '#include "waylode/site/a.hpp"\n')
        self.assertEqual(check_layers.check(self.root), [])

    def test_finds_a_forbidden_include(self):
        self.write("engine/waylode/pdr/a.cpp", '\n#include "waylode/site/site.hpp"\n')
        self.assertEqual(check_layers.check(self.root),
                         ["engine/waylode/pdr/a.cpp:2: `pdr` may not include `site`"])

    def test_finds_a_forbidden_include_in_a_folder_beside_the_engine(self):
        self.write("cli/deep/main.cpp", '#  include <waylode/pdr/a.hpp>\n')
        self.assertEqual(check_layers.check(self.root),
                         ["cli/deep/main.cpp:1: `cli` may not include `pdr`"])

    def test_finds_a_module_outside_the_table(self):
        self.write("engine/waylode/extra/CMakeLists.txt", "waylode_module(extra)\n")
        self.assertEqual(check_layers.check(self.root),
                         ["engine/waylode/extra/CMakeLists.txt:1: `extra` has no row in ARCHITECTURE.md"])

    def test_finds_a_forbidden_dependency(self):
        self.write("engine/waylode/site/CMakeLists.txt",
                   "# A comment\nwaylode_module(site\n  SOURCES a.cpp\n  DEPENDS core pdr\n  TESTS t.cpp)\n")
        self.assertEqual(check_layers.check(self.root),
                         ["engine/waylode/site/CMakeLists.txt:4: `site` may not depend on `pdr`"])

    def test_keeps_detail_headers_private(self):
        self.write("engine/waylode/pdr/a.hpp", '#include "waylode/sample/detail/s.hpp"\n')
        self.write("engine/waylode/sample/s.cpp", '#include "waylode/sample/detail/s.hpp"\n')
        self.assertEqual(check_layers.check(self.root),
                         ["engine/waylode/pdr/a.hpp:1: waylode/sample/detail is private to `sample`"])

    def test_refuses_a_page_without_the_table(self):
        self.write("ARCHITECTURE.md", "# Page\n")
        self.assertEqual(len(check_layers.check(self.root)), 1)


class CheckDocsPaths(Tree):
    def problems(self, text: str):
        self.write("README.md", text)
        return check_docs_paths.missing_in(self.root, self.root / "README.md", {"test"})

    def test_accepts_what_exists_and_what_is_no_path(self):
        self.assertEqual(self.problems("`engine/waylode/core` `ARCHITECTURE.md` `Result<T>` `x + y`\n"
                                       "[page](ARCHITECTURE.md#page) `make test` `build/demo/r.html`\n"), [])

    def test_finds_a_missing_path(self):
        self.assertEqual(self.problems("\nsee `engine/gone.cpp`\n"),
                         ["README.md:2: no such path: engine/gone.cpp"])

    def test_finds_a_broken_link(self):
        self.assertEqual(self.problems("[page](docs/gone.md)\n"),
                         ["README.md:1: no such path: docs/gone.md"])

    def test_finds_a_missing_verb(self):
        self.assertEqual(self.problems("`make coffee`\n"),
                         ["README.md:1: no such verb: make coffee"])


if __name__ == "__main__":
    unittest.main()
