#!/usr/bin/env bash
# zune-jpeg 0.5.15: a baseline JPEG with one scan for each colour decodes to another picture, without an error.
#
# Such files are valid (T.81, A.2.2), and `jpegtran -scans` writes them. Strict mode accepts them as well.
# The script merges three gray JPEGs into one whose scans hold Y, Cb and Cr, and compares with libjpeg-turbo (Pillow).
# Seen: `Pillow [254, 0, 0], zune-jpeg [178, 0, 0]`.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv environment
environment/bin/pip install --quiet pillow==12.0.0

environment/bin/python - <<'PYTHON'
import io

from PIL import Image

def segments(level):
    """Tables of a gray JPEG of one level, and its entropy-coded data."""
    file = io.BytesIO()
    Image.new("L", (16, 16), level).save(file, "JPEG", quality=95)
    data, at, tables = file.getvalue(), 2, b""
    while data[at + 1] != 0xDA:
        length = 2 + int.from_bytes(data[at + 2 : at + 4], "big")
        if data[at + 1] in (0xDB, 0xC4):
            tables += data[at : at + length]
        at += length
    return tables, data[at + 2 + int.from_bytes(data[at + 2 : at + 4], "big") : -2]

scans = [segments(level) for level in (76, 85, 255)]
frame = bytes([0xFF, 0xC0, 0, 17, 8, 0, 16, 0, 16, 3, 1, 0x11, 0, 2, 0x11, 0, 3, 0x11, 0])
merged = b"\xff\xd8" + scans[0][0] + frame
for component, (_, coded) in enumerate(scans, 1):
    merged += bytes([0xFF, 0xDA, 0, 8, 1, component, 0, 0, 63, 0]) + coded
open("scans.jpg", "wb").write(merged + b"\xff\xd9")
image = Image.open("scans.jpg").convert("RGB")
open("expected", "w").write(str(list(image.getpixel((8, 8)))))
PYTHON

mkdir src
cat > Cargo.toml <<'TOML'
[package]
name = "scans"
version = "0.0.0"
edition = "2024"

[dependencies]
zune-core = "=0.5.1"
zune-jpeg = "=0.5.15"
TOML
cat > src/main.rs <<'RUST'
use zune_core::bytestream::ZCursor;
use zune_core::colorspace::ColorSpace;
use zune_core::options::DecoderOptions;

fn main() {
    let bytes = std::fs::read("scans.jpg").unwrap();
    let options = DecoderOptions::default()
        .set_strict_mode(true)
        .jpeg_set_out_colorspace(ColorSpace::RGB);
    let mut decoder = zune_jpeg::JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    let pixels = decoder.decode().unwrap();
    let middle = 3 * (8 * 16 + 8);
    print!("{:?}", &pixels[middle..middle + 3]);
}
RUST
found=$(CARGO_TARGET_DIR=target cargo run --quiet)
expected=$(cat expected)
echo "Pillow $expected, zune-jpeg $found"
[ "$expected" = "[254, 0, 0]" ] && [ "$found" = "[178, 0, 0]" ]
