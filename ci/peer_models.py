"""What two peers of `mpipov-validate compare` say of a pair of images, and what idiff's source says
that it computes: the causes of all known disagreements, as numbers that can be checked.
"""

import math
import re
import subprocess
import warnings

import numpy
from skimage.metrics import (mean_squared_error, peak_signal_noise_ratio, structural_similarity)

CAUSES = {
    "peak": "idiff's peak is the largest value in either image, or 1 where that is less; ours is "
            "1, or what --peak says",
    "alpha": "idiff has OpenImageIO multiply colours by alpha; ours compares what the file stores",
    "not finite": "of samples that are not finite in one image idiff adds all but the first, and "
                  "divides by all samples; ours leaves them out, and counts and names them",
    "no number": "scikit-image adds up NaN and infinite values as others; ours leaves these samples "
                 "out of mean, RMS and PSNR, and has no SSIM then",
    "none": "the images are the same: infinite; ours is null, as JSON knows no infinity",
    "float": "idiff takes samples of full scale 1 and their differences as 32-bit floats, which is "
             "6e-8 in a small difference of large values",
}
METRICS = ("mean", "rms", "psnr", "ssim", "max")


def scikit_image(a, b, full_scale, colour):
    """a, b: as stored. Called at once for the whole image, in 64-bit floats of full scale 1."""
    a, b = a.astype(float) / full_scale, b.astype(float) / full_scale
    with warnings.catch_warnings(), numpy.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        said = {"rms": math.sqrt(mean_squared_error(a, b)),
                "psnr": float(peak_signal_noise_ratio(a, b, data_range=1))}
        try:
            said["ssim"] = float(structural_similarity(
                a[..., colour], b[..., colour], data_range=1, channel_axis=-1,
                gaussian_weights=True, sigma=1.5, use_sample_covariance=False))
        except ValueError as error:  # smaller than the window
            if "win_size" not in str(error):
                raise
            said["ssim"] = None
    return said


def idiff(a, b):
    """The texts that it prints, to six digits."""
    done = subprocess.run(["idiff", "-v", "-fail", "0", "-warn", "0", a, b], check=False,
                          capture_output=True, text=True)
    labels = {"mean": "Mean error", "rms": "RMS error", "psnr": "Peak SNR", "max": "Max error"}
    found = {metric: re.search(rf"^\s*{label}\s*= (\S+)", done.stdout, re.MULTILINE)
             for metric, label in labels.items()}
    if not all(found.values()):
        raise OSError(f"idiff {a} {b}: {done.stdout}{done.stderr}")
    return {metric: match.group(1) for metric, match in found.items()}


def as_idiff_reads(pixels, full_scale, alpha):
    values = pixels.astype(numpy.float32)
    if full_scale != 1:
        values = values * numpy.float32(1 / full_scale)
    if alpha:
        values[..., :-1] *= values[..., -1:]
    return values


def idiff_model(a, b, full_scale, alpha):
    """OpenImageIO 2.4's ImageBufAlgo::compare(), as far as idiff prints it."""
    a, b = (as_idiff_reads(one, full_scale, alpha) for one in (a, b))
    finite = numpy.isfinite(a) & numpy.isfinite(b)
    alike = (numpy.isnan(a) == numpy.isnan(b)) & (numpy.isinf(a) == numpy.isinf(b))
    strange = numpy.abs(a - b)[~finite & ~alike]
    with numpy.errstate(all="ignore"):
        error = numpy.abs(a[finite] - b[finite]).astype(float)
        mean, square = error.sum() / a.size, (error ** 2).sum() / a.size
        peak = max(1.0, float(a[finite].max()), float(b[finite].max()))
        largest = float(error.max())
        if strange.size:
            # The first one only makes the maximum infinite; what is printed is 0 unless above it.
            largest = 0 if numpy.isnan(strange[1:]).any() else math.inf
            mean, square = mean + strange[1:].sum(), square + (strange[1:] ** 2).sum()
        rms = math.sqrt(square)
        psnr = (math.nan if not math.isfinite(rms) else math.inf if rms == 0
                else 20 * math.log10(peak / rms))
    return {"mean": float(mean), "rms": rms, "psnr": psnr, "max": largest}


def digits(value):
    return f"{value:.6g}"


def close_digits(value, printed):
    """The same, or the last of the six digits is one more or less."""
    theirs = float(printed)
    if value is None or not math.isfinite(value) or not math.isfinite(theirs):
        return value is not None and digits(value) == digits(theirs)
    if theirs == 0:
        return abs(value) < 1e-12
    unit = 10.0 ** (math.floor(math.log10(abs(theirs))) - 5)
    return abs(value - theirs) <= 1.01 * unit
