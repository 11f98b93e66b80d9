"""Draws a small folder of each layout that `taceva import --presets` lists, in its own file names, columns and formats.

    python make.py [FOLDER] [--only LAYOUT]        # numpy, pillow, h5py, zarr 3

Nothing is taken from the data of others: pictures are one colour, whose red is 40 + 10 * n of picture n; forces and places of sample n are those
of `force` and `place`. lerobot-v3 and rosbag lie in tests/recordings already (lerobot-v3-h264, mcap-none), written by libraries of other people.
"""

import argparse
import csv
import io
import json
import pickle
import struct
import tarfile
from pathlib import Path

import h5py
import numpy as np
import zarr
from PIL import Image

SAMPLES = 3


def force(n):
    return [0.25 * n, -0.5 * n, 1.5 + n]


def wrench(n):
    return force(n) + [0.125 * n, 0.0, -0.25]


def place(n):
    return [1.0 + n, 2.5 * n, -0.5]


def picture(n):
    return Image.new("RGB", (16, 12), (40 + 10 * n, 90, 120))


def draw(path, n):
    path.parent.mkdir(parents=True, exist_ok=True)
    options = {"quality": 95, "subsampling": 0} if path.suffix == ".jpg" else {}
    picture(n).save(path, **options)


def encoded(n, form="PNG"):
    into = io.BytesIO()
    picture(n).save(into, form, **({"quality": 95} if form == "JPEG" else {}))
    return into.getvalue()


def table(path, rows):
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)


def bristol(to):
    axes = ["x", "y", "z", "Rx", "Ry", "Rz"]
    named = [f"{kind}_{axis}" for kind in ("pose", "shear", "object") for axis in axes]
    rows = [["sensor_image", "object_label", *named, "Fx", "Fy", "Fz", "Tx", "Ty", "Tz"]]
    for n in range(SAMPLES):
        numbers = [*place(n), 0.0, 0.0, 5.0 * n, *[0.0] * 12]
        rows.append([f"image_{n + 1}.png", "edge", *numbers, *[0.0] * 6])
        draw(to / f"sensor_images/image_{n + 1}.png", n)
    draw(to / "sensor_images/image_0.png", 9)
    table(to / "targets.csv", rows)


def py3dcal(to):
    rows = [["img_name", "x_mm", "y_mm", "penetration_depth_mm"], ["---", 0, 0, 0]]
    for n in range(SAMPLES):
        x, y, _ = place(n)
        name = f"{n}_X{x}Y{y}Z0.5.png"
        rows.append([name, x, y, 0.5])
        draw(to / "probe_images" / name, n)
    table(to / "annotations/probe_data.csv", rows)
    table(to / "annotations/metadata.csv", [["px_per_mm", "probe_radius_mm"], [14.0, 2.0]])
    draw(to / "blank_images/blank.png", 9)


def nine_dtact(to):
    for n in range(SAMPLES):
        draw(to / f"image/1/{n + 1}.png", n)
        (to / "wrench/1").mkdir(parents=True, exist_ok=True)
        np.save(to / f"wrench/1/{n + 1}.npy", wrench(n))
        np.save(to / f"wrench/1/{n + 1}_norm.npy", np.array(wrench(n)) / 12)
    np.save(to / "train_images.npy", np.array(["../Dataset/image/1/1.png"]))


def allsight(to):
    session = "2023_01_29-01:51:55".replace(":", "-")
    root = "/data/allsight/dataset/markers/rrrgggbbb/images/sphere3"
    members = {}
    for n in range(SAMPLES):
        draw(to / f"markers/rrrgggbbb/images/sphere3/img_{session}/image{n}.jpg", n)
        members[f"image{n}.jpg"] = {
            "frame": f"{root}/img_{session}/image{n}.jpg",
            "ref_frame": f"{root}/img_{session}/ref_frame.jpg",
            "time": 0.5 * n,
            "num": 0,
            "depth": 0.001,
            "pose_transformed": [place(n), [0, 0, 0, 1]],
            "ft_ee_transformed": wrench(n),
            "contact_px": [240, 240, 20],
        }
    data = to / f"markers/rrrgggbbb/data/sphere3/data_{session}"
    data.mkdir(parents=True, exist_ok=True)
    (data / f"data_{session}_transformed_annotated.json").write_text(json.dumps(members))
    (data / "summary.json").write_text(json.dumps({"sensor_id": 2, "indenter": "sphere3"}))


def sparsh_force(to):
    batch = to / "sphere/batch_1"
    batch.mkdir(parents=True, exist_ok=True)
    pictures = [encoded(n) for n in range(6)]
    for number, part in enumerate((pictures[:4], pictures[4:])):
        with open(batch / f"dataset_digit_{number:02}.pkl", "wb") as file:
            pickle.dump(part, file)
    trajectory = {
        press: {
            "indexes": np.array(indexes),
            "forces": np.array([force(n) for n in indexes]),
            "slip_label": np.array([0, 1]),
            "coef_friction": 0.5,
        }
        for press, indexes in ((0, (1, 2)), (1, (4, 5)))
    }
    with open(batch / "dataset_slip_forces.pkl", "wb") as file:
        pickle.dump({"in_contact": np.array([0, 1, 1, 0, 1, 1]), "trajectories": trajectory}, file)


def ycb_slide(to):
    folder = to / "035_power_drill/dataset_0"
    for n in range(SAMPLES):
        draw(folder / f"frames/frame_{n}.jpg", n)
    poses = np.array([[*place(n), 0, 0, 0, 1] for n in range(SAMPLES)])
    np.save(folder / "synced_data.npy", {
        "timestamps": [10.0 + 0.5 * n for n in range(SAMPLES)],
        "digit_frames": [f"frames/frame_{n}.jpg" for n in range(SAMPLES)],
        "webcam_frames": [f"webcam_frames/frame_{n}.jpg" for n in range(SAMPLES)],
        "poses": {"DIGIT": poses, "035_power_drill": poses * 0},
    }, allow_pickle=True)


def touchd(to):
    rows = [[n + 1, *force(n), "press"] for n in range(SAMPLES)]
    (to).mkdir(parents=True, exist_ok=True)
    names = {"obj006_speed1": {"gelsight": rows}}
    for n in range(SAMPLES):
        draw(to / f"obj006_speed1/gelsight/image_{n + 1}.png", n)
    (to / "all_data_direction.json").write_text(json.dumps(names))


def tacquad(to):
    for n in range(SAMPLES):
        draw(to / f"data_indoor/apple/gelsight/{n}.png", n)
    table(to / "contact_indoor.csv", [["apple", 1, 2, 0, 0, 0, 0, "a smooth apple, round"]])


def poseit(to):
    grasp = to / "bangle_1612630172_F80_pose8"
    second = 1612630172
    rows = [["time", "Fx", "Fy", "Fz", "Tx", "Ty", "Tz"]]
    for n in range(SAMPLES):
        draw(grasp / f"gelsight/gelsight_{n}_{second + n}.jpg", n)
        rows.append([second + n, *wrench(n)])
        rows.append([second + n, *[99.0] * 6])
    table(grasp / "f_t.csv", rows)
    table(grasp / "gripper.csv", [["timestamp", "left", "right"], [second, 10, 11]])
    table(grasp / "stages.csv", [["grasping", second], ["pose", second + 2]])
    table(grasp / "label.csv", [["grasp", "pass"], ["pose", "slip"]])


def tool_force(to):
    for n in range(SAMPLES):
        for side in (1, 2):
            draw(to / f"trial1/tactile{side}/tactile_frame_{n:04}.jpg", n)
        raw = (force(n)[2] - 29.229) / -0.0302
        (to / "trial1/force").mkdir(parents=True, exist_ok=True)
        (to / f"trial1/force/force_data_{n:04}.txt").write_text(f"{n},0.5,{raw!r}\n")


def univtac(to):
    to.mkdir(parents=True, exist_ok=True)
    pictures = [encoded(n, "JPEG") for n in range(SAMPLES)]
    width = max(map(len, pictures))
    with h5py.File(to / "0.hdf5", "w") as file:
        for side in ("left", "right"):
            gel = file.create_group(f"tactile/{side}_tactile")
            gel["rgb"] = np.array(pictures, dtype=f"S{width}")
            gel["rgb_marker"] = np.array(pictures, dtype=f"S{width}")
            gel["depth"] = np.zeros((SAMPLES, 4, 4), np.float32)
            gel["marker"] = np.zeros((SAMPLES, 2, 63, 2), np.float32)
            gel["pose"] = np.array([[*place(n), 1, 0, 0, 0] for n in range(SAMPLES)])
        file["embodiment/joint"] = np.zeros((SAMPLES, 8), np.float32)
        file["step"] = np.arange(SAMPLES)


def gelsight_live(to):
    for n in range(SAMPLES):
        draw(to / f"Frame_{n}.png", n)
    np.save(to / "marker_tracking_20250102_030405.npy", np.zeros((SAMPLES, 63, 2)))


def fota(to):
    to.mkdir(parents=True, exist_ok=True)
    for shard in range(2):
        with tarfile.open(to / f"data-{shard:06}.tar", "w", format=tarfile.PAX_FORMAT) as tar:
            for n in range(SAMPLES):
                x, y, z = place(n)
                members = {
                    "jpg": encoded(n, "JPEG"),
                    "json": json.dumps({"x_mm": x, "y_mm": y, "z_mm": z, "quat_w": 1.0}).encode(),
                }
                for ending, data in members.items():
                    about = tarfile.TarInfo(f"{shard * SAMPLES + n:06}.{ending}")
                    about.size = len(data)
                    tar.addfile(about, io.BytesIO(data))
    (to / "count.txt").write_text(str(2 * SAMPLES))


def diffusion_zarr(to):
    to.mkdir(parents=True, exist_ok=True)
    root = zarr.open_group(to / "data.zarr", mode="w", zarr_format=2)
    frames = np.stack([np.asarray(picture(n)) for n in range(SAMPLES)])
    for name, values in {
        "data/camera_0": frames,
        "data/force": np.array([force(n) for n in range(SAMPLES)]),
        "data/action": np.zeros((SAMPLES, 7), np.float32),
        "meta/episode_ends": np.array([2, 3], np.int64),
    }.items():
        root.create_array(name, data=values)


def touch_and_go(to):
    """Clip 20220516_190814 is in both lists."""
    for clip, numbers in (("20220516_190814", (0, 1)), ("20220517_192217", (2,)), ("20220607_133934", (3,))):
        for n in numbers:
            draw(to / f"dataset/{clip}/gelsight_frame/{n:010}.jpg", n)
            draw(to / f"dataset/{clip}/video_frame/{n:010}.jpg", n + 5)
    # Without an end of line, as the lists are.
    (to / "test.txt").write_text("20220516_190814/0000000000.jpg,14\n20220517_192217/0000000002.jpg,5")
    (to / "train.txt").write_text("20220516_190814/0000000001.jpg,14\n20220607_133934/0000000003.jpg,4")


def feeling_of_success(to):
    to.mkdir(parents=True, exist_ok=True)
    for file, numbers in ((0, (0, 1)), (1, (2,))):
        grasps = {"is_gripping": [n != 1 for n in numbers]}
        for sensor, shift in (("gelsightA", 0), ("gelsightB", 5)):
            for moment in ("before", "during", "after"):
                shown = 8 if moment != "during" else shift
                grasps[f"{sensor}_{moment}"] = [encoded(n + shown) for n in numbers]
        with open(to / f"{file:03}.pkl", "wb") as pickled:
            pickle.dump(grasps, pickled)


def objectfolder_benchmark(to):
    for n in range(SAMPLES):
        draw(to / f"touch/{n // 2 + 1}/{n % 2}.png", n)
    (to / "label.json").write_text(json.dumps({"1": 3, "2": 6}))
    (to / "split.json").write_text(json.dumps({"train": [["1", 0], ["1", 1]], "test": [["2", 0]]}))


def active_clothing(to):
    for n, (cloth, trial, frame) in enumerate(((1, 1, 1), (1, 1, 2), (2, 3, 1))):
        draw(to / f"Data/{cloth}/{trial}/GelSight_frames/frame_{frame:04}.png", n)
        draw(to / f"Data/{cloth}/{trial}/background.png", 0)
    (to / "cloth_metadata.json").write_text(json.dumps({"1": [1] * 10 + [3], "2": [2] * 10 + [6]}))


def chunk(name, content):
    return name + struct.pack("<I", len(content)) + content + b"\0" * (len(content) % 2)


def clip(path, numbers):
    """Motion JPEG in AVI, with one stream and an index."""
    pictures = [encoded(n, "JPEG") for n in numbers]
    rate, (width, height), count = 25, picture(0).size, len(pictures)
    head = struct.pack("<14I", 1_000_000 // rate, 0, 0, 0x10, count, 0, 1, 0, width, height, 0, 0, 0, 0)
    stream = b"vidsMJPG" + struct.pack("<IHHIIIIIIII4H", 0, 0, 0, 0, 1, rate, 0, count, 0, 0xFFFFFFFF, 0, 0, 0, width, height)
    form = struct.pack("<IiiHH4sIiiII", 40, width, height, 1, 24, b"MJPG", width * height * 3, 0, 0, 0, 0)
    streams = chunk(b"LIST", b"strl" + chunk(b"strh", stream) + chunk(b"strf", form))
    movie, index = b"movi", b""
    for data in pictures:
        index += b"00dc" + struct.pack("<III", 0x10, len(movie), len(data))
        movie += chunk(b"00dc", data)
    body = b"AVI " + chunk(b"LIST", b"hdrl" + chunk(b"avih", head) + streams) + chunk(b"LIST", movie) + chunk(b"idx1", index)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(chunk(b"RIFF", body))


def poses(numbers):
    """Matrices at the places of the samples. Each is turned about z from the one before by an angle with the cosine 0.8."""
    turn = np.array([[0.8, -0.6, 0], [0.6, 0.8, 0], [0, 0, 1]])
    matrices = np.zeros((len(numbers), 4, 4))
    for at, n in enumerate(numbers):
        matrices[at, :3, :3] = np.linalg.matrix_power(turn, n)
        matrices[at, :3, 3] = place(n)
        matrices[at, 3, 3] = 1
    return matrices


def tactile_tracking(to):
    trial = to / "avocado1"
    clip(trial / "gelsight.avi", range(SAMPLES))
    np.save(trial / "true_start_T_currs.npy", poses(range(SAMPLES)))


def sparsh_pose(to):
    draw(to / "bgs/digit_index.png", 7)
    for part, numbers in (("test", (0,)), ("train", (1, 2))):
        sequence = {"object_poses": [[*place(n), 1, 0, 0, 0] for n in numbers]}
        for finger, shift in (("index", 0), ("middle", 3), ("ring", 5)):
            sequence[f"digit_{finger}"] = [encoded(n + shift) for n in numbers]
            sequence[f"object_{finger}_rel_pose_n5"] = poses(numbers)
        file = to / part / "sugar/bag_00.pkl"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(pickle.dumps(sequence))


def sparsh_slip(to):
    """Six presses in the layout of sparsh-force. Pictures are bright while the finger slips."""
    batch = to / "sphere/batch_1"
    batch.mkdir(parents=True, exist_ok=True)
    presses, frames = 6, 4
    pictures = []
    for number in range(presses * frames):
        slips = number % frames >= 2
        level = (180 if slips else 40) + 2 * (number % 3)
        image = Image.new("RGB", (32, 24), (level, 90, 120))
        into = io.BytesIO()
        image.save(into, "PNG")
        pictures.append(into.getvalue())
    with open(batch / "dataset_digit_00.pkl", "wb") as file:
        pickle.dump(pictures, file)
    trajectories = {
        press: {
            "indexes": np.arange(press * frames, (press + 1) * frames),
            "forces": np.array([force(n) for n in range(frames)]),
            "slip_label": np.array([0, 0, 1, 1]),
            "coef_friction": 0.5,
        }
        for press in range(presses)
    }
    with open(batch / "dataset_slip_forces.pkl", "wb") as file:
        pickle.dump({"in_contact": np.ones(presses * frames), "trajectories": trajectories}, file)


LAYOUTS = {
    "bristol": bristol, "py3dcal": py3dcal, "9dtact": nine_dtact, "allsight": allsight, "sparsh-force": sparsh_force,
    "ycb-slide": ycb_slide, "touchd": touchd, "tacquad": tacquad, "poseit": poseit, "tool-force": tool_force, "univtac": univtac,
    "gelsight-live": gelsight_live, "fota": fota, "diffusion-zarr": diffusion_zarr,
    "touch-and-go": touch_and_go, "feeling-of-success": feeling_of_success, "objectfolder-benchmark": objectfolder_benchmark,
    "tactile-tracking": tactile_tracking, "sparsh-pose": sparsh_pose, "active-clothing": active_clothing,
    "sparsh-slip": sparsh_slip,
}

if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", nargs="?", type=Path, default=Path(__file__).parent)
    parser.add_argument("--only", choices=LAYOUTS, help="draw this layout alone")
    given = parser.parse_args()
    for name in [given.only] if given.only else LAYOUTS:
        LAYOUTS[name](given.folder / name)
