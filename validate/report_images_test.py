"""report_images.py and report_text.py: what a page shows of stored pixels and numbers."""

import pathlib
import sys
import unittest

import numpy as np

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parent))
import report_images  # noqa: E402
import report_text  # noqa: E402


class Pictures(unittest.TestCase):
    def picture(self, values, dtype, alpha=-1):
        pixels = np.array(values, dtype=dtype)
        return report_images.Picture(pixels.reshape(1, -1, pixels.shape[-1]), alpha)

    def test_16_bits_and_grey(self):
        shown = report_images.to_bytes(self.picture([[0], [257], [65535]], np.uint16))
        self.assertEqual(shown.tolist(), [[[0] * 3, [1] * 3, [255] * 3]])

    def test_floats_by_the_sRGB_curve(self):
        picture = self.picture([[0, 0.5, 1], [np.nan, -1, 2]], np.float32)
        self.assertEqual(report_images.to_bytes(picture).tolist(), [[[0, 188, 255], [0, 0, 255]]])
        self.assertEqual(report_images.to_bytes(picture, 0.5)[0, 1, 2], 255)
        self.assertIn("sRGB", report_images.tone_mapping(picture, 0.5))

    def test_floats_are_shown_without_their_alpha_in_the_colour(self):
        picture = self.picture([[0.25, 0.5, 0, 0.5], [0, 0, 0, 0]], np.float32, 3)
        self.assertEqual(report_images.to_bytes(picture).tolist(),
                         [[[188, 255, 0, 128], [0, 0, 0, 0]]])

    def test_bright_floats_are_scaled(self):
        picture = self.picture([[8, 8, 8]] * 4, np.float32)
        self.assertEqual(report_images.exposure_of(picture), 1 / 8)
        self.assertEqual(report_images.exposure_of(self.picture([[1, 0, 0]], np.float32)), 1)

    def test_difference_sees_alpha_and_not_a_number(self):
        a = self.picture([[10, 10, 10, 255]], np.uint8, 3)
        b = self.picture([[10, 10, 10, 0]], np.uint8, 3)
        self.assertEqual(report_images.difference(a, b).tolist(), [[[1, 1, 1]]])
        c = self.picture([[np.nan, np.nan, 0.5]], np.float32)
        d = self.picture([[np.nan, 0.5, 0.25]], np.float32)
        self.assertEqual(report_images.difference(c, d).tolist(), [[[0, 1, 0.25]]])

        low, high = (self.picture([[v, 0, 0]], np.uint16) for v in (1, 65535))
        self.assertEqual(report_images.difference(low, high)[0, 0, 0], np.float32(65534 / 65535))
        self.assertEqual(report_images.difference(high, low)[0, 0, 0], np.float32(65534 / 65535))

    def test_amplification_is_the_largest_power_of_two_that_fits(self):
        for error, factor in ((0, 1), (1, 1), (0.5, 2), (1 / 255, 128), (0.3, 2)):
            self.assertEqual(report_images.amplification(np.full((4, 4, 3), error)), factor)

    def test_one_pixel_survives_reduction(self):
        error = np.zeros((3000, 4000, 3))
        error[1500, 2000, 0] = 1
        drawn, grown = report_images.difference_picture(error, 1)
        self.assertTrue(grown)
        self.assertLessEqual(max(drawn.shape), report_images.LARGEST_SHOWN)
        self.assertEqual(drawn.max(), 255)

    def test_crop_stays_inside(self):
        self.assertEqual(report_images.crop_box(0, 0, 200, 100), (0, 0, 48, 36))
        self.assertEqual(report_images.crop_box(199, 99, 200, 100), (152, 64, 200, 100))
        self.assertEqual(report_images.crop_box(5, 5, 10, 12), (0, 0, 10, 12))

    def test_worst_place_lies_along_the_seam(self):
        error = np.zeros((100, 100, 3))
        error[70:75, 60] = 1   # near the seam
        error[10:30, 90] = 1   # not near
        _, along = report_images.worst_place(error, report_images.Line(True, 60, 0, 100))
        self.assertLessEqual(abs(along - 72), report_images.CROP_HEIGHT // 2)
        _, along = report_images.worst_place(
            error.transpose(1, 0, 2), report_images.Line(False, 60, 0, 100))
        self.assertLessEqual(abs(along - 72), report_images.CROP_WIDTH // 2)
        far = report_images.Line(True, 30, 0, 100)
        self.assertEqual(report_images.worst_place(error, far)[0], 0)


class Text(unittest.TestCase):
    def test_rounded(self):
        for value, shown in ((None, "–"), (True, "–"), (0, "0"), (1234.5, "1234"), (0.5, "0.500"),
                             (1.5e-7, "1.50e-07"), (-12.34, "-12.3"), (float("nan"), "–")):
            self.assertEqual(report_text.rounded(value), shown)

    def test_at(self):
        data = {"a": [{"b": 1}]}
        self.assertEqual(report_text.at(data, "a", 0, "b"), 1)
        for path in (("a", 1), ("a", "b"), ("x",), ("a", 0, "b", "c")):
            self.assertIsNone(report_text.at(data, *path))


if __name__ == "__main__":
    unittest.main()
