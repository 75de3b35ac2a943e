"""peer.py - `make peer-check`: is Mitsuba 3's picture of a rough conductor ours?

Sphere and cylinder, Beckmann and GGX, isotropic and brushed, lit by one environment, seen by one camera: single
scattering, so that a path tracer with one bounce and our filter ask the same question.  Mitsuba answers by sampling,
`prefenv exact` by a sum over texels, `prefenv eval` by maps baked beforehand.  Nothing is shared but the numbers below.

What it takes for the two to be the same scene:

  frame        Coordinates are passed on as they are.  POV-Ray calls them left-handed and Mitsuba right-handed, which
               only says on which side a picture's left is: the camera here has x to the right, which Mitsuba's look_at
               has to the left, so columns are mirrored.  No surface here tells a right hand from a left one.
  environment  Mitsuba's column u looks along (sin 2 pi u, ., -cos 2 pi u), ours along (cos 2 pi u, ., sin 2 pi u): a
               quarter turn.  Its first and last rows lie on the poles, ours half a row from them; it interpolates
               between texels, we sum over them.  So it is given ours resampled to a grid with three columns and two
               rows for each: bilinear interpolation between our texels, exactly.  What is left is the width of a texel
               against that of the lobe, and counts as our error.
  brush        Along the axis of cylinder and sphere (y): our alpha_x.  Mitsuba's u runs around the axis: its alpha_u is
               our alpha_y.
  pixels       Mitsuba averages over each pixel; so do we, over a grid of rays.  Only pixels that show nothing but the
               object count.
  masking      Mitsuba's G is the product of two Smith terms, ours Smith's height-correlated G2 (the two are equal but
               at grazing angles); its Beckmann term is a rational approximation (to 0.35 %).  How much that is in each
               picture is worked out by a quadrature of its own and printed; it is not taken off.
"""

import argparse
import json
import os
import subprocess
import sys
import time

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")

DISTANCE, FIELD_OF_VIEW = 6.0, 30.0
RADIUS, HALF_HEIGHT = 0.8, 1.1  # of the cylinder; the sphere's radius is 1
CASES = [
    (shape, ndf, alpha)
    for shape in ("sphere", "cylinder")
    for ndf in ("beckmann", "ggx")
    for alpha in ((0.1, 0.1), (0.1, 0.03))
]


# ---- the environment ----


def read_environment(path):
    """As prefenv reads it: rows from +y down, what is negative or not a number is 0."""
    bitmap = mi.Bitmap(path).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32)
    return np.nan_to_num(np.maximum(np.array(bitmap, dtype=float), 0))


def interpolate(texels, u, v):
    """Bilinear between texel centres, around and over the poles."""
    height, width, _ = texels.shape
    x, y = u * width - 0.5, v * height - 0.5
    left, top = np.floor(x).astype(int), np.floor(y).astype(int)

    def tap(column, row):
        beyond = (row < 0) | (row >= height)
        column = np.where(beyond, column + width // 2, column) % width
        row = np.where(row < 0, -1 - row, np.where(row >= height, 2 * height - 1 - row, row))
        return texels[row, column]

    right, down = (x - left)[..., None], (y - top)[..., None]
    upper = tap(left, top) * (1 - right) + tap(left + 1, top) * right
    lower = tap(left, top + 1) * (1 - right) + tap(left + 1, top + 1) * right
    return upper * (1 - down) + lower * down


def mitsuba_environment(texels, to_environment):
    """to_environment takes x and z of a direction in the world into the environment's frame."""
    height, width, _ = texels.shape
    column = 2 * np.pi * (np.arange(3 * width) + 0.5) / (3 * width)
    x, z = to_environment(np.sin(column), -np.cos(column))
    v, u = np.meshgrid(
        np.arange(2 * height + 1) / (2 * height), np.arctan2(z, x) / (2 * np.pi) % 1, indexing="ij"
    )
    bitmap = mi.Bitmap(interpolate(texels, u, v).astype(np.float32))
    return mi.load_dict({"type": "envmap", "bitmap": bitmap})


def unturned(x, z):
    return x, z


def frame_of_figure_7(x, z):
    """Undoes `scale <-1, 1, 1> rotate 210*y` of scenes/fig7_scene.inc."""
    cosine, sine = np.cos(np.radians(210)), np.sin(np.radians(210))
    return -(x * cosine - z * sine), x * sine + z * cosine


# ---- Mitsuba's picture ----


def mitsuba_shape(shape, ndf, alpha, index):
    eta, k = index
    material = {
        "type": "roughconductor",
        "distribution": ndf,
        "alpha_u": alpha[1],
        "alpha_v": alpha[0],
        "eta": {"type": "rgb", "value": list(eta)},
        "k": {"type": "rgb", "value": list(k)},
    }
    if shape == "sphere":
        turn = mi.ScalarTransform4f().rotate([1, 0, 0], -90)  # its axis is z
        return {"type": "sphere", "to_world": turn, "bsdf": material}
    ends = {"p0": [0, -HALF_HEIGHT, 0], "p1": [0, HALF_HEIGHT, 0]}
    return {"type": "cylinder", "radius": RADIUS, "bsdf": material, **ends}


def mitsuba_picture(scene_parts, side, samples, seed, background=False):
    """Samples of the material alone: with no sun in the environment that is the least noise for the time."""
    camera = mi.ScalarTransform4f().look_at([0, 0, -DISTANCE], [0, 0, 0], [0, 1, 0])
    film = {"type": "hdrfilm", "width": side, "height": side, "rfilter": {"type": "box"}, "pixel_format": "rgb"}
    scene = mi.load_dict(
        {
            "type": "scene",
            "integrator": {
                "type": "direct",
                "emitter_samples": 0,
                "bsdf_samples": 1,
                "hide_emitters": not background,
            },
            "sensor": {
                "type": "perspective",
                "fov": FIELD_OF_VIEW,
                "to_world": camera,
                "film": film,
                "sampler": {"type": "orthogonal", "sample_count": samples},
            },
            **scene_parts,
        }
    )
    return np.array(mi.render(scene, seed=seed), dtype=float)[:, ::-1, :3]


# ---- our picture ----


def rays(shape, side, grid):
    """Normals and directions to the viewer, side x side x grid^2 x 3, and which pixels show the object alone."""
    offset = (np.arange(grid) + 0.5) / grid
    y, x = np.meshgrid(np.arange(side), np.arange(side), indexing="ij")
    x = (x[..., None] + np.tile(offset, grid)) / side * 2 - 1
    y = 1 - (y[..., None] + np.repeat(offset, grid)) / side * 2
    tangent = np.tan(np.radians(FIELD_OF_VIEW / 2))
    ray = np.stack([x * tangent, y * tangent, np.ones_like(x)], -1)
    ray /= np.linalg.norm(ray, axis=-1, keepdims=True)
    eye = np.array([0, 0, -DISTANCE])
    flat = np.array([1, 1 if shape == "sphere" else 0, 1])
    radius = 1 if shape == "sphere" else RADIUS
    a, b = (ray * ray * flat).sum(-1), (ray * eye * flat).sum(-1)
    c = (eye * eye * flat).sum() - radius**2
    inside = b * b - a * c
    point = eye + ((-b - np.sqrt(np.maximum(inside, 0))) / a)[..., None] * ray
    hit = inside > 0
    if shape == "cylinder":
        hit &= np.abs(point[..., 1]) < HALF_HEIGHT
    whole = hit.all(-1)
    # The neighbours too: a pixel between two rays of the grid may still hold the outline.
    inner = whole.copy()
    inner[1:] &= whole[:-1]
    inner[:-1] &= whole[1:]
    inner[:, 1:] &= whole[:, :-1]
    inner[:, :-1] &= whole[:, 1:]
    return point * flat / radius, -ray, inner


def ask(command, n, o):
    """The colours for lines `n o` on standard input; those of a pixel's rays averaged."""
    lines = np.concatenate([n.reshape(-1, 3), o.reshape(-1, 3)], 1)
    text = "\n".join(" ".join(f"{value:.17g}" for value in line) for line in lines)
    done = subprocess.run(command, input=text + "\n", capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"peer-check: {' '.join(command)}: {done.stderr.strip()}")
    return np.array(done.stdout.split(), dtype=float).reshape(len(n), -1, 3).mean(1)


# ---- the difference in masking ----


def fresnel(cosine, index):
    """Of a conductor, for unpolarised light: the amplitudes r_s and r_p of Fresnel's equations."""
    m = np.array(index[0]) + 1j * np.array(index[1])
    cosine = cosine[..., None]
    root = np.sqrt(m * m - (1 - cosine**2))
    s = (cosine - root) / (cosine + root)
    p = (m * m * cosine - root) / (m * m * cosine + root)
    return (np.abs(s) ** 2 + np.abs(p) ** 2) / 2


def smith(ndf, alpha, w):
    """Smith's Lambda of the direction w."""
    slope = np.hypot(alpha[0] * w[..., 0], alpha[1] * w[..., 1]) / np.maximum(w[..., 2], 1e-9)
    if ndf == "ggx":
        return (np.sqrt(1 + slope**2) - 1) / 2
    a = np.clip(1 / np.maximum(slope, 1e-9), 1e-6, 6)
    # erfc(a) by the approximation 7.1.26 of Abramowitz and Stegun, to 1.5e-7
    t = 1 / (1 + 0.3275911 * a)
    erfc = np.exp(-a * a) * t * np.polyval([1.061405429, -1.453152027, 1.421413741, -0.284496736, 0.254829592], t)
    return np.exp(-a * a) / (2 * a * np.sqrt(np.pi)) - erfc / 2


def mitsuba_smith(ndf, alpha, w):
    """Its G1, as its documentation gives it."""
    if ndf == "ggx":
        return 1 / (1 + smith(ndf, alpha, w))
    slope = np.hypot(alpha[0] * w[..., 0], alpha[1] * w[..., 1]) / np.maximum(w[..., 2], 1e-9)
    a = 1 / np.maximum(slope, 1e-9)
    return np.where(a < 1.6, (3.535 * a + 2.181 * a * a) / (1 + 2.276 * a + 2.577 * a * a), 1)


def both_maskings(texels, case, index, n, o, count=24):
    """The reflection at each (n, o) with height-correlated and with separable masking, by a sum over half vectors."""
    _, ndf, alpha = case
    u, phi = np.meshgrid((np.arange(count) + 0.5) / count, (np.arange(2 * count) + 0.5) / count * np.pi)
    radius = np.sqrt(-np.log(1 - u) if ndf == "beckmann" else u / (1 - u)).ravel()
    phi = phi.ravel()
    h = np.stack([alpha[0] * radius * np.cos(phi), alpha[1] * radius * np.sin(phi), np.ones_like(radius)])
    h = (h / np.linalg.norm(h, axis=0)).T
    sums = np.zeros((2, len(n), 3))
    for k, (normal, viewer) in enumerate(zip(n, o)):
        t = np.array([0, 1, 0]) - normal[1] * normal
        t /= np.linalg.norm(t)
        frame = np.stack([t, np.cross(normal, t), normal])
        v = frame @ viewer
        o_h = h @ v
        w = 2 * o_h[:, None] * h - v
        keep = (o_h > 0) & (w[:, 2] > 0)
        w, o_h, cos_h = w[keep], o_h[keep], h[keep, 2]
        world = w @ frame
        light = interpolate(
            texels,
            np.arctan2(world[:, 2], world[:, 0]) / (2 * np.pi) % 1,
            np.arccos(np.clip(world[:, 1], -1, 1)) / np.pi,
        )
        light *= fresnel(o_h, index) * (o_h / (cos_h * v[2]))[:, None]
        ours = 1 / (1 + smith(ndf, alpha, v) + smith(ndf, alpha, w))
        theirs = mitsuba_smith(ndf, alpha, v) * mitsuba_smith(ndf, alpha, w)
        sums[:, k] = (light * ours[:, None]).mean(0), (light * theirs[:, None]).mean(0)
    return sums


# ---- the comparison ----


def rms(values):
    return float(np.sqrt(np.mean(np.square(values))))


def beyond_noise(ours, first, second):
    """RMS difference to Mitsuba without its noise: that of two seeds is independent, so their product has none."""
    return float(np.sqrt(max(np.mean((first - ours) * (second - ours)), 0)))


def surface_options(ndf, alpha):
    return ["--ndf", ndf, "--alpha", f"{alpha[0]},{alpha[1]}", "--weight", "microfacet", "--material", "aluminium"]


def run(command):
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit(f"peer-check: {' '.join(command)}: see above")
    return done.stdout


def bake(options, name, ndf, alpha):
    """Maps, and the metal's index of refraction as they tell it."""
    maps = os.path.join(options.output, name)
    run([options.prefenv, "bake", options.environment, "-o", maps, "--float", "--quiet", *surface_options(ndf, alpha)])
    info = json.loads(run([options.prefenv, "info", "--json", maps]))
    return maps, (info["eta"], info["k"])


def run_case(case, options, texels, environment):
    shape, ndf, alpha = case
    begun = time.time()
    maps, index = bake(options, "case.pe.exr", ndf, alpha)
    parts = {"environment": environment, "object": mitsuba_shape(shape, ndf, alpha, index)}
    pictures = [mitsuba_picture(parts, options.side, options.samples, seed) for seed in (1, 2)]
    n, o, inside = rays(shape, options.side, 8)
    at = tuple(np.argwhere(inside).T)
    some = np.random.default_rng(1).permutation(len(at[0]))
    few, more = (tuple(axis[some[:count]] for axis in at) for count in (options.exact_pixels, 300))
    a, b = (picture[at] for picture in pictures)
    mean = float((a + b).mean() / 2)
    ours = ask([options.prefenv, "eval", maps], n[at], o[at])
    os.remove(maps)
    surface = surface_options(ndf, alpha)
    correlated, separable = both_maskings(texels, case, index, n[more][:, 0], o[more][:, 0])
    n, o, _ = rays(shape, options.side, 6)
    exact = ask([options.prefenv, "exact", options.environment, "--quiet", *surface], n[few], o[few])
    few_a, few_b = (picture[few] for picture in pictures)
    result = {
        "shape": shape,
        "ndf": ndf,
        "alpha": alpha,
        "pixels": len(a),
        "mitsuba_noise": rms(a - b) / 2 / mean,
        "difference": rms(ours - (a + b) / 2) / mean,
        "difference_beyond_noise": beyond_noise(ours, a, b) / mean,
        "exact_pixels": len(exact),
        "exact_beyond_noise": beyond_noise(exact, few_a, few_b) / float((few_a + few_b).mean() / 2),
        "masking": rms(correlated - separable) / float(separable.mean()),
        "mean_ratio": float(ours.mean()) / mean,
        "seconds": time.time() - begun,
    }
    result["passed"] = result["difference"] <= options.bound + result["mitsuba_noise"]
    return result


# ---- [Motegi Fig. 7] ----


def write_picture(options, name, values):
    bitmap = mi.Bitmap(values.astype(np.float32))
    bitmap.write(os.path.join(options.output, name + ".exr"))
    bitmap.convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.UInt8, srgb_gamma=True).write(
        os.path.join(options.output, name + ".png")
    )


def figure_7(options, texels):
    """Mitsuba's picture of the brushed cylinder, and POV-Ray's of maps for the same metal: rendered four times as
    large, one ray a pixel, and averaged here."""
    ndf, alpha, side = "beckmann", (0.1, 0.03), options.figure_side
    maps, index = bake(options, "brushed.exr", ndf, alpha)
    parts = {
        "environment": mitsuba_environment(texels, frame_of_figure_7),
        "object": mitsuba_shape("cylinder", ndf, alpha, index),
    }
    a, b = (mitsuba_picture(parts, side, options.figure_samples, seed, background=True) for seed in (1, 2))
    write_picture(options, "fig7_mitsuba", (a + b) / 2)
    log = os.path.join(options.output, "povray.log")
    large = os.path.join(options.output, "large.exr")
    link = os.path.join(options.output, "environment.exr")
    if not os.path.lexists(link):
        os.symlink(options.environment, link)
    command = [options.povray, f"+I{options.scenes}/fig7c.pov", f"+O{large}", "+FE", f"+W{4 * side}", f"+H{4 * side}"]
    command += ["-A", "-D", "-V", f"+L{options.output}", f"+L{options.scenes}"]
    with open(log, "w") as file:
        if subprocess.run(command, stdout=file, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL).returncode != 0:
            sys.exit(f"peer-check: fig7c.pov could not be rendered; see {log}")
    ours = read_environment(large).reshape(side, 4, side, 4, 3).mean((1, 3))
    os.remove(large)
    write_picture(options, "fig7_ours", ours)
    at = tuple(np.argwhere(rays("cylinder", side, 4)[2]).T)
    mean = float((a[at] + b[at]).mean() / 2)
    return {
        "pixels": len(at[0]),
        "mitsuba_noise": rms(a[at] - b[at]) / 2 / mean,
        "difference": rms(ours[at] - (a[at] + b[at]) / 2) / mean,
        "difference_beyond_noise": beyond_noise(ours[at], a[at], b[at]) / mean,
    }


# ---- the table ----


def write_table(results, figure, options, path):
    lines = [
        "# Mitsuba 3 and Prefenv: rough aluminium, single scattering",
        "",
        f"Mitsuba {mi.__version__}, {options.side} x {options.side} pixels, two pictures of {options.samples} samples"
        f" a pixel; environment {os.path.basename(options.environment)}; relative to the mean of the object's pixels.",
        "Difference: RMSE of `prefenv eval` to Mitsuba's mean picture, noise included. Beyond noise: the same without"
        " Mitsuba's noise, from the product of the differences to either picture, uncertain by a third of the noise."
        f" Exact: the same of `prefenv exact` in {results[0]['exact_pixels']} of the pixels. Masking: what Mitsuba's"
        " separable G makes of it.",
        "",
        "| shape | NDF | alpha | pixels | Mitsuba's noise | difference | beyond noise | exact's, beyond | masking |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for r in results:
        numbers = ("mitsuba_noise", "difference", "difference_beyond_noise", "exact_beyond_noise", "masking")
        lines.append(
            f"| {r['shape']} | {r['ndf']} | {r['alpha'][0]}, {r['alpha'][1]} | {r['pixels']} | "
            + " | ".join(f"{100 * r[number]:.2f} %" for number in numbers)
            + " |"
        )
    if figure:
        lines += [
            "",
            f"Fig. 7, {options.figure_side} x {options.figure_side}, {figure['pixels']} pixels of the cylinder,"
            f" Beckmann 0.1, 0.03: POV-Ray with our maps differs from Mitsuba by {100 * figure['difference']:.2f} %,"
            f" its noise {100 * figure['mitsuba_noise']:.2f} %;"
            f" {100 * figure['difference_beyond_noise']:.2f} % without.",
        ]
    with open(path, "w") as file:
        file.write("\n".join(lines) + "\n")


def parse_options():
    parser = argparse.ArgumentParser(description="compare prefenv with Mitsuba 3")
    parser.add_argument("--prefenv", required=True)
    parser.add_argument("--povray", help="for Fig. 7, which is left out without it")
    parser.add_argument("--scenes")
    parser.add_argument("--environment", required=True)
    parser.add_argument("--output", required=True)
    parser.add_argument("--side", type=int, default=96)
    parser.add_argument("--samples", type=int, default=1849, help="the square of a prime")
    parser.add_argument("--exact-pixels", type=int, default=150)
    parser.add_argument("--figure-side", type=int, default=512)
    parser.add_argument("--figure-samples", type=int, default=121)
    parser.add_argument("--bound", type=float, default=0.01)
    options = parser.parse_args()
    for name in ("prefenv", "environment", "output"):
        setattr(options, name, os.path.abspath(getattr(options, name)))
    os.makedirs(options.output, exist_ok=True)
    return options


def main():
    options = parse_options()
    texels = read_environment(options.environment)
    environment = mitsuba_environment(texels, unturned)
    results = []
    for case in CASES:
        r = run_case(case, options, texels, environment)
        results.append(r)
        print(
            f"{'ok' if r['passed'] else 'not ok'}: {r['shape']}, {r['ndf']}, alpha {r['alpha'][0]}, {r['alpha'][1]}: "
            f"{100 * r['difference']:.2f} % from Mitsuba, its noise {100 * r['mitsuba_noise']:.2f} %; "
            f"{100 * r['difference_beyond_noise']:.2f} % without; exact {100 * r['exact_beyond_noise']:.2f} %; "
            f"masking {100 * r['masking']:.2f} %  ({r['seconds']:.0f} s)",
            flush=True,
        )
    figure = figure_7(options, texels) if options.povray else None
    with open(os.path.join(options.output, "table.json"), "w") as file:
        json.dump({"mitsuba": mi.__version__, "bound": options.bound, "cases": results, "fig7": figure}, file, indent=2)
        file.write("\n")
    write_table(results, figure, options, os.path.join(options.output, "table.md"))
    failed = [r for r in results if not r["passed"]]
    if failed:
        sys.exit(
            f"peer-check: {len(failed)} of {len(results)} pictures differ by more than {100 * options.bound} % "
            "and the noise"
        )


if __name__ == "__main__":
    main()
