"""report.py: what counts as good, and what the page says of all results in one line."""

import pathlib
import sys
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parent))
import report  # noqa: E402
from report_test import Parsed, case, seams  # noqa: E402


class Headline(unittest.TestCase):
    def entry(self, kind, data, *problems):
        return {"kind": kind, "file": f"x/{kind}.json", "folder": "/nowhere",
                "problems": list(problems), "data": data}

    def page(self, *entries):
        return Parsed(report.page_of({"root": "r", "entries": list(entries)}))

    def test_numbers_that_contradict_the_verdict_are_not_good(self):
        for comparison in (None, 5, {}, {"identical": False, "differing": 8},
                           {"identical": True, "differing": 8}, {"identical": True}):
            page = self.page(self.entry("seams", seams(
                [case("a", "identical", comparison=comparison), case("b", "identical")])))
            self.assertIn("1 of 2 results to look at", page.text)
            self.assertIn("? 1 no verdict", page.text)
        noise = case("a", "within noise", comparison={"identical": True, "differing": 0})
        self.assertEqual(self.headline(self.entry("seams", seams([noise, case("b", "identical")]))),
                         "1 of 2 results to look at")

    def headline(self, *entries):
        source = report.page_of({"root": "r", "entries": list(entries)})
        return source[source.index("<h1>") + 4:source.index("</h1>")]

    def test_the_headline_counts_all_results(self):
        good = self.entry("seams", seams([case("a", "identical"), case("b", "identical")]))
        speedup = self.entry("speedup", {"rows": [], "complete": True})
        noise = self.entry("noise", {"noise": {}})
        self.assertEqual(self.headline(good, speedup, noise),
                         "All 2 cases are as they should be")
        self.assertEqual(self.headline(speedup), "1 speed-up measured")
        self.assertEqual(self.headline(speedup, speedup, noise),
                         "2 speed-ups and 1 noise floor measured")
        self.assertEqual(self.headline(), "No scene was compared")
        damaged = self.entry("noise", None, "parse error at line 3")
        self.assertEqual(self.headline(good, speedup, damaged), "1 of 4 results to look at")
        mpipov = {"kind": "mpipov", "name": "mpipov-static-2", "identical": False}
        for data in ({"rows": [], "complete": False}, {"rows": [{"failure": "no fire"}]},
                     {"rows": [mpipov], "order_dependent": False}):
            self.assertEqual(self.headline(good, noise, self.entry("speedup", data)),
                             "1 of 4 results to look at")
        for data in ({"rows": [mpipov], "order_dependent": True},
                     {"rows": [{**mpipov, "kind": "threads"}], "order_dependent": False}):
            self.assertEqual(self.headline(self.entry("speedup", data)), "1 speed-up measured")

    def test_a_bad_result_of_any_kind_is_in_the_table_and_linked(self):
        page = self.page(self.entry("noise", None, "parse error at line 3"))
        self.assertIn("✕ 1 damaged", page.text)
        self.assertIn("#noise-1", page.loads)
        self.assertIn("noise-1", [values.get("id") for _, values in page.tags])
        self.assertIn("parse error at line 3", page.text[:page.text.index("Noise: ")])


if __name__ == "__main__":
    unittest.main()
