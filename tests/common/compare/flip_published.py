# Prints what the published tool says of the pictures of flip_test.cpp, whose numbers come from here:
#   pip install flip-evaluator==1.7 numpy && python flip_published.py
# The mean is taken in double precision over the map: the tool's own, added up in single precision, is
# off by up to 5e-3 for a picture of 1.3 million pixels.
import numpy as np
from flip_evaluator import nbflip

WIDTH, HEIGHT = 40, 28
PLACES = [(0, 0), (9, 14), (10, 14), (20, 14), (31, 14), (39, 27)]


def inside(x, y, shift):
    return (x - 20 - shift) ** 2 + (y - 14) ** 2 < 100


def disc_image(shift, colour):
    """8-bit sRGB values."""
    picture = np.zeros((HEIGHT, WIDTH, 3), np.float32)
    for y in range(HEIGHT):
        for x in range(WIDTH):
            picture[y, x] = colour if inside(x, y, shift) else (30 + 2 * x, 40 + 3 * y, 90)
    return picture


def disc_light(shift, colour):
    picture = disc_image(shift, colour)
    picture = picture * picture / np.float32(1024)
    for y in range(HEIGHT):
        for x in range(WIDTH):
            if inside(x, y, shift) and (x + y) % 7 == 0:
                picture[y, x] *= 16
    return picture


def ask(name, test, reference, hdr, parameters):
    flip, _, used = nbflip.evaluate(reference, test, hdr, not hdr, False, True, parameters)
    flip = np.array(flip).reshape(HEIGHT, WIDTH)
    print(name, f"{flip.astype(np.float64).mean():.8f}", [f"{flip[y, x]:.6f}" for x, y in PLACES], used)


TEST, REFERENCE = (1, (205, 118, 44)), (0, (200, 120, 40))
ask("ldr", disc_image(*TEST) / 255, disc_image(*REFERENCE) / 255, False, {})
ask("ldr, 20 pixels per degree", disc_image(*TEST) / 255, disc_image(*REFERENCE) / 255, False, {"ppd": 20.0})
ask("hdr", disc_light(*TEST), disc_light(*REFERENCE), True, {})
