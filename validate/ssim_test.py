"""ssim.py against scikit-image called directly and against a case computed by hand."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np
from scipy.ndimage import gaussian_filter
from skimage.metrics import structural_similarity

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parent))
import ssim  # noqa: E402


def reference(a, b, data_range):
    return structural_similarity(a, b, data_range=data_range, channel_axis=-1,
                                 gaussian_weights=True, sigma=1.5, use_sample_covariance=False)


def noisy_pair(height=70, width=41, channels=3):
    random = np.random.default_rng(1999)
    a = random.random((height, width, channels))
    b = np.clip(a + random.normal(0, 0.1, a.shape), 0, 1)
    return a, b


class Ssim(unittest.TestCase):
    def test_is_scikit_images_in_bands_of_any_size(self):
        a, b = noisy_pair()
        expected = reference(a, b, 1.0)
        for rows in (11, 16, 17, 30, 64, 70, 1000):
            found = ssim.ssim(a, b, 1.0, rows=rows)
            self.assertAlmostEqual(found["ssim"], expected, places=12, msg=f"{rows} rows")

    def test_per_channel(self):
        a, b = noisy_pair()
        b[:, :, 1] = a[:, :, 1]
        found = ssim.ssim(a, b, 1.0)["per_channel"]
        self.assertAlmostEqual(found[1], 1.0, places=12)
        for channel in (0, 2):
            one = np.s_[:, :, channel:channel + 1]
            self.assertAlmostEqual(found[channel], reference(a[one], b[one], 1.0), places=12)
            self.assertLess(found[channel], 0.99)

    def test_alpha_is_told_but_not_averaged_in(self):
        a, b = noisy_pair(channels=4)
        b[:, :, 3] = a[:, :, 3]
        found = ssim.ssim(a, b, 1.0, colour=[0, 1, 2])
        self.assertAlmostEqual(found["ssim"], reference(a[:, :, :3], b[:, :, :3], 1.0), places=12)
        self.assertAlmostEqual(found["per_channel"][3], 1.0, places=12)

    def test_constant_images_by_hand(self):
        # Without variance the formula is (2 p q + C1) / (p^2 + q^2 + C1), C1 = (0.01 L)^2.
        p, q = 0.25, 0.75
        c1 = 0.01 ** 2
        expected = (2 * p * q + c1) / (p * p + q * q + c1)
        found = ssim.ssim(np.full((20, 30, 1), p), np.full((20, 30, 1), q), 1.0)
        self.assertAlmostEqual(found["ssim"], expected, places=9)

    def test_equal_constant_images_have_exactly_1_whatever_their_value(self):
        for value in (0.0, 5.96e-8, 0.25, 1.0, 65504.0, 1e6, 3e38):
            one = np.full((20, 30, 1), value)
            self.assertEqual(ssim.ssim(one, one.copy(), 1.0)["ssim"], 1.0, msg=value)

    def test_constant_images_far_above_the_peak_by_hand(self):
        for p, q in ((1e6, 1e6 + 1), (1e6, 2e6), (3e38, 1e38)):
            c1 = 0.01 ** 2
            expected = (2 * p * q + c1) / (p * p + q * q + c1)
            found = ssim.ssim(np.full((20, 30, 1), p), np.full((20, 30, 1), q), 1.0)
            self.assertAlmostEqual(found["ssim"], expected, places=12)

    def test_variances_do_not_cancel(self):
        # Mean 1e6, deviation 1e-3. From so far above the peak only contrast and structure count.
        random = np.random.default_rng(1999)
        steps = np.rint(random.normal(0, 4, (2, 60, 50, 1)))
        a, b = steps[0] / 4096, (steps[0] + steps[1]) / 4096
        found = ssim.ssim(a + 1e6, b + 1e6, 1.0)["ssim"]
        self.assertLess(found, 1)
        c2 = 0.03 ** 2
        gauss = lambda values: gaussian_filter(values, 1.5, truncate=3.5)
        x, y = a[:, :, 0], b[:, :, 0]
        covariance = gauss(x * y) - gauss(x) * gauss(y)
        both = gauss(x * x) - gauss(x) ** 2 + gauss(y * y) - gauss(y) ** 2
        expected = ((2 * covariance + c2) / (both + c2))[5:-5, 5:-5].mean()
        self.assertAlmostEqual(found, expected, places=11)

    def test_from_deviations_is_scikit_images(self):
        a, b = noisy_pair(80, 50, 1)
        _, expected = structural_similarity(
            a[:, :, 0], b[:, :, 0], data_range=1.0, gaussian_weights=True, sigma=1.5,
            use_sample_covariance=False, full=True)
        found = ssim.ssim_from_deviations(a[:, :, 0], b[:, :, 0], 1.0)
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12)

    def test_too_small_or_not_finite_has_no_value(self):
        a, b = noisy_pair(10, 41)
        self.assertIsNone(ssim.ssim(a, b, 1.0)["ssim"])
        a, b = noisy_pair()
        b[3, 4, 0] = np.nan
        found = ssim.ssim(a, b, 1.0)
        self.assertIsNone(found["ssim"])
        self.assertIn("NaN", found["reason"])
        b[3, 4, 0] = 1e300
        found = ssim.ssim(a, b, 1.0)
        self.assertIsNone(found["ssim"])
        self.assertIn("too large", found["reason"])

    def test_smallest_image_that_has_a_value(self):
        a, b = noisy_pair(11, 11)
        self.assertAlmostEqual(ssim.ssim(a, b, 1.0)["ssim"], reference(a, b, 1.0), places=12)

    def run_program(self, a, b, request):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            a.tofile(folder / "a.raw")
            b.tofile(folder / "b.raw")
            height, width, channels = a.shape
            request |= {"height": height, "width": width, "channels": channels,
                        "a": "a.raw", "b": "b.raw", "map": "map.raw",
                        "colour": list(range(channels))}
            (folder / "requests.json").write_text(json.dumps([request]))
            script = pathlib.Path(ssim.__file__)
            output = subprocess.run(
                [sys.executable, script, folder / "requests.json"],
                check=True, capture_output=True, text=True).stdout
            values = np.fromfile(folder / "map.raw", dtype=np.float32).reshape(height, width)
            return json.loads(output)[0], values

    def test_the_program_with_16_bit_pixels(self):
        a, b = ((image * 65535).astype(np.uint16) for image in noisy_pair(300, 40))
        found, values = self.run_program(a, b, {"type": "u2", "full_scale": 65535,
                                                "data_range": 1.0})
        expected, map_expected = structural_similarity(
            a / 65535, b / 65535, data_range=1.0, channel_axis=-1, gaussian_weights=True,
            sigma=1.5, use_sample_covariance=False, full=True)
        self.assertAlmostEqual(found["ssim"], expected, places=12)
        np.testing.assert_allclose(values, map_expected.mean(axis=2), atol=1e-6)

    def test_the_program_answers_each_request_in_its_place(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            requests, expected = [], []
            for index, size in enumerate(((20, 30), (5, 30), (30, 20))):
                a, b = (np.ascontiguousarray(image) for image in noisy_pair(*size))
                a.tofile(folder / f"{index}.a")
                b.tofile(folder / f"{index}.b")
                requests.append({"height": a.shape[0], "width": a.shape[1], "channels": a.shape[2],
                                 "type": "f8", "full_scale": 1, "data_range": 1.0, "map": None,
                                 "colour": list(range(a.shape[2])), "a": f"{index}.a",
                                 "b": f"{index}.b"})
                expected.append(ssim.ssim(a, b, 1.0)["ssim"])
            (folder / "requests.json").write_text(json.dumps(requests))
            output = subprocess.run([sys.executable, pathlib.Path(ssim.__file__),
                                     folder / "requests.json"],
                                    check=True, capture_output=True, text=True).stdout
            self.assertEqual([found["ssim"] for found in json.loads(output)], expected)
            self.assertIsNone(expected[1])


if __name__ == "__main__":
    unittest.main()
