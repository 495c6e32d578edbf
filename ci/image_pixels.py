"""Images as arrays of what their files store; for the scripts beside this file.

Debian's interpreter by its full path: only that one sees the python3-openimageio package.
"""

import numpy
import OpenImageIO as oiio


def read_image(file):
    """The pixels as the file stores them, H x W x C, and what OpenImageIO says of the file."""
    config = oiio.ImageSpec()
    config.attribute("oiio:UnassociatedAlpha", 1)  # else colours come multiplied by alpha
    image = oiio.ImageInput.open(str(file), config)
    if image is None:
        raise OSError(f"{file}: {oiio.geterror()}")
    spec = image.spec()
    pixels = image.read_image(spec.format)
    if pixels is None:
        raise OSError(f"{file}: {image.geterror()}")
    image.close()
    return pixels.reshape(spec.height, spec.width, spec.nchannels), spec


def write_image(file, pixels, spec):
    """Writes it as read_image() found it, with other pixels."""
    image = oiio.ImageOutput.create(str(file))
    if image is None or not image.open(str(file), spec):
        raise OSError(f"{file}: {oiio.geterror() if image is None else image.geterror()}")
    if not image.write_image(numpy.ascontiguousarray(pixels)) or not image.close():
        raise OSError(f"{file}: {image.geterror()}")
