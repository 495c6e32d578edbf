"""report_tradeoff.py, tradeoff_crops.py, tradeoff_pictures.py: a trade-off on the page and as files."""

import json
import pathlib
import sys
import tempfile
import unittest
import unittest.mock

import numpy as np
from PIL import Image

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parent))
import report  # noqa: E402
import report_tradeoff  # noqa: E402
import tradeoff_crops  # noqa: E402
import tradeoff_pictures  # noqa: E402
from report_test import EVIL, Parsed, damaged_copies, save  # noqa: E402

WIDTH, HEIGHT = 96, 64
BAD = (70, 40)  # the middle of what is wrong in the worse pictures


def pixels(damage):
    y, x = np.mgrid[:HEIGHT, :WIDTH]
    found = np.stack([x * 500, y * 900, (x + y) * 300], axis=2).astype(np.uint16)
    found[BAD[1] - 3:BAD[1] + 3, BAD[0] - 3:BAD[0] + 3, 1] += damage
    return found


def row(name, seconds, error, **changes):
    spread = {"median": seconds, "low": seconds / 2, "high": seconds * 2}
    return {"name": name, "what": f"setting {name}", "sweep": "antialiasing",
            "command": f"povray {name}", "wall": [seconds], "cpu": [seconds],
            "wall_seconds": spread, "cpu_seconds": spread, "image": f"images/{name}.png",
            "varies": False, "serial": None, "against_serial": None, "failure": None,
            "against_truth": {"rms": error, "identical": False, "ssim": 0.98765}, **changes}


def tradeoff():
    law = {"seconds_at_1": 2, "exponent": 1, "halving_costs": 2, "from_error": 4, "to_error": 0.5}
    return {"format": "mpipov-tradeoff", "version": 1, "scene": "cube", "complete": True,
            "arguments": ["cube.pov", "+W96"], "image": {"width": WIDTH, "height": HEIGHT},
            "averaging": "linear", "failure": None, "notes": ["a note"],
            "left_out": [{"what": "radiosity", "why": "there is none"}],
            "truth": {"samples_per_pixel": 820, "error": 0.05, "share_of_best": 0.1,
                      "stopped": None, "image": "images/truth.png"},
            "rows": [row("fast", 0.5, 4), row("slow", 4, 0.5), row("worse", 4, 3)],
            "front": {"cpu": {"settings": ["fast", "slow"], "law": law},
                      "wall": {"settings": ["fast", "slow"], "law": None}},
            "sentence": "Halving the error costs 2.00 times the CPU time.",
            "picks": [{"limit": "--max-error", "value": 1, "setting": "slow",
                       "command": "povray slow"},
                      {"limit": "--max-seconds", "value": 0.1, "setting": None,
                       "command": None}]}


class Tradeoff(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        for name, damage in (("fast", 9000), ("slow", 300), ("worse", 5000), ("truth", 0)):
            save(self.folder / "images" / f"{name}.png", pixels(damage))

    def source(self, data, problems=()):
        return report.page_of({"root": "r", "entries": [
            {"kind": "tradeoff", "file": "tradeoff.json", "folder": str(self.folder),
             "problems": list(problems), "data": data}]})

    def test_the_section_shows_all(self):
        source = self.source(tradeoff())
        page = Parsed(source)
        self.assertIn("1 trade-off measured", page.text)
        for words in ("Accuracy against time: cube", "Halving the error costs 2.00 times",
                      "Truth: 820 samples a pixel, averaged in linear light; its own error is "
                      "0.0500 levels of 255, 10 % of the best setting’s.",
                      "--max-error 1.00", "--max-seconds 0.100: no setting does that",
                      "setting slow antialiasing ★ 4.00 2.00..8.00 4.00 2.00..8.00 0.500 0.98765 –",
                      "radiosity", "there is none", "a note", "povray worse"):
            self.assertIn(words, page.text)
        self.assertEqual(page.text.count("★"), 3)  # two rows and what it means
        self.assertIn("data:image/svg+xml", source)
        self.assertEqual(source.count("data:image/png"), 3)  # two of the front, the truth

    def test_crops_show_where_the_front_is_wrong(self):
        labelled, (x0, y0, x1, y1) = tradeoff_crops.crops_of(self.folder, tradeoff())
        self.assertEqual([label[0] for label, _ in labelled],
                         ["setting fast", "setting slow", "truth"])
        self.assertTrue(x0 < BAD[0] < x1 and y0 < BAD[1] < y1)
        self.assertEqual({p.shape for _, p in labelled}, {(36, 48, 3)})
        self.assertFalse((labelled[0][1] == labelled[2][1]).all())

    def test_of_many_settings_the_ends_are_shown(self):
        names = [str(i) for i in range(12)]
        self.assertEqual(tradeoff_crops.spread_out(names), ["0", "3", "6", "8", "11"])
        self.assertEqual(tradeoff_crops.spread_out(names[:5]), names[:5])

    def test_failures_are_told_and_escaped(self):
        data = tradeoff()
        data["rows"][2].update(failure=EVIL, name=EVIL, against_truth=None)
        data.update(sentence=EVIL, complete=False)
        source = self.source(data)
        self.assertNotIn("<script>alert", source)
        page = Parsed(source)
        self.assertIn("1 of 1 results to look at", page.text)
        self.assertIn("not complete", page.text)

    def test_pictures_that_are_gone_are_told(self):
        (self.folder / "images/truth.png").unlink()
        page = Parsed(self.source(tradeoff()))
        self.assertIn("No pictures: 'images/truth.png' is not there", page.text)
        self.assertIn("setting slow", page.text)

    def test_any_part_may_lack_or_be_something_else(self):
        tried = 0
        for path, value, data in damaged_copies(tradeoff()):
            with self.subTest(path=path, value=value), unittest.mock.patch(
                    "report_plots.error_by_seconds", return_value="data:,"):
                self.assertIn("</html>", self.source(data))
            tried += 1
        self.assertGreater(tried, 200)

    def test_panels_leave_out_what_no_logarithm_shows(self):
        data = tradeoff()
        data["rows"] += [row("exact", 1, 0), row("unmeasured", 1, 1, cpu_seconds=None)]
        cpu, wall = report_tradeoff.panels_of(data)
        self.assertEqual([p["name"] for p in cpu["points"]], ["fast", "slow", "worse"])
        self.assertEqual(cpu["law"]["halving_costs"], 2)
        self.assertIsNone(wall["law"])

    def test_files(self):
        file = self.folder / "tradeoff.json"
        file.write_text(json.dumps(tradeoff()))
        with unittest.mock.patch.object(sys, "argv", ["tradeoff_pictures.py", str(file)]):
            self.assertEqual(tradeoff_pictures.main(), 0)
        for name in ("tradeoff.png", "crops.png"):
            with Image.open(self.folder / name) as picture:
                self.assertGreater(picture.width, 600)
            self.assertLess((self.folder / name).stat().st_size, 120_000)


if __name__ == "__main__":
    unittest.main()
