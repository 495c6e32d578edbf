"""Scenes in which an effect shows in a small part of the picture only: for ci/effects.

A wall of checks, and before it one ball that has the effect. Lengths are pixels of the probe's
render, 32 x 24 for 160 x 120, which it renders in blocks of 8 x 8: a ball in the middle of such a
block, and not larger, is in no other block.
"""

from dataclasses import dataclass

WIDTH, HEIGHT = 32, 24  # of the probe's render, and of the picture in the scene's own units
MIDDLE_OF_BLOCK = (20, 12)  # columns 16 to 23, rows 8 to 15
BETWEEN_PIXELS = (20.3, 12.3)
ONE_BLOCK = ("random numbers that are drawn in one block of the probe's render only are the same "
             "in every order of its blocks")
NO_LIT_SURFACE = ("the area light shows in a black mirror only, and what mirrors show is not traced "
                  "at the quality that area lights come with")
NO_RAY = "smaller than a pixel of the probe's render, and no ray of it comes that way"


@dataclass(frozen=True)
class SmallEffect:
    name: str
    effects: tuple
    order_dependent: bool
    text: str
    note: str
    known_miss: dict


def ball(diameter, at, depth, texture):
    x, y = at[0] - WIDTH / 2, HEIGHT / 2 - at[1]
    return f"sphere {{ 0, 1 {texture} scale {diameter / 2} translate <{x}, {y}, {depth}> }}\n"


def scene(thing, light="", settings=""):
    return f"""#version 3.7;
global_settings {{ assumed_gamma 1 {settings} }}
camera {{ orthographic location -100*z right {WIDTH}*x up {HEIGHT}*y look_at 0 }}
light_source {{ <-30, 50, -100>*10, rgb 1 {light} }}
plane {{ z, 10 hollow pigment {{ checker rgb 0.4 rgb 0.7 scale 3 }} finish {{ ambient 0.2 }} }}
{thing}"""


def two_pixels(name, texture, also=()):
    return SmallEffect(f"two_pixels.{name}", (name, *also), False,
                       scene(ball(2, BETWEEN_PIXELS, 0, texture)),
                       "a ball of 2 pixels of the probe's render", {})


def half_a_pixel():
    mirror = ball(0.5, BETWEEN_PIXELS, 0, "pigment { rgb 0.3 } finish { reflection 0.7 }")
    return SmallEffect("half_a_pixel.reflection", ("reflection",), False, scene(mirror),
                       "a ball of half a pixel of the probe's render", {"reflection": NO_RAY})


def isosurface():
    x, y = BETWEEN_PIXELS[0] - WIDTH / 2, HEIGHT / 2 - BETWEEN_PIXELS[1]
    text = ("isosurface { function { x*x + y*y + z*z - 1 } max_gradient 4 "
            "contained_by { sphere { 0, 1.01 } } pigment { rgb 0.5 } "
            f"translate <{x}, {y}, 0> }}\n")
    return SmallEffect("two_pixels.isosurface", ("isosurface",), False, scene(text),
                       "a ball of 2 pixels of the probe's render", {})


def area_light_of_a_ball():
    text = ("light_group { light_source { <30, 50, -100>*10, rgb 1 "
            "area_light 100*x, 100*y, 3, 3 adaptive 0 } "
            f"{ball(2, BETWEEN_PIXELS, 0, 'pigment { rgb 0.5 }')} global_lights off }}\n")
    return SmallEffect("two_pixels.area_light", ("area_light",), False, scene(text),
                       "an area light, without jitter, of which only a ball of 2 pixels of the "
                       "probe's render has light", {})


def area_light_in_a_mirror():
    text = """#version 3.7;
global_settings { assumed_gamma 1 }
camera { location -2*z look_at 0 }
light_source { <50, 80, -60>, rgb 1 area_light 20*x, 20*y, 3, 3 adaptive 0 }
plane { z, 0 pigment { rgb 0 } finish { ambient 0 diffuse 0 reflection 1 } }
plane { y, -1 pigment { checker rgb 0.4 rgb 0.7 } clipped_by { plane { z, -3 } } }
"""
    return SmallEffect("mirrored.area_light", ("area_light", "reflection"), False, text,
                       "nothing but a black mirror is seen directly", {"area_light": NO_LIT_SURFACE})


def slight_focal_blur():
    text = """#version 3.7;
global_settings { assumed_gamma 1 }
camera { location -5*z look_at 0 aperture 0.0001 focal_point 0 blur_samples 4 }
light_source { <-30, 50, -100>, rgb 1 }
sphere { 0, 1 pigment { rgb 0.7 } }
"""
    return SmallEffect("slight.focal_blur", ("focal_blur",), False, text,
                       "an aperture so small that no pixel shows it", {})


def subsurface():
    ball_of_wax = ball(2, BETWEEN_PIXELS, 0, "pigment { rgb 0.7 } finish { subsurface "
                                             "{ translucency 1 } } interior { ior 1.3 }")
    return SmallEffect("two_pixels.subsurface", ("subsurface",), True,
                       scene(ball_of_wax, "", "subsurface { samples 8, 4 }"),
                       "a ball of 2 pixels of the probe's render", {})


def crand(name, diameter, known_miss):
    return SmallEffect(f"{name}.crand", ("crand",), True,
                       scene(ball(diameter, MIDDLE_OF_BLOCK, 0,
                                  "pigment { rgb 0.7 } finish { crand 0.1 }")),
                       f"a ball of {diameter} pixels of the probe's render", known_miss)


def jitter(name, diameter, known_miss):
    # The half-shadow is a rim at the edge of the half ball, which lies on the wall.
    return SmallEffect(f"{name}.jitter", ("area_light",), True,
                       scene(ball(diameter, MIDDLE_OF_BLOCK, 10, "pigment { rgb 0.7 }"),
                             "area_light 100*x, 100*y, 3, 3 adaptive 0 jitter"),
                       f"shadow of a half ball of {diameter} pixels on the wall", known_miss)


def small_effects():
    missed = {"order_dependent": ONE_BLOCK}
    return [half_a_pixel(),
            two_pixels("reflection", "pigment { rgb 0.3 } finish { reflection 0.7 }"),
            two_pixels("transparency", "pigment { rgbt 0.9 }"),
            two_pixels("media", "pigment { rgbt 1 } hollow interior { media { emission 1 "
                                "method 3 intervals 1 samples 5 } }", ("transparency",)),
            isosurface(), area_light_of_a_ball(), area_light_in_a_mirror(), slight_focal_blur(),
            subsurface(),
            crand("one_block", 6, {}), crand("many_blocks", 12, {}),
            jitter("one_block", 4, missed), jitter("many_blocks", 14, {})]
