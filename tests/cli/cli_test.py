#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Waylode authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the built program ($WAYLODE_PROGRAM) as a user would. Exit statuses: contract/errors.toml."""
import csv
import io
import json
import math
import os
import resource
import shutil
import subprocess
import tempfile
import tomllib
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ["WAYLODE_PROGRAM"]
ILC_LOG = ROOT / "testdata/ilc_mini/mini.txt"
SCENARIO = """
name = "corridor"
seed = 11

[building]
name = "corridor"
cell_m = 1.0
drawing = '''
floor G level 0 elevation_m 0
##############################
#1.A.......2...B...........C3#
#............................#
#4.........5...D............6#
##############################
'''

[[walker]]
name = "survey"
survey = true
route = ["1", "2", "3", "6", "5", "4", "1", "3"]

[[walker]]
name = "guest"
route = ["4", "5", "6", "3", "2", "1"]
start_s = 600.0
"""
LOOP = """
name = "loop"
seed = 12

[building]
name = "loop"
cell_m = 1.0
drawing = '''
floor G level 0 elevation_m 0
##########################
#1......................2#
#.######################.#
#.######################.#
#.######################.#
#.######################.#
#.######################.#
#.######################.#
#.######################.#
#.######################.#
#4......................3#
##########################
'''

[[walker]]
name = "round"
survey = true
route = ["1", "2", "3", "4", "1"]
"""
VERBS = ["simulate", "inspect", "convert", "site", "track", "evaluate", "reproduce", "methods",
         "config", "version"]


def errors() -> dict:
    return tomllib.loads((ROOT / "contract/errors.toml").read_text(encoding="utf-8"))


def run(*words, **options) -> subprocess.CompletedProcess:
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, timeout=60,
                          check=False, **options)


def limit_file_size():
    resource.setrlimit(resource.RLIMIT_FSIZE, (512, 512))


class CliTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="waylode-cli-"))
        (cls.folder / "scenario.toml").write_text(SCENARIO, encoding="utf-8")
        cls.sim = cls.folder / "sim"
        cls.site = cls.folder / "corridor.wlsite"
        cls.simulated = run("simulate", cls.folder / "scenario.toml", "--out", cls.sim)
        cls.built = run("site", "build", cls.site, "--name", "corridor", "--plan",
                        cls.sim / "plan-G.geojson", cls.sim / "survey.mcap", "--json")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def file(self, name: str, content: bytes) -> Path:
        path = self.folder / name
        path.write_bytes(content)
        return path

    def assert_error(self, result, name: str, *mentions):
        """One line on stderr that names the error and the place; the registry's exit status."""
        self.assertEqual(result.returncode, errors()[name]["exit"], result.stderr)
        self.assertEqual(result.stdout, "")
        self.assertRegex(result.stderr, r"\Awaylode: [^\n]+ \[" + name + r"\]\n\Z")
        for mention in mentions:
            self.assertIn(str(mention), result.stderr)


class Help(CliTest):
    def test_root_lists_the_verbs_in_the_order_of_the_work(self):
        result = run("--help")
        self.assertEqual(result.returncode, 0)
        listed = result.stdout[result.stdout.index("Subcommands:"):]
        places = [listed.index("\n  " + verb + " ") for verb in VERBS]
        self.assertEqual(places, sorted(places))

    def test_every_verb_explains_itself_with_an_example(self):
        for words in [["simulate"], ["inspect"], ["convert"], ["site", "build"], ["site", "show"],
                      ["site", "from-walks"], ["track"], ["evaluate", "mcap"], ["reproduce"],
                      ["methods"], ["config", "dump"],
                      ["config", "check"]]:
            with self.subTest(words=words):
                result = run(*words, "--help")
                self.assertEqual(result.returncode, 0)
                self.assertIn("Example:\n  waylode " + " ".join(words), result.stdout)

    def test_usage_errors_are_one_line_and_status_2(self):
        for words in [[], ["fly"], ["inspect"], ["methods", "--yaml"],
                      ["track", "x", "--site", "y", "--format", "kml"]]:
            with self.subTest(words=words):
                self.assert_error(run(*words), "invalid_argument", "--help")

    def test_version_is_told(self):
        self.assertRegex(run("version").stdout, r"\Awaylode \d+\.\d+\.\d+\n\Z")


class Methods(CliTest):
    SLOTS = ["steps", "validity", "stride", "heading", "radio", "magnetic", "fusion"]

    def listed(self) -> dict:
        return json.loads(run("methods", "--json").stdout)

    def blocks(self) -> list:
        """Of the text: methods, what they are made of, parts, how to mix."""
        return [block.splitlines() for block in run("methods").stdout.split("\n\n")]

    def test_json_lists_what_the_table_lists(self):
        names = [method["name"] for method in self.listed()["methods"]]
        methods, recipes, parts, _ = self.blocks()
        self.assertEqual([line.split()[0] for line in methods[1:]], names)
        self.assertEqual([line.split()[0] for line in recipes[1:]], names)
        self.assertLessEqual({"wknn", "pdr", "wu2019", "zhou2016", "zhao2019", "zhong2017", "fused",
                              "smoothed"}, set(names))
        self.assertEqual([line.split()[:2] for line in parts[1:]],
                         [[part["slot"], part["name"]] for part in self.listed()["parts"]])

    def test_every_method_fills_every_slot_with_a_part_that_is_listed(self):
        told = self.listed()
        parts = {(part["slot"], part["name"]) for part in told["parts"]}
        self.assertEqual(len(parts), len(told["parts"]))
        for part in told["parts"]:
            self.assertEqual(list(part), ["slot", "name", "summary", "source"])
            self.assertTrue(all(part.values()), part)
        for method in told["methods"]:
            self.assertEqual(list(method["parts"]), self.SLOTS, method["name"])
            self.assertLessEqual(set(method["parts"].items()), parts, method["name"])

    def test_recipes_are_words_that_make_mixtures(self):
        recipes = {line.split()[0]: line.split()[1:] for line in self.blocks()[1][1:]}
        for method in self.listed()["methods"]:
            self.assertEqual(recipes[method["name"]],
                             [f"{slot}={part}" for slot, part in method["parts"].items()])

    def test_mixtures_track(self):
        words = ["track", self.sim / "guest.mcap", "--site", self.site, "--format", "json",
                 "--method"]
        result = run(*words, "wu2019+stride=kim+fusion=pairs")
        self.assertEqual(result.returncode, 0, result.stderr)
        fixes = json.loads(result.stdout)["fixes"]
        self.assertEqual({fix["method"] for fix in fixes}, {"wu2019+stride=kim+fusion=pairs"})
        self.assertTrue(any(fix["position"] for fix in fixes))
        self.assert_error(run(*words, "wu2019+stride=giant"), "method_unknown", "weinberg")
        self.assert_error(run(*words, "fused+radio=none"), "invalid_argument", "dead_reckoning")


class Reproduce(CliTest):
    def reproduce(self, *words):
        environment = {name: value for name, value in os.environ.items() if name != "WAYLODE_DATA"}
        return run("reproduce", *words, cwd=self.folder, env=environment)

    def test_prints_figures_and_counts_the_bars(self):
        out = self.folder / "zhao.json"
        report = self.folder / "zhao.html"
        result = self.reproduce("zhao2019", "--preset", "kernel", "--seeds", "2", "--report", report,
                                "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        last = result.stdout.splitlines()[-1]
        self.assertRegex(last, r"\Abars reached \d+ of \d+\Z")
        reached, judged = (int(word) for word in last.split() if word.isdigit())
        self.assertLessEqual(reached, judged)
        self.assertGreater(judged, 0)
        self.assertIn(f"report: {report}\n", result.stdout)
        self.assertIn("<html", report.read_text(encoding="utf-8"))
        json.loads(out.read_text(encoding="utf-8"))

    def test_same_seeds_give_the_same_figures(self):
        words = ["zhao2019", "--preset", "kernel", "--seeds", "2", "--report", "same.html"]
        first = self.reproduce(*words)
        self.assertEqual(self.reproduce(*words).stdout, first.stdout)
        self.assertNotEqual(self.reproduce(*words, "--first-seed", "9").stdout, first.stdout)

    def test_unknown_preset_names_the_known_ones(self):
        before = sorted(self.folder.iterdir())
        self.assert_error(self.reproduce("zhao2019", "--preset", "attic"), "invalid_argument",
                          "attic", "kernel", "harsh")
        self.assert_error(self.reproduce("all", "--preset", "kernel"), "invalid_argument", "kernel")
        self.assert_error(self.reproduce("smith1999"), "invalid_argument")
        self.assertEqual(sorted(self.folder.iterdir()), before)

    def test_results_that_could_not_be_kept_stop_it_before_work(self):
        missing = self.folder / "nowhere" / "out"
        for option in ("--out", "--report"):
            # The preset is unknown, too: the output is looked at first.
            result = self.reproduce("zhao2019", "--preset", "attic", option, missing)
            self.assert_error(result, "file_unwritable", missing)


class Inspect(CliTest):
    def test_json_counts_the_records_of_the_file(self):
        told = json.loads(run("inspect", ILC_LOG, "--json").stdout)
        lines = ILC_LOG.read_text(encoding="utf-8").splitlines()
        counted = [line for line in lines if "\tTYPE_WAYPOINT\t" in line]
        readings = [line for line in lines if "\tTYPE_WIFI\t" in line]
        self.assertEqual(told["format"], "ilc")
        self.assertEqual(told["kinds"]["waypoint"]["n"], len(counted))
        self.assertEqual(told["wifi"]["readings"], len(readings))
        self.assertEqual(told["wifi"]["transmitters"],
                         len({line.split("\t")[3] for line in readings}))

    def test_human_output_names_format_and_marks(self):
        result = run("inspect", ILC_LOG)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("format     ilc", result.stdout)
        self.assertIn("marks      3", result.stdout)

    def test_rejected_records_are_counted_by_reason(self):
        text = ILC_LOG.read_bytes() + b"1574659531598\tTYPE_ACCELEROMETER\tnan\t1\t2\t3\n"
        told = json.loads(run("inspect", self.file("bad_record.txt", text), "--json").stdout)
        self.assertEqual(sum(told["rejected"].values()), 1)

    def test_full_standard_output_is_an_error(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            result = subprocess.run([PROGRAM, "inspect", str(ILC_LOG)], stdout=full, text=True,
                                    stderr=subprocess.PIPE, check=False)
        self.assertEqual(result.returncode, errors()["file_unwritable"]["exit"])
        self.assertIn("standard output", result.stderr)


class BadInput(CliTest):
    def test_missing_file(self):
        missing = self.folder / "nowhere.txt"
        self.assert_error(run("inspect", missing), "file_not_found", missing)

    def test_empty_file(self):
        empty = self.file("empty.txt", b"")
        self.assert_error(run("inspect", empty), "log_empty", empty)

    def test_binary_file(self):
        binary = self.file("binary.bin", bytes(range(256)) * 40)
        self.assert_error(run("inspect", binary), "log_unrecognised", binary)

    def test_folder_instead_of_a_log(self):
        result = run("inspect", self.folder)
        self.assertIn(result.returncode, (3, 4))
        self.assertRegex(result.stderr, r"\Awaylode: [^\n]+\n\Z")
        self.assertIn(str(self.folder), result.stderr)

    def test_corrupt_bundle(self):
        whole = bytearray(self.site.read_bytes())
        whole[len(whole) // 2] ^= 0x10
        corrupt = self.file("corrupt.wlsite", bytes(whole))
        for verb in (["site", "show", corrupt], ["track", self.sim / "guest.mcap", "--site", corrupt]):
            self.assert_error(run(*verb), "bundle_corrupt", corrupt)
        self.assert_error(run("site", "show", self.file("log.wlsite", ILC_LOG.read_bytes())),
                          "bundle_corrupt")

    def test_site_without_map(self):
        bare = self.folder / "bare.wlsite"
        self.assertEqual(run("site", "build", bare, "--name", "bare", "--plan",
                             self.sim / "plan-G.geojson").returncode, 0)
        self.assert_error(run("track", self.sim / "guest.mcap", "--site", bare), "map_missing", "bare")

    def test_log_without_wifi_names_the_remedy(self):
        lines = ILC_LOG.read_text(encoding="utf-8").splitlines(keepends=True)
        silent = self.file("silent.txt",
                           "".join(x for x in lines if "TYPE_WIFI" not in x).encode())
        self.assert_error(run("track", silent, "--site", self.site), "log_lacks_records", silent,
                          "Wi-Fi")
        walked = run("track", silent, "--site", self.site, "--method", "pdr", "--start", "G,2,2",
                     "--format", "csv")
        self.assertEqual(walked.returncode, 0, walked.stderr)

    def test_survey_without_marks(self):
        lines = ILC_LOG.read_text(encoding="utf-8").splitlines(keepends=True)
        unmarked = self.file("unmarked.txt",
                             "".join(x for x in lines if "TYPE_WAYPOINT" not in x).encode())
        out = self.folder / "unmarked.wlsite"
        self.assert_error(run("site", "build", out, "--name", "x", unmarked), "survey_insufficient")
        self.assertFalse(out.exists())

    def test_broken_plan(self):
        plan = self.file("plan.geojson", b'{"type": "FeatureCollection"')
        self.assert_error(run("site", "build", self.folder / "x.wlsite", "--name", "x", "--plan", plan),
                          "plan_invalid", plan)

    def test_broken_scenario(self):
        scenario = self.file("broken.toml", b'name = "x"\nsped = 3\n')
        self.assert_error(run("simulate", scenario, "--out", self.folder / "never"),
                          "scenario_invalid", scenario)
        self.assertFalse((self.folder / "never").exists())

    def test_unknown_method_and_floor(self):
        guest = self.sim / "guest.mcap"
        self.assert_error(run("track", guest, "--site", self.site, "--method", "magic"),
                          "method_unknown", "wknn")
        self.assert_error(run("track", guest, "--site", self.site, "--floor", "F9"),
                          "floor_unknown", "F9", "G")
        self.assert_error(run("track", guest, "--site", self.site, "--method", "pdr"),
                          "invalid_argument", "start")
        for start in ("G,1", "G,1,nan", "G,a,2"):
            self.assert_error(run("track", guest, "--site", self.site, "--method", "pdr", "--start",
                                  start), "invalid_argument", start)


class FullDisk(CliTest):
    def assert_leaves_nothing(self, words, out: Path):
        before = sorted(self.folder.rglob("*"))
        result = run(*words, preexec_fn=limit_file_size)
        self.assert_error(result, "file_unwritable", out)
        self.assertEqual(sorted(self.folder.rglob("*")), before)

    def test_convert(self):
        out = self.folder / "full.mcap"
        self.assert_leaves_nothing(["convert", self.sim / "guest.mcap", out], out)

    def test_site_build(self):
        out = self.folder / "full.wlsite"
        self.assert_leaves_nothing(["site", "build", out, "--name", "full", "--plan",
                                    self.sim / "plan-G.geojson", self.sim / "survey.mcap"], out)

    def test_track(self):
        out = self.folder / "full.geojson"
        self.assert_leaves_nothing(["track", self.sim / "guest.mcap", "--site", self.site, "--out",
                                    out, "--rate-hz", "10"], out)

    def test_old_content_survives(self):
        out = self.file("old.geojson", b"old")
        run("track", self.sim / "guest.mcap", "--site", self.site, "--out", out, "--rate-hz", "10",
            preexec_fn=limit_file_size)
        self.assertEqual(out.read_bytes(), b"old")

    def test_devices_and_folders_are_never_replaced(self):
        for out in ("/dev/full", self.folder):
            self.assert_error(run("track", self.sim / "guest.mcap", "--site", self.site, "--out", out),
                              "file_unwritable", out)
            self.assert_error(run("convert", ILC_LOG, out), "file_unwritable", out)
        self.assertTrue(Path("/dev/full").is_char_device())


class Convert(CliTest):
    def test_keeps_what_inspect_tells(self):
        for compression in ("zstd", "none"):
            out = self.folder / f"mini-{compression}.mcap"
            result = run("convert", ILC_LOG, out, "--compression", compression)
            self.assertEqual(result.returncode, 0, result.stderr)
            before = json.loads(run("inspect", ILC_LOG, "--json").stdout)
            after = json.loads(run("inspect", out, "--json").stdout)
            self.assertEqual(after["format"], "mcap")
            for key in ("device_model", "duration_s", "kinds", "wifi", "marks_by_floor"):
                self.assertEqual(after[key], before[key], key)


class Site(CliTest):
    def test_build_reports_quality(self):
        self.assertEqual(self.built.returncode, 0, self.built.stderr)
        report = json.loads(self.built.stdout)
        self.assertEqual([floor["floor"] for floor in report["floors"]], ["G"])
        self.assertGreater(report["floors"][0]["fingerprints"], 10)
        self.assertGreater(report["floors"][0]["covered_ratio"], 0.5)

    def test_show_tells_what_was_built(self):
        shown = json.loads(run("site", "show", self.site, "--json").stdout)
        report = json.loads(self.built.stdout)
        self.assertEqual(shown["version"], report["version"])
        self.assertEqual(shown["fingerprints"], report["floors"][0]["fingerprints"])
        self.assertIn("not georeferenced", run("site", "show", self.site).stdout)

    def test_same_input_gives_the_same_bytes(self):
        again = self.folder / "again.wlsite"
        run("site", "build", again, "--name", "corridor", "--plan", self.sim / "plan-G.geojson",
            self.sim / "survey.mcap")
        self.assertEqual(again.read_bytes(), self.site.read_bytes())

    def test_floors_come_from_marks_without_a_plan(self):
        out = self.folder / "marks.wlsite"
        result = run("site", "build", out, "--name", "marks", self.sim / "survey.mcap", "--report",
                     self.folder / "quality.json")
        self.assertEqual(result.returncode, 0, result.stderr)
        floors = json.loads(run("site", "show", out, "--json").stdout)["floors"]
        self.assertEqual([floor["floor"] for floor in floors], ["G"])
        # The marks span 27 m by 2 m; 10 m are left around them.
        self.assertAlmostEqual(floors[0]["width_m"], 47.0, delta=1.0)
        self.assertIn("floors", json.loads((self.folder / "quality.json").read_text()))


class SiteFromWalks(CliTest):
    def from_walks(self, name: str, *words):
        scenario = self.file("loop.toml", LOOP.encode())
        run("simulate", scenario, "--out", self.folder / "loop")
        self.plan = self.folder / name
        return run("site", "from-walks", self.folder / "loop/round.mcap", "--out", self.plan,
                   "--landmarks", "NW,NE,SE,SW,NW", *words)

    def test_plan_of_a_walk_is_one_that_a_site_is_built_with(self):
        result = self.from_walks("walked.geojson", "--floor", "G", "--width", "3",
                                 "--known-distance", "NW:NE=23")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stdout, r"\Awrote \d+ corridors between \d+ places from 1 of 1 walks; ")
        self.assertEqual(json.loads(self.plan.read_text(encoding="utf-8"))["type"],
                         "FeatureCollection")
        site = self.folder / "walked.wlsite"
        built = run("site", "build", site, "--name", "walked", "--plan", self.plan)
        self.assertEqual(built.returncode, 0, built.stderr)
        floors = json.loads(run("site", "show", site, "--json").stdout)["floors"]
        self.assertEqual([floor["floor"] for floor in floors], ["G"])
        # The way round is 23 m by 9 m between the corners, however the plan lies.
        sides = sorted([floors[0]["width_m"], floors[0]["height_m"]])
        self.assertAlmostEqual(sides[1], 23.0 + 3.0, delta=3.0)
        self.assertAlmostEqual(sides[0], 9.0 + 3.0, delta=3.0)

    def test_distances_are_told_by_two_landmarks(self):
        for text in ("Door", "Door:Lift", "Door:Lift=far", "Door:Lift=nan", ":Lift=3", "Door:=3"):
            self.assert_error(self.from_walks("bad.geojson", "--known-distance", text),
                              "invalid_argument", text)
        self.assertFalse(self.plan.exists())

    def test_plan_that_could_not_be_kept_stops_it_before_work(self):
        out = self.folder / "nowhere" / "plan.geojson"
        self.assert_error(run("site", "from-walks", self.folder / "no.mcap", "--out", out),
                          "file_unwritable", out)

    def test_missing_log(self):
        missing = self.folder / "nowhere.mcap"
        self.assert_error(run("site", "from-walks", missing, "--out", self.folder / "x.geojson"),
                          "file_not_found", missing)


class Track(CliTest):
    def track(self, *words) -> str:
        result = run("track", self.sim / "guest.mcap", "--site", self.site, *words)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def truth(self) -> dict:
        rows = csv.DictReader((self.sim / "guest-truth.csv").read_text().splitlines())
        return {round(float(row["time_s"]), 1): (float(row["x_m"]), float(row["y_m"])) for row in rows}

    def test_fixes_follow_the_walker(self):
        truth = self.truth()
        errors_m = []
        for row in csv.DictReader(io.StringIO(self.track("--format", "csv"))):
            place = truth.get(round(float(row["time_s"]), 1))
            if place and row["x_m"]:
                errors_m.append(math.dist(place, (float(row["x_m"]), float(row["y_m"]))))
        self.assertGreater(len(errors_m), 20)
        self.assertLess(sorted(errors_m)[len(errors_m) // 2], 5.0)

    def test_broken_clock_does_not_fill_the_memory(self):
        log = self.file("clock.txt", ILC_LOG.read_bytes().replace(b"1700000000000\tTYPE_WAYPOINT",
                                                                  b"1000000000000\tTYPE_WAYPOINT"))
        self.assert_error(run("track", log, "--site", self.site, "--method", "pdr", "--start", "G,2,2"),
                          "invalid_argument", log)

    def test_cadence_is_steady(self):
        fixes = json.loads(self.track("--format", "json", "--rate-hz", "2"))["fixes"]
        gaps_s = [b["time_s"] - a["time_s"] for a, b in zip(fixes, fixes[1:])]
        self.assertTrue(all(abs(gap_s - 0.5) < 1e-6 for gap_s in gaps_s))

    def test_unknown_has_no_position_in_any_format(self):
        config = self.file("never_sure.toml", b"[fused.state]\nok_radius_m = 1e-6\n"
                                              b"show_radius_m = 1e-6\n")
        words = ("--config", config)
        for fix in json.loads(self.track("--format", "json", *words))["fixes"]:
            self.assertIn(fix["state"], ("unknown", "outside"))
            self.assertIsNone(fix["position"])
        for feature in json.loads(self.track(*words))["features"]:
            self.assertIsNone(feature["geometry"])
        rows = list(csv.reader(io.StringIO(self.track("--format", "csv", *words))))
        self.assertTrue(rows[1:])
        for row in rows[1:]:
            self.assertEqual(len(row), len(rows[0]))
            self.assertEqual(row[2:14], [""] * 12)

    def test_known_positions_carry_their_doubt(self):
        for fix in json.loads(self.track("--format", "json"))["fixes"]:
            self.assertEqual(fix["method"], "fused")
            self.assertEqual(fix["map_version"], json.loads(self.built.stdout)["version"])
            if fix["position"] is None:
                continue
            ellipse = fix["position"]["ellipse_95"]
            self.assertGreaterEqual(ellipse["semi_major_m"], ellipse["semi_minor_m"])
            self.assertGreater(ellipse["semi_minor_m"], 0.0)
            self.assertIsNone(fix["position"]["latitude_deg"])

    def test_file_holds_what_would_be_printed(self):
        out = self.folder / "guest.geojson"
        self.assertEqual(self.track("--out", out), "")
        self.assertEqual(out.read_text(), self.track())


class Simulate(CliTest):
    def test_writes_plans_logs_and_truth(self):
        self.assertEqual(self.simulated.returncode, 0, self.simulated.stderr)
        self.assertEqual(sorted(path.name for path in self.sim.iterdir()),
                         ["guest-truth.csv", "guest.mcap", "plan-G.geojson", "survey-truth.csv",
                          "survey.mcap"])

    def test_seed_decides(self):
        logs = []
        for name, seed in (("a", 5), ("b", 5), ("c", 6)):
            out = self.folder / name
            run("simulate", self.folder / "scenario.toml", "--out", out, "--seed", seed)
            logs.append((out / "guest.mcap").read_bytes())
        self.assertEqual(logs[0], logs[1])
        self.assertNotEqual(logs[0], logs[2])


class Evaluate(CliTest):
    """A hand-made tree: site "Mall, East wing" with floors F1 and F2, without plans."""
    KEYS = ["method", "group", "n", "mean_m", "p50_m", "p75_m", "p90_m", "p95_m", "ipin_p75_m",
            "floor_hit_ratio", "inside_68_ratio", "inside_95_ratio", "unknown_ratio",
            "n_before_scan", "n_ok", "ok_mean_m", "after10s_mean_m", "trace_floor_hit_ratio",
            "within_1_m", "within_1p5_m", "within_2_m", "within_3_m", "region_95_median_m2",
            "walked_s", "cpu_s"]
    SITE = "Mall, East wing"
    SPLIT = """site,floor,trace,split
"Mall, East wing",F1,a,train
"Mall, East wing",F1,b,train
"Mall, East wing",F1,t,test
"Mall, East wing",F2,a,train
"Mall, East wing",F2,b,train
"Mall, East wing",F2,t,test
"""

    def setUp(self):
        self.tree = Path(tempfile.mkdtemp(dir=self.folder))
        for floor, start_ms, network in (("F1", 1_700_000_000_000, 1), ("F2", 1_700_000_500_000, 2)):
            self.trace(floor, "a", start_ms, network)
            self.trace(floor, "b", start_ms + 100_000, network)
        self.trace("F1", "t", 1_700_001_000_000, 1)
        # Too far from where F2 was surveyed to be covered; heard from its first mark on.
        self.trace("F2", "t", 1_700_002_000_000, 2, y_m=25.0, first_scan_ms=0)

    def trace(self, floor, name, start_ms, network, y_m=5.0, first_scan_ms=2000, marks=3,
              extra=""):
        """Marks at 0, 5 and 10 s, 5 m apart; a scan every 2 s, its rows heard at its time."""
        lines = [(5000 * i, f"TYPE_WAYPOINT\t{5.0 + 5.0 * i}\t{y_m}") for i in range(marks)]
        for at_ms in range(0, 10_001, 200):
            lines.append((at_ms, "TYPE_ACCELEROMETER\t0.0\t0.0\t9.81\t3"))
        for at_ms in range(first_scan_ms, 10_001, 2000):
            for station in range(1, 5):
                lines.append((at_ms, f"TYPE_WIFI\tnet\t02:00:00:00:0{network}:0{station}\t"
                              f"{-40 - 5 * station - at_ms // 1000}\t2412\t{start_ms + at_ms}"))
        lines.sort(key=lambda line: line[0])
        folder = self.tree / self.SITE / floor / "path_data_files"
        folder.mkdir(parents=True, exist_ok=True)
        text = "".join(f"{start_ms + at_ms}\t{rest}\n" for at_ms, rest in lines) + extra
        (folder / f"{name}.txt").write_text(text, encoding="utf-8")
        return folder / f"{name}.txt"

    def evaluate(self, split=SPLIT, *words, methods="wknn,pdr,smoothed"):
        self.out = self.tree.parent / (self.tree.name + ".json")
        self.split = self.file(self.tree.name + ".csv", split.encode())
        return run("evaluate", "ilc", self.tree, "--split", self.split, "--methods", methods,
                   "--out", self.out, *words)

    def results(self) -> dict:
        rows = json.loads(self.out.read_text(encoding="utf-8"))["results"]
        return {(row["method"], row["group"]): row for row in rows}

    def test_json_is_the_contract_and_counts_are_right(self):
        folders = [path for path in self.tree.rglob("*") if path.is_dir()]
        for folder in folders:
            folder.chmod(0o555)
        result = self.evaluate()
        for folder in folders:
            folder.chmod(0o755)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        told = json.loads(self.out.read_text(encoding="utf-8"))
        self.assertEqual(list(told), ["dataset", "command", "results", "intervals", "findings"])
        self.assertEqual(told["dataset"], "ilc")
        self.assertEqual({tuple(row) for row in told["results"]}, {tuple(self.KEYS)})
        f1, f2 = self.SITE + "/F1", self.SITE + "/F2"
        # (n, n_before_scan). F1's first mark comes before its first scan, F2's with it; dead
        # reckoning is told the first mark; a whole-track method answers for every mark.
        self.assertEqual({key: (row["n"], row["n_before_scan"])
                          for key, row in self.results().items()},
                         {("wknn", "all"): (5, 1), ("wknn", "covered"): (2, 1),
                          ("wknn", f1): (2, 1), ("wknn", f2): (3, 0),
                          ("pdr", "all"): (4, 2), ("pdr", "covered"): (2, 1),
                          ("pdr", f1): (2, 1), ("pdr", f2): (2, 1),
                          ("smoothed", "all"): (6, 0), ("smoothed", "covered"): (3, 0),
                          ("smoothed", f1): (3, 0), ("smoothed", f2): (3, 0)})
        self.assertEqual({row["walked_s"] for (_, group), row in self.results().items()
                          if group == "all"}, {20.0})

    def test_plain_log_wins_over_packed_and_other_files_are_no_logs(self):
        folder = self.tree / self.SITE / "F1" / "path_data_files"
        (folder / "t.txt.zst").write_bytes(b"no zstd")
        (folder / "t.md").write_bytes(b"no log")
        self.assertEqual(self.evaluate(methods="wknn").stderr, "")
        self.assertEqual(self.results()["wknn", "all"]["n"], 5)

    def test_without_split_a_quarter_of_the_logs_is_test(self):
        for floor, network in (("F1", 1), ("F2", 2)):
            self.trace(floor, "c", 1_700_003_000_000, network)
            (self.tree / self.SITE / floor / "path_data_files" / "notes.md").write_text("no log")
        out = self.folder / "seeded.json"
        result = run("evaluate", "ilc", self.tree, "--methods", "smoothed", "--out", out)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        rows = json.loads(out.read_text(encoding="utf-8"))["results"]
        self.assertEqual([row["n"] for row in rows if row["group"] == "all"], [6])

    def test_what_is_left_out_is_noted(self):
        blind = self.trace("F1", "blind", 1_700_004_000_000, 1, marks=0)
        bad = self.trace("F1", "b", 1_700_000_100_000, 1,
                         extra="1700000110001\tTYPE_ACCELEROMETER\tnan\t1\t2\t3\n")
        split = (self.SPLIT + f'"{self.SITE}",F1,blind,test\n' + "z,F9,gone,test\nb,F1,a,train\n")
        result = self.evaluate(split, methods="wknn")
        self.assertEqual(result.returncode, 0, result.stderr)
        notes = result.stderr.splitlines()
        self.assertEqual(len(notes), 3, result.stderr)
        self.assertIn(f"{self.split}:9: 2 of 9 recordings match no log", notes[0])
        self.assertIn("z/F9/gone", notes[0])
        self.assertIn(f"{bad}: 1 bad records", notes[1])
        self.assertIn(f"{blind}: no mark", notes[2])
        self.assertEqual(self.results()["wknn", "all"]["n"], 5)

    def test_floor_without_map_names_the_trace(self):
        split = self.SPLIT.replace("F2,a,train", "F2,a,test").replace("F2,b,train", "F2,b,test")
        self.assert_error(self.evaluate(split), "map_missing", "F2/path_data_files/a.txt", "train")
        self.assertFalse(self.out.exists())

    def test_site_without_tests_is_not_mapped(self):
        other = self.tree / "other" / "F1" / "path_data_files"
        other.mkdir(parents=True)
        (other / "a.txt").write_bytes(b"")
        result = self.evaluate(self.SPLIT + "other,F1,a,train\n", methods="wknn")
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_size_without_drawing_is_used(self):
        info = self.tree / self.SITE / "F1" / "floor_info.json"
        info.write_text('{"map_info": {"height": 60.0, "width": 80.0}}', encoding="utf-8")
        self.assertEqual(self.evaluate(methods="wknn").returncode, 0)
        info.write_text('{"map_info": {"height": -1.0, "width": 80.0}}', encoding="utf-8")
        self.assert_error(self.evaluate(), "plan_invalid", info)

    def test_bad_splits_name_the_line(self):
        self.assert_error(self.evaluate("site,floor,trace\nx,F1,a\n"), "table_invalid",
                          f"{self.split}:1", "split")
        self.assert_error(self.evaluate(self.SPLIT + f'"{self.SITE}",F1,a,test\n'),
                          "table_invalid", f"{self.split}:8", "line 2")

    def test_missing_folder(self):
        missing = self.folder / "nowhere"
        self.assert_error(run("evaluate", "ilc", missing), "file_not_found", missing)
        self.assert_error(run("evaluate", "ipin", missing), "file_not_found", missing)

    def test_results_that_could_not_be_kept_stop_it_before_work(self):
        missing = self.folder / "nowhere"
        for option in ("--out", "--report"):
            # The data folder is missing too: the output is looked at first.
            result = run("evaluate", "ilc", missing, option, missing / "out.json")
            self.assert_error(result, "file_unwritable", missing / "out.json")
        self.assertFalse(missing.exists())

    def test_a_method_is_named_once(self):
        self.assert_error(self.evaluate(methods="wknn,fused,wknn"), "invalid_argument", "wknn")

    def test_uji_scores_rows_where_nothing_was_heard(self):
        header = b"WAP001,WAP002,LONGITUDE,LATITUDE,FLOOR,BUILDINGID\n"
        train = self.file("train.csv", header + b"-50,-70,0,0,0,1\n-70,-50,10,0,0,1\n")
        tests = self.file("tests.csv", header + b"-50,-70,1,0,0,1\n100,100,9,0,0,1\n")
        out = self.folder / "uji.json"
        result = run("evaluate", "uji", train, tests, "--out", out)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        rows = json.loads(out.read_text(encoding="utf-8"))["results"]
        self.assertEqual([(row["group"], row["n"], row["n_before_scan"]) for row in rows],
                         [("all", 2, 0), ("uji/1/0", 2, 0)])

    def test_ipin_passes_over_what_is_no_log_and_refuses_twins(self):
        mini = (ROOT / "testdata/getsensordata_mini/mini.txt").read_bytes()
        log = self.file("one_floor.txt", mini.replace(b"11.110964442580;1;1", b"11.110964442580;0;1"))
        tree = self.folder / "ipin"
        for name in "abcd":
            (tree / name).mkdir(parents=True)
            shutil.copy(log, tree / name / f"{name}.txt")
        readme = tree / "readme.txt"
        readme.write_text("About these logs\n", encoding="utf-8")
        result = run("evaluate", "ipin", tree, "--methods", "wknn")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn(f"{readme}: no log", result.stderr)
        shutil.copy(log, tree / "b" / "a.txt")
        self.assert_error(run("evaluate", "ipin", tree), "invalid_argument",
                          tree / "a" / "a.txt", tree / "b" / "a.txt")
        split = self.file("ipin.csv", b"log,split\nb,train\nc,test\n")
        result = run("evaluate", "ipin", tree, "--split", split, "--methods", "wknn")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertNotIn(str(readme), result.stderr)


class Config(CliTest):
    def test_default_toml_is_what_the_program_dumps(self):
        shipped = (ROOT / "config/default.toml").read_text(encoding="utf-8")
        self.assertEqual(run("config", "dump").stdout, shipped,
                         "config/default.toml is stale: waylode config dump > config/default.toml")

    def test_every_shipped_file_is_valid(self):
        files = sorted((ROOT / "config").glob("*.toml"))
        self.assertTrue(files)
        result = run("config", "check", *files)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_bad_keys_and_values_name_their_line(self):
        cases = {"[wknn]\nneigbours = 3\n": (2, "wknn.neigbours"),
                 "[wknn]\n\nneighbours = 2.5\n": (3, "wknn.neighbours"),
                 "[wknn]\nneighbours = 201\n": (2, "[1, 200]"),
                 "[matcher]\ndistance = \"far\"\n": (2, "sorensen"),
                 "[wkn]\nx = 1\n": (1, "wkn"),
                 "[fused.planar]\nstart_sigma_m = nan\n": (2, "start_sigma_m"),
                 "wknn = 3\n": (1, "wknn"),
                 "[wknn\n": (1, "")}
        for text, (line, mention) in cases.items():
            with self.subTest(text=text):
                path = self.file("bad.toml", text.encode())
                self.assert_error(run("config", "check", path), "invalid_options", f"{path}:{line}",
                                  mention)

    def test_values_that_do_not_fit_together_name_the_file(self):
        path = self.file("clash.toml", b"[wknn]\nneighbours = 4\nfloor_neighbours = 9\n")
        self.assert_error(run("config", "check", path), "invalid_options", path, "floor_neighbours")

    def test_configuration_changes_the_result(self):
        config = self.file("one.toml", b"[wknn]\nneighbours = 1\nfloor_neighbours = 1\n")
        words = ["track", self.sim / "guest.mcap", "--site", self.site, "--method", "wknn"]
        self.assertNotEqual(run(*words, "--config", config).stdout, run(*words).stdout)


if __name__ == "__main__":
    unittest.main()
