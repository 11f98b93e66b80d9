//! Shared code of tests: the clips, the values of another decoder, and damaged copies.

#![allow(dead_code)]

use std::collections::BTreeMap;
use std::convert::Infallible;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use sha2::{Digest, Sha256};
use taceva_video::{Colours, Decoders, Picture, Video, VideoError, VisitError};

/// File `name` in the folder `clip` of this crate or, if it does not exist, of the shared recordings.
pub(crate) fn path(clip: &str, name: &str) -> PathBuf {
    let crate_folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let own = crate_folder.join("tests/data").join(clip);
    let folder = match own.exists() {
        true => own,
        false => crate_folder.join("../../../tests/recordings").join(clip),
    };
    folder.join(name)
}

/// Digests by frame number, from `key` in the `expected.json` of the folder `clip`.
pub(crate) fn expected(clip: &str, key: &str) -> BTreeMap<u64, String> {
    let text = std::fs::read_to_string(path(clip, "expected.json")).expect("readable");
    let json: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let digests = json[key].as_object().expect("an object");
    let digest = |value: &serde_json::Value| value.as_str().expect("text").to_owned();
    digests
        .iter()
        .map(|(number, value)| (number.parse().expect("a number"), digest(value)))
        .collect()
}

pub(crate) fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes)
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect()
}

/// Bytes of a picture.
pub(crate) fn bytes(picture: Picture) -> Vec<u8> {
    match picture {
        Picture::Jpeg(bytes) => bytes,
        Picture::Pixels { samples, .. } => samples,
        Picture::Deep { samples, .. } => samples.into_iter().flat_map(u16::to_le_bytes).collect(),
        other => panic!("{other:?} is new"),
    }
}

/// Digests of the frames `sorted`, in the order returned.
pub(crate) fn digests(clip: &Video, sorted: &[u64], colours: Colours) -> Vec<(u64, String)> {
    let mut shown = Vec::new();
    clip.visit(sorted, colours, &mut |index, picture| {
        shown.push((index, sha256(&bytes(picture))));
        Ok::<(), Infallible>(())
    })
    .unwrap_or_else(|error| panic!("{error}"));
    shown
}

/// Opens the clip and reads all its frames.
pub(crate) fn read_all(
    path: &Path,
    decoders: &Decoders,
    colours: Colours,
) -> Result<u64, VideoError> {
    let clip = Video::open(path, decoders)?;
    let all: Vec<u64> = (0..clip.info().frames).collect();
    let visited = clip.visit(&all, colours, &mut |_, _| Ok::<(), Infallible>(()));
    match visited {
        Ok(()) => Ok(clip.info().frames),
        Err(VisitError::Video(error)) => Err(error),
        Err(VisitError::Caller(never)) => match never {},
    }
}

/// Results of reading damaged copies of a clip.
#[derive(Debug, Default)]
pub(crate) struct Damage {
    pub(crate) refused: usize,
    pub(crate) read: usize,
}

/// Reads damaged copies of the file: 6 truncated, and 40 with flipped bits at 1 or 6 places. Each must give frames or a typed error. Reading must end, and the
/// process must stay below 512 MiB.
pub(crate) fn damage(file: &Path, decoders: &Decoders) -> Damage {
    let whole = std::fs::read(file).expect("readable");
    let length = whole.len();
    let folder = tempfile::tempdir().expect("a folder");
    let copy = folder.path().join("copy");
    let mut damage = Damage::default();
    let mut try_it = |name: &str, bytes: &[u8]| {
        std::fs::write(&copy, bytes).expect("written");
        let start = Instant::now();
        match read_all(&copy, decoders, Colours::Luma) {
            Ok(_) => damage.read += 1,
            Err(_) => damage.refused += 1,
        }
        let taken = start.elapsed();
        assert!(taken < Duration::from_secs(60), "{name} took {taken:?}");
    };
    for end in [
        1,
        length / 7,
        length / 3,
        length / 2,
        length - length / 8,
        length - 1,
    ] {
        try_it(&format!("cut after {end}"), &whole[..end]);
    }
    // Linear congruence with a fixed seed, upper bits.
    let mut state = length as u64;
    let mut below = |bound: usize| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(state >> 33).expect("31 bits") % bound
    };
    for number in 0..40 {
        let mut bytes = whole.clone();
        let reach = if number % 2 == 0 {
            length.min(1200)
        } else {
            length
        };
        for _ in 0..if number < 20 { 1 } else { 6 } {
            let flipped = if number % 3 == 0 { 0xff } else { 1 << below(8) };
            bytes[below(reach)] ^= flipped;
        }
        try_it(&format!("flip {number}"), &bytes);
    }
    let peak = peak_mib();
    assert!(peak.is_none_or(|peak| peak < 512), "{peak:?} MiB");
    assert_eq!(damage.read + damage.refused, 46);
    damage
}

/// Peak memory of the process, MiB; `None` if the system does not report it.
fn peak_mib() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kib: u64 = line.trim().strip_suffix(" kB")?.parse().ok()?;
    Some(kib / 1024)
}
