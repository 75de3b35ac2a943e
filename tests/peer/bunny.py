"""bunny.py - `make peer-check`: is Mitsuba 3's path-traced picture of the bunny, rough metal with every bounce, ours?

POV-Ray traces the reflection (`samples N traced`), Mitsuba's path tracer samples the same material; flat triangles, so
that both have one normal at a point.  Mitsuba's material is made two-sided, as POV-Ray's is: the mesh has holes.  How
the two scenes are made the same is told in peer.py, whose parts serve here, too.  Our picture is rendered sixteen times
as wide and high, one ray a pixel, and averaged; only pixels count that the bunny covers, with their neighbours.  There
are two of each, Mitsuba's of different seeds, ours a fraction of a pixel apart: the product of two differences that
share nothing has no noise.
"""

import argparse
import json
import os
import subprocess
import sys
import time

import mitsuba as mi
import numpy as np
import peer

SCALE = 16
ETA, K = (0.2, 0.92, 1.1), (3.9, 2.45, 2.3)  # a copper, as numbers of our own: both are told them

SCENE = """#version unofficial 3.7;
global_settings {{ assumed_gamma 1 max_trace_level 30 adc_bailout 0 }}
camera {{ location -{distance}*z direction <Step, 0.6 * Step, 1> right {width}*x up {width}*y }}
#include "bunny_flat.inc"
object {{
  Bunny
  pigment {{ rgb 1 }}
  finish {{ ambient Ambient diffuse 0
    #if (Ambient = 0)
      reflection {{ 1 prefiltered_environment {{
        exr "environment.exr" roughness {alpha} ior {eta}, {k} samples {samples} traced
      }} }}
    #end
  }}
}}
"""


def write_mesh(obj, path):
    vertices, faces = [], []
    with open(obj) as lines:
        for line in lines:
            words = line.split()
            if words[:1] == ["v"]:
                vertices.append("<%s,%s,%s>" % tuple(words[1:4]))
            elif words[:1] == ["f"]:
                faces.append("<%d,%d,%d>" % tuple(int(word.split("/")[0]) - 1 for word in words[1:4]))
    with open(path, "w") as file:
        file.write("#declare Bunny = mesh2 {\nvertex_vectors { %d,\n%s }\n" % (len(vertices), ",\n".join(vertices)))
        file.write("face_indices { %d,\n%s }\n}\n" % (len(faces), ",\n".join(faces)))


def peer_width():
    return 2 * np.tan(np.radians(peer.FIELD_OF_VIEW / 2))


def pov_vector(values):
    return "<%s>" % ", ".join(str(value) for value in values)


def our_picture(options, name, ambient=0, shift=0.0):
    """shift: of all rays, in distances of neighbours."""
    path = os.path.join(options.output, name)
    side = SCALE * options.side
    command = [options.povray, "+Ibunny.pov", f"+O{path}", "+FE", f"+W{side}", f"+H{side}", "-A", "-D", "-V"]
    step = peer_width() / side * shift
    command += [f"Declare=Ambient={ambient}", f"Declare=Step={step:.9f}", f"+L{options.output}"]
    with open(os.path.join(options.output, "bunny.log"), "w") as file:
        done = subprocess.run(
            command, cwd=options.output, stdout=file, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL
        )
    if done.returncode != 0:
        sys.exit(f"peer-check: the bunny could not be rendered; see {file.name}")
    picture = peer.read_environment(path)
    os.remove(path)
    return picture.reshape(options.side, SCALE, options.side, SCALE, 3)


def covered(options):
    whole = our_picture(options, "mask.exr", ambient=1).min((1, 3, 4)) > 0.5
    inner = whole.copy()
    for axis in (0, 1):
        for step in (1, -1):
            inner &= np.roll(whole, step, axis)
    return inner


def mitsuba_picture(options, environment, samples, depth, seed):
    metal = {
        "type": "roughconductor",
        "distribution": "beckmann",
        "alpha": options.alpha,
        "eta": {"type": "rgb", "value": list(ETA)},
        "k": {"type": "rgb", "value": list(K)},
    }
    scene = mi.load_dict(
        {
            "type": "scene",
            "integrator": {"type": "path", "max_depth": depth, "rr_depth": 1000, "hide_emitters": True},
            "sensor": {
                "type": "perspective",
                "fov": peer.FIELD_OF_VIEW,
                "to_world": mi.ScalarTransform4f().look_at([0, 0, -peer.DISTANCE], [0, 0, 0], [0, 1, 0]),
                "film": {
                    "type": "hdrfilm",
                    "width": options.side,
                    "height": options.side,
                    "rfilter": {"type": "box"},
                    "pixel_format": "rgb",
                },
                "sampler": {"type": "independent", "sample_count": samples},
            },
            "environment": environment,
            "bunny": {
                "type": "obj",
                "filename": options.mesh,
                "face_normals": True,
                "bsdf": {"type": "twosided", "material": metal},
            },
        }
    )
    return np.array(mi.render(scene, seed=seed), dtype=float)[:, ::-1, :3]


def beyond_noise(first, second):
    return float(np.sqrt(max(np.mean(first * second), 0)))


def compare(options):
    texels = peer.read_environment(options.environment)
    environment = peer.mitsuba_environment(texels, peer.unturned)
    inner = covered(options)
    begun = time.time()
    ours = [our_picture(options, "ours.exr", shift=shift).mean((1, 3)) for shift in (-0.21, 0.29)]
    traced = time.time() - begun
    a, b = (mitsuba_picture(options, environment, options.mitsuba_samples, -1, seed)[inner] for seed in (1, 2))
    once = mitsuba_picture(options, environment, options.mitsuba_samples // 4, 2, 3)[inner]
    peer.write_picture(options, "bunny_ours", (ours[0] + ours[1]) / 2)
    x, y = (picture[inner] for picture in ours)
    mean = float((a + b).mean() / 2)
    return {
        "pixels": int(inner.sum()),
        "rays": 2 * options.samples * SCALE**2,
        "seconds": traced,
        "mitsuba_noise": peer.rms(a - b) / 2 / mean,
        "our_noise": peer.rms(x - y) / 2 / mean,
        "difference": peer.rms((x + y) / 2 - (a + b) / 2) / mean,
        "difference_beyond_noise": (beyond_noise(x - a, y - b) + beyond_noise(x - b, y - a)) / 2 / mean,
        "mean_ratio": float((x + y).mean() / 2) / mean,
        "one_bounce": peer.beyond_noise(once, a, b) / mean,
    }


def main():
    parser = argparse.ArgumentParser(description="compare the traced bunny with Mitsuba 3")
    parser.add_argument("--povray", required=True)
    parser.add_argument("--environment", required=True)
    parser.add_argument("--mesh", required=True)
    parser.add_argument("--output", required=True)
    parser.add_argument("--side", type=int, default=64)
    parser.add_argument("--alpha", type=float, default=0.1)
    parser.add_argument("--samples", type=int, default=6, help="at each of the 256 rays of a pixel")
    parser.add_argument("--mitsuba-samples", type=int, default=4096)
    parser.add_argument("--bound", type=float, default=0.02)
    options = parser.parse_args()
    for name in ("povray", "environment", "mesh", "output"):
        setattr(options, name, os.path.abspath(getattr(options, name)))
    os.makedirs(options.output, exist_ok=True)
    link = os.path.join(options.output, "environment.exr")
    if not os.path.lexists(link):
        os.symlink(options.environment, link)
    write_mesh(options.mesh, os.path.join(options.output, "bunny_flat.inc"))
    with open(os.path.join(options.output, "bunny.pov"), "w") as file:
        file.write(
            SCENE.format(
                distance=peer.DISTANCE,
                width=peer_width(),
                alpha=options.alpha,
                eta=pov_vector(ETA),
                k=pov_vector(K),
                samples=options.samples,
            )
        )
    result = compare(options)
    with open(os.path.join(options.output, "bunny.json"), "w") as file:
        json.dump(result, file, indent=2)
        file.write("\n")
    passed = result["difference_beyond_noise"] <= options.bound
    print(
        f"{'ok' if passed else 'not ok'}: bunny, every bounce, alpha {options.alpha}: "
        f"{100 * result['difference']:.2f} % from Mitsuba, its noise {100 * result['mitsuba_noise']:.2f} %, "
        f"ours {100 * result['our_noise']:.2f} %; "
        f"{100 * result['difference_beyond_noise']:.2f} % without (one bounce alone: "
        f"{100 * result['one_bounce']:.1f} %); mean {result['mean_ratio']:.4f} of Mitsuba's; "
        f"{result['pixels']} pixels, {result['rays']} rays in each"
    )
    if not passed:
        sys.exit(f"peer-check: the bunny differs by more than {100 * options.bound} % beyond noise")


if __name__ == "__main__":
    main()
