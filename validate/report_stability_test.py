"""report_stability.py: a scene's conditioning on the page, alone and beside its seams."""

import pathlib
import sys
import tempfile
import unittest

import numpy as np

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parent))
import report  # noqa: E402
from report_test import EVIL, Parsed, damaged_copies, save  # noqa: E402


def move(size, answering):
    return {"move": size, "differing": answering + 1, "answering": answering, "mean": 0.5,
            "rms": 2.5, "largest": 128, "nonfinite": 0, "amplification": 1.147e11}


def stability():
    return {"format": "mpipov-stability", "version": 1, "scene": "coincident", "complete": True,
            "arguments": ["coincident.pov", "+W16"], "image": {"width": 16, "height": 12},
            "failure": None, "moved_by": "scale", "cameras": 1,
            "reference": {"image": "images/as-it-is.png"}, "map": "answers.png",
            "moves": [move(1e-12, 40), move(1e-9, 41), move(1e-6, 42)],
            "control": None, "noise_mean": None,
            "verdict": {"verdict": "ill-conditioned", "well": False, "why": "40 pixels change"}}


class Stability(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        for name in ("images/as-it-is.png", "answers.png"):
            save(self.folder / name, np.full((12, 16, 3), 99, np.uint8))

    def source(self, data, kind="stability", problems=()):
        return report.page_of({"root": "r", "entries": [
            {"kind": kind, "file": f"{kind}.json", "folder": str(self.folder),
             "problems": list(problems), "data": data}]})

    def test_the_section_shows_all(self):
        source = self.source(stability())
        page = Parsed(source)
        for words in ("1 conditioning measured", "Conditioning: coincident",
                      "ill-conditioned : 40 pixels change", "1e-12 41 40 0.500 2.50 128 1.15e+11",
                      "the camera’s place times 1 + move", "16 × 12 pixels"):
            self.assertIn(words, page.text)
        self.assertEqual(source.count("data:image/png"), 2)
        self.assertNotIn("(control)", page.text)

    def test_a_control_and_what_is_not_finite(self):
        data = stability()
        data["control"] = move(1e-3, 7)
        data["moves"][0]["nonfinite"] = 12
        text = Parsed(self.source(data)).text
        self.assertIn("0.001 (control)", text)
        self.assertIn("12 samples not finite", text)

    def test_what_was_not_measured_is_told(self):
        data = stability()
        data.update(complete=False, failure="cannot move the camera", verdict=None, moves=[])
        text = Parsed(self.source(data)).text
        self.assertIn("1 of 1 results to look at", text)
        self.assertIn("not complete: cannot move the camera", text)

    def test_pictures_that_are_gone_are_told(self):
        (self.folder / "answers.png").unlink()
        self.assertIn("No picture: 'answers.png' is not there",
                      Parsed(self.source(stability())).text)

    def test_names_are_escaped(self):
        data = stability()
        data.update(scene=EVIL)
        data["verdict"].update(why=EVIL, verdict=EVIL)
        self.assertNotIn("<script>alert", self.source(data))

    def test_beside_seams(self):
        case = {"name": "a", "image": "b.png", "reference": "default",
                "comparison": {"identical": False, "differing": 3, "largest": None},
                "verdict": {"verdict": "ill-conditioned", "ok": True, "why": "the scene is"}}
        found = {"format": "mpipov-seams", "version": 1, "scene": "s", "complete": True,
                 "effects": {}, "image": {}, "cases": [case],
                 "conditioning": {**stability(), "failure": None}}
        text = Parsed(self.source(found, "seams")).text
        self.assertIn("The case is as it should be", text)
        self.assertIn("ill-conditioned: 40 pixels change", text)
        found["conditioning"] = {"failure": "POV-Ray says no", "moves": []}
        self.assertIn("Not measured: POV-Ray says no", Parsed(self.source(found, "seams")).text)

    def test_any_part_may_lack_or_be_something_else(self):
        for path, value, data in damaged_copies(stability()):
            with self.subTest(path=path, value=value):
                self.assertIn("</html>", self.source(data))


if __name__ == "__main__":
    unittest.main()
