"""report.py: pages of complete, failed and damaged results."""

import base64
import copy
import html.parser
import io
import json
import pathlib

import subprocess
import sys
import tempfile
import unittest
import unittest.mock
import xml.etree.ElementTree

import numpy as np
import OpenImageIO as oiio
from PIL import Image

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parent))
import report  # noqa: E402

WIDTH, HEIGHT, SEAM = 96, 64, 48
EVIL = '<script>alert("x")</script>\' onload=x {{ 7 * 7 }} $\\frac{'


def scene_pixels():
    x, y = np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT))
    return np.stack([x * 2, y * 3, (x + y) % 200], axis=2).astype(np.uint8)


def stitched_pixels():
    pixels = scene_pixels()
    pixels[20:24, SEAM:SEAM + 2, 1] += 40
    return pixels


def save(file, pixels):
    file.parent.mkdir(parents=True, exist_ok=True)
    depth = {"uint8": "uint8", "uint16": "uint16", "float32": "float"}[str(pixels.dtype)]
    out = oiio.ImageOutput.create(str(file))
    out.open(str(file), oiio.ImageSpec(pixels.shape[1], pixels.shape[0], pixels.shape[2], depth))
    assert out.write_image(pixels), out.geterror()
    out.close()


def comparison(differing=8):
    side = {"pixels": 64, "differing": differing, "mean_abs": 2.5, "rms": 3, "max": 40}
    return {"unit": "level", "full_scale": 255.0, "identical": differing == 0,
            "pixels": WIDTH * HEIGHT, "differing": differing, "psnr": 49.25,
            "mean_abs": {"levels": 0.0174, "full_scale": 0.0174 / 255},
            "rms": {"levels": 0.83, "full_scale": 0.83 / 255},
            "largest": {"levels": 40, "full_scale": 40 / 255, "x": SEAM, "y": 20, "channel": "G",
                        "a": 60, "b": 100} if differing else None,
            "ssim": {"value": 0.99123, "reason": None},
            "run": {"by_distance": [{"distance": d, "before": side, "after": side}
                                    for d in range(32)],
                    "interior": {**side, "mean_abs": 0.25},
                    "seams": [{"a": 0, "b": 1, "vertical": True, "position": SEAM, "from": 0,
                               "to": HEIGHT}],
                    "step": {"seams": {"lines": 1, "mean_step": 1.25, "local_step": 2.5},
                             "controls": {"lines": 2, "mean_step": 0.5, "local_step": 0.75}}}}


def case(name, verdict, **changes):
    return {"name": name, "schedule": "dynamic", "ranks": 2, "shape": "columns", "seams": "plain",
            "halo": 0, "sections": 2, "failure": None, "image": f"{name}/image.png", "run": None,
            "reference": "default", "comparison": comparison(0 if verdict == "identical" else 8),
            "self_check": {"seams": 1, "checked": 1, "disagreed": 0, "repaired": 0,
                           "would_catch": 1},
            "verdict": {"verdict": verdict, "ok": verdict in ("identical", "within noise"),
                        "why": f"because of {name}", "pixel_test": None, "step_test": None},
            "seconds": 12.5, **changes}


def seams(cases, **changes):
    return {"format": "mpipov-seams", "version": 1, "scene": "cube", "file": "my scenes/cube.pov",
            "arguments": ["+W96", "+H64"], "complete": True, "failure": None,
            "image": {"width": WIDTH, "height": HEIGHT, "channels": 3, "depth": "uint8",
                      "type": "png"},
            "versions": {"mpipov": "0.1.0", "povray": "3.7.0.10"},
            "effects": {"radiosity": {"on": True, "why": "Radiosity Time is given"}},
            "references": {"default": {"image": "serial.png", "argv": ["povray"], "seconds": 2}},
            "noise": {"renders": [{"name": "RP2", "argv": ["povray", "+RP2"], "mean": 0.3}],
                      "mean": {"low": 0.3, "high": 0.4, "mean": 0.35}, "sigma": 1.5,
                      "by_distance": [{"distance": d, "low": 1, "high": 2} for d in range(32)]},
            "cases": cases, **changes}


def damaged_copies(whole):
    """Each part of it missing, or something else: (its path, what it became, all of the copy)."""
    def paths(value, path=()):
        if path:
            yield path
        entries = value.items() if isinstance(value, dict) else \
            enumerate(value[:2]) if isinstance(value, list) else ()
        for key, inner in entries:
            yield from paths(inner, (*path, key))

    for path in list(paths(whole)):
        for value in ("remove", "text", -3, [7, None]):
            data = copy.deepcopy(whole)
            parent = data
            for step in path[:-1]:
                parent = parent[step]
            if value != "remove":
                parent[path[-1]] = value
            else:
                del parent[path[-1]]
            yield path, value, data


class Parsed(html.parser.HTMLParser):
    """What of a page tests ask: its text, its tags, what it would load."""

    def __init__(self, page):
        super().__init__()
        self.tags, self.pieces, self.loads, self.images = [], [], [], []
        self.feed(page)
        self.text = " ".join(" ".join(self.pieces).split())

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.tags.append((tag, values))
        self.loads += [values[name] for name in ("src", "href", "srcset") if values.get(name)]
        if tag == "img":
            self.images.append(values)

    def handle_data(self, data):
        if self.tags and self.tags[-1][0] not in ("script", "style"):
            self.pieces.append(data)

    def image(self, alt):
        return next(values for values in self.images if values["alt"].startswith(alt))


def decoded(image):
    kind, data = image["src"].split(";base64,")
    assert kind == "data:image/png", kind
    return np.asarray(Image.open(io.BytesIO(base64.b64decode(data))))


class Page(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        save(self.folder / "serial.png", scene_pixels())

    def page(self, *datas, problems=(), kind="seams"):
        return Parsed(self.source(*datas, problems=problems, kind=kind))

    def source(self, *datas, problems=(), kind="seams"):
        return report.page_of({"root": str(self.folder), "entries": [
            {"kind": kind, "file": f"s{i}/{kind}.json", "folder": str(self.folder),
             "problems": list(problems), "data": data} for i, data in enumerate(datas)]})

    def differing(self, name="a", verdict="differs", pixels=None, **changes):
        save(self.folder / name / "image.png", stitched_pixels() if pixels is None else pixels)
        return case(name, verdict, **changes)

    def test_complete(self):
        page = self.page(seams([case("same", "identical"), self.differing()]))
        for said in ("1 of 2 results to look at", "because of a", "40.0", "x 48, y 20, G",
                     "0.99123", "49.2", "1.25 / 0.500", "12.5", "Radiosity Time is given",
                     "0.300 to 0.400", "mpiexec -n 2 mpipov --schedule dynamic --shape columns "
                     "--sections 2 --seams plain 'my scenes/cube.pov' +W96 +H64",
                     "mpipov-validate compare serial.png a/image.png",
                     "the seam at x = 48, y 0..63"):
            self.assertIn(said, page.text)
        self.assertNotIn("None", page.text)
        self.assertNotIn("No pictures", page.text)
        for values in page.images:
            self.assertTrue(values["alt"])

    def test_pictures_hold_the_pixels(self):
        page = self.page(seams([self.differing()]))
        np.testing.assert_array_equal(decoded(page.image("serial render of")), scene_pixels())
        np.testing.assert_array_equal(decoded(page.image("stitched render of")), stitched_pixels())
        drawn = decoded(page.image("difference of the two, amplified 4 times"))
        self.assertEqual(drawn[21, SEAM].tolist(), [0, 160, 0])
        self.assertEqual(drawn[21, SEAM - 2].tolist(), [0, 0, 0])  # grown by one, no more
        crop = decoded(page.image("difference, enlarged at"))
        self.assertEqual(crop.shape, (36, 48, 3))
        self.assertEqual(np.count_nonzero(crop[:, :, 1]), 8)

    def test_failures_come_first(self):
        page = self.page(seams([case("good", "identical"), self.differing("fine", "within noise"),
                                self.differing("bad", "beyond noise"), self.differing("worse"),
                                case("dead", "failed", failure="POV-Ray: no camera",
                                     comparison=None, image=None)]))
        table = page.text[:page.text.index("What the scene calls for")]
        places = [table.index(f"{name} ") for name in ("dead", "worse", "bad", "fine", "good")]
        self.assertEqual(places, sorted(places))
        self.assertIn("POV-Ray: no camera", table)

    def test_numbers_in_names_are_sorted_by_value(self):
        scene = report.scene_view({"folder": str(self.folder), "data": seams(
            [case(f"np{n}.g²", "identical") for n in (10, 9, 2)])})
        self.assertEqual([view["name"] for view in scene["views"]],
                         ["np2.g²", "np9.g²", "np10.g²"])

    def test_the_same_picture_is_shown_once(self):
        page = self.page(seams([self.differing("a"), self.differing("b")]))
        self.assertIn("and 1 more with the same picture: b", page.text)
        self.assertEqual(sum(i["alt"].startswith("stitched render of") for i in page.images), 1)

    def test_nothing_is_loaded_from_elsewhere(self):
        page = self.page(seams([self.differing()]))
        for address in page.loads:
            self.assertRegex(address, r"^(data:|#)")
        self.assertNotRegex(self.source(seams([self.differing()])), r"@import|url\(\s*['\"]?http")

    def test_hostile_text_stays_text(self):
        evil = self.differing("a", failure=None, reference="default")
        evil["name"] = evil["verdict"]["why"] = EVIL
        data = seams([evil], scene=EVIL, file=EVIL, arguments=[EVIL], failure=EVIL,
                     effects={EVIL: {"on": True, "why": EVIL}})
        page = self.page(data, problems=[EVIL])
        self.assertEqual(sum(tag == "script" for tag, _ in page.tags), 1)  # its own
        self.assertFalse([v for _, v in page.tags if any(n.startswith("on") for n in v)])
        self.assertIn(EVIL, page.text)

    def test_the_plot_is_svg_with_the_noise(self):
        page = self.page(seams([self.differing(name="a"), case(EVIL, "identical")]))
        svg = base64.b64decode(page.image("Plot of")["src"].split(",")[1]).decode()
        xml.etree.ElementTree.fromstring(svg)
        self.assertIn("PolyCollection", svg)  # the band
        self.assertIn("currentColor", svg)

    def test_the_noise_band_is_for_the_seams_it_was_measured_at(self):
        save(self.folder / "c" / "image.png", scene_pixels() + np.uint8(1))
        elsewhere = self.differing("b", pixels=stitched_pixels() + np.uint8(1))
        elsewhere["comparison"]["run"]["seams"][0]["position"] = 32
        data = seams([self.differing("a"), elsewhere, case("c", "differs")])
        with unittest.mock.patch("report_plots.error_by_distance", return_value="data:,") as plot:
            self.assertIn("seams lie elsewhere", self.page(data).text)
        drawn = [([label for label, *_ in call.args[0]], len(call.args[1]))
                 for call in plot.call_args_list]
        self.assertEqual(drawn, [(["a", "c"], 32), (["b"], 0)])

    def test_a_missing_or_damaged_picture_is_said(self):
        (self.folder / "b").mkdir()
        (self.folder / "b" / "image.png").write_bytes(
            (self.folder / "serial.png").read_bytes()[:-40])
        for name, said in (("gone", "'gone/image.png' is not there"), ("b", "'b/image.png'")):
            page = self.page(seams([case(name, "differs")]))
            self.assertIn("No pictures: " + said, page.text)
            self.assertIn(f"because of {name}", page.text)

    def test_pictures_of_other_folders_are_not_read(self):
        inner = self.folder / "inner"
        inner.mkdir()
        one = case("a", "differs", image="../serial.png")
        data = seams([one])
        page = Parsed(report.page_of({"root": "/", "entries": [
            {"kind": "seams", "file": "seams.json", "folder": str(inner), "problems": [],
             "data": data}]}))
        self.assertIn("lies outside", page.text)
        self.assertFalse([i for i in page.images if "Plot" not in i["alt"]])

    def test_without_the_module_that_reads_pictures(self):
        data = seams([self.differing()])
        with unittest.mock.patch.dict(sys.modules, {"OpenImageIO": None}):
            page = self.page(data)
        self.assertIn("install python3-openimageio", page.text)
        self.assertIn("because of a", page.text)

    def test_the_scene_may_be_among_the_arguments(self):
        data = seams([self.differing()], file="a.pov", arguments=["a.pov", "+W9"])
        self.assertIn("--seams plain a.pov +W9", self.page(data).text)

    def test_different_sizes(self):
        page = self.page(seams([self.differing(pixels=stitched_pixels()[:-1])]))
        self.assertIn("differ in size or depth: 96 x 64 x 3 uint8 and 96 x 63 x 3", page.text)

    def test_a_scene_that_failed(self):
        page = self.page({"scene": "cube", "failure": "Parse Error: <Expected> &amp;", "cases": []})
        self.assertIn("Parse Error: <Expected> &amp;", page.text)
        self.assertIn("✕ 1 failed", page.text)

    def test_damaged_files(self):
        page = self.page(None, problems=["parse error at line 3"])
        self.assertIn("s0/seams.json: parse error at line 3", page.text)
        self.assertIn("✕ 1 damaged", page.text)

    def test_an_unfinished_measurement_is_not_called_good(self):
        page = self.page(seams([case("a", "identical")], complete=False))
        self.assertIn("The measurement did not end", page.text)
        self.assertIn("1 of 2 results to look at", page.text)

    def test_a_verdict_that_contradicts_itself_is_not_good(self):
        odd = case("a", "beyond noise")
        odd["verdict"]["ok"] = True
        unknown = case("b", "splendid")
        unknown["verdict"]["ok"] = True
        self.assertIn("2 of 2 results", self.page(seams([odd, unknown])).text)

    def test_a_difference_that_may_be_is_good(self):
        one = self.differing()
        one["verdict"]["ok"] = True
        page = self.page(seams([one, case("b", "identical")]))
        self.assertIn("All 2 cases are as they should be", page.text)
        self.assertIn("≠ 1 differs as expected", page.text)

    def test_any_part_may_lack_or_be_something_else(self):
        tried = 0
        for path, value, data in damaged_copies(seams([self.differing()])):
            with self.subTest(path=path, value=value), unittest.mock.patch(
                    "report_plots.error_by_distance", return_value="data:,"):
                source = self.source(data)
                self.assertIn("</html>", source)
                self.assertNotRegex(source, "(Error|Exception): ")
            tried += 1
        self.assertGreater(tried, 300)

    def test_speedup_and_noise_tables(self):
        rows = [{"what": "dynamic", "ranks": 4, "median_seconds": 3.25, "low": 3.125, "high": 3.5,
                 "speedup": 3.75, "efficiency": 0.9375}, {"what": "odd"}]
        page = self.page({"scene": "cube", "rows": rows}, kind="speedup")
        self.assertIn("dynamic 4 3.25 3.12 3.50 3.75 0.938 –", page.text)
        self.assertIn("odd – – – – – – –", page.text)
        page = self.page({"noise": {"renders": [{"name": "RP5", "mean": 0.625}]}}, kind="noise")
        self.assertIn("RP5 0.625", page.text)

    def test_speedup_plot_images_and_failures(self):
        rows = [{"what": "serial", "kind": "serial", "ranks": 1, "speedup": 1},
                {"what": "b", "ranks": 2, "speedup": 1.5, "speedup_low": 1.25, "speedup_high": 2,
                 "identical": False, "differing": 12},
                {"what": "b", "ranks": 1, "speedup": 0.75, "identical": True},
                {"what": EVIL, "name": EVIL, "ranks": 1, "speedup": None, "failure": EVIL},
                {"what": "b", "ranks": "x", "speedup": float("nan")}, 7]
        data = {"scene": "cube", "rows": rows, "complete": False, "failure": "interrupted"}
        with unittest.mock.patch("report_plots.speedup_by_ranks", return_value="data:,") as plot:
            page = self.page(data, kind="speedup")
        plot.assert_called_once_with([("b", [(1, 0.75, 0.75, 0.75), (2, 1.5, 1.25, 2)])])
        self.assertIn("not complete: interrupted", page.text)
        self.assertIn("1.50 1.25..2.00", page.text)
        self.assertIn("12 pixels differ", page.text)
        self.assertIn("identical", page.text)
        source = self.source(data, kind="speedup")
        self.assertNotIn("<script>alert", source)
        self.assertIn("data:image/svg+xml", source)
        self.assertNotIn("with the ideal line", self.source({"rows": []}, kind="speedup"))

    def run_program(self, *arguments):
        return subprocess.run([sys.executable, report.__file__, *map(str, arguments)],
                              capture_output=True, text=True, check=False)

    def test_the_program(self):
        (self.folder / "in.json").write_text(json.dumps({"root": "r", "entries": []}))
        page = self.folder / "page.html"
        done = self.run_program(self.folder / "in.json", "--output", page)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("No scene was compared", page.read_text())
        done = self.run_program(self.folder / "in.json", "--output", self.folder / "no" / "p.html")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, "cannot write '.*no/p.html'")


if __name__ == "__main__":
    unittest.main()
