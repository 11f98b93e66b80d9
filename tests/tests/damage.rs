//! Tests that no frame of a dataset is accepted with other pixels after its picture was truncated or had a bit flipped.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use taceva_core::{Frame, SilentProgress};
use taceva_dataset::{Dataset, DatasetError};
use taceva_import::{ImportError, ImportMap, ImportPlan};
use taceva_tests::{Form, Lab, Random, picture, recording, scratch};

const SEED: u64 = 20_261_122;
/// Number of real pictures of each format.
const REAL_PICTURES: usize = 66;

/// Damage of a file.
#[derive(Clone, Copy, Debug)]
enum Damage {
    /// Truncated to this many bytes.
    Truncated(usize),
    /// One bit of one byte is flipped.
    Flipped(usize, u32),
}

impl Damage {
    fn of(self, bytes: &[u8]) -> Vec<u8> {
        let mut damaged = bytes.to_vec();
        match self {
            Damage::Truncated(length) => damaged.truncate(length),
            Damage::Flipped(byte, bit) => damaged[byte] ^= 1 << bit,
        }
        damaged
    }
}

fn import(lab: &Lab, target: &Path) -> Result<Dataset, ImportError> {
    let map = ImportMap::read(&lab.map())?;
    ImportPlan::new(lab.path(), &map)?.run(target, NonZeroUsize::MIN, &SilentProgress)?;
    Ok(Dataset::open(target)?)
}

/// Counts of damaged copies.
#[derive(Debug, Default)]
struct Counts {
    /// Number of damaged copies of a stored frame.
    copies: usize,
    /// Number of rejected copies.
    refused: usize,
    /// Number of truncated pictures that were imported.
    truncations: usize,
    /// Number of rejected truncations.
    truncations_refused: usize,
    /// Number of pictures with a flipped bit that were imported.
    flips: usize,
    /// Number of rejected flips.
    flips_refused: usize,
    /// Number of accepted flips with other pixels.
    flips_seen_wrong: usize,
}

/// Damages the stored file of the only frame of a dataset, then the same picture before its import.
fn try_damages(form: Form, order: &str, bytes: &[u8], damages: &[Damage], counts: &mut Counts) {
    let lab = Lab::new(form, order, &[bytes.to_vec()]);
    let folder = scratch();
    let target = folder.path().join("whole");
    let dataset = import(&lab, &target).expect("an undamaged picture");
    let original = dataset.frame(0).expect("whole").expect("it has a frame");
    let stored = dataset.table().frames()[0]
        .as_ref()
        .expect("it has a frame");
    let stored = target.join(&stored.path);
    for damage in damages {
        let damaged = damage.of(bytes);
        std::fs::write(&stored, &damaged).expect("written");
        counts.copies += 1;
        match dataset.frame(0) {
            Err(DatasetError::Digest { .. }) => counts.refused += 1,
            accepted => panic!("{damage:?}: {accepted:?}"),
        }
        std::fs::write(lab.picture(form, 0), &damaged).expect("written");
        let imported = import(&lab, &folder.path().join("damaged"));
        let pixels = imported.map(|dataset| dataset.frame(0).expect("as imported"));
        count_import(*damage, &original, &pixels, counts);
        if pixels.is_ok() {
            std::fs::remove_dir_all(folder.path().join("damaged")).expect("imported");
        }
    }
}

fn count_import(
    damage: Damage,
    original: &Frame,
    imported: &Result<Option<Frame>, ImportError>,
    counts: &mut Counts,
) {
    let is_refused = usize::from(imported.is_err());
    match damage {
        Damage::Truncated(_) => {
            counts.truncations += 1;
            counts.truncations_refused += is_refused;
        }
        Damage::Flipped(..) => {
            counts.flips += 1;
            counts.flips_refused += is_refused;
            let is_other = matches!(imported, Ok(Some(frame)) if frame != original);
            counts.flips_seen_wrong += usize::from(is_other);
        }
    }
}

#[expect(clippy::print_stderr, reason = "the counts are the result")]
fn assert_refused(what: &str, counts: &Counts) {
    eprintln!("{what}: {counts:?}");
    assert_eq!(counts.refused, counts.copies, "{what}: {counts:?}");
    assert_eq!(
        counts.truncations_refused, counts.truncations,
        "{what}: {counts:?}"
    );
}

#[test]
fn a_drawn_png_damaged_anywhere_is_refused_in_a_dataset_and_at_import() {
    let counts = damage_drawn(Form::Png);
    assert_refused("drawn PNG", &counts);
    assert_eq!(
        counts.flips_seen_wrong, 0,
        "PNG checks every part: {counts:?}"
    );
}

#[test]
fn a_drawn_jpeg_damaged_anywhere_is_refused_in_a_dataset_and_cut_short_at_import() {
    assert_refused("drawn JPEG", &damage_drawn(Form::Jpeg));
}

/// Damages a drawn picture: truncates it at every seventh byte, and flips a bit in every eleventh byte.
fn damage_drawn(form: Form) -> Counts {
    let bytes = picture(form, 3);
    let truncations = (0..bytes.len()).step_by(7).map(Damage::Truncated);
    let last = Damage::Truncated(bytes.len() - 1);
    let mut random = Random::new(SEED);
    let mut bit = || u32::try_from(random.below(8)).expect("below eight");
    let flips = (0..bytes.len())
        .step_by(11)
        .map(|byte| Damage::Flipped(byte, bit()));
    let damages: Vec<Damage> = truncations.chain([last]).chain(flips).collect();
    let mut counts = Counts::default();
    try_damages(form, "gray", &bytes, &damages, &mut counts);
    counts
}

#[test]
fn real_jpegs_damaged_on_disk_are_refused() {
    damage_real(
        Form::Jpeg,
        &[("gelsight-wedge-grasp", "rgb", REAL_PICTURES)],
    );
}

#[test]
fn real_pngs_damaged_on_disk_are_refused() {
    damage_real(
        Form::Png,
        &[
            ("tactip-force", "gray", 22),
            ("gelsight-mini-materials", "rgb", 22),
            ("gelsight-ball-depth", "rgb", 22),
        ],
    );
}

/// Damages each picture of `recordings` three times: two truncations and one flipped bit.
fn damage_real(form: Form, recordings: &[(&str, &str, usize)]) {
    let mut counts = Counts::default();
    let mut random = Random::new(SEED);
    for (name, order, wanted) in recordings {
        let Some(folder) = recording(name) else {
            return;
        };
        let pictures = pictures_below(&folder, form);
        assert!(
            pictures.len() >= *wanted,
            "{name}: {} pictures",
            pictures.len()
        );
        let step = pictures.len() / wanted;
        for path in pictures.iter().step_by(step).take(*wanted) {
            let bytes = std::fs::read(path).expect("a picture of a recording");
            let damages = [
                Damage::Truncated(random.below(bytes.len())),
                Damage::Truncated(bytes.len() - 1 - random.below(64)),
                Damage::Flipped(
                    random.below(bytes.len()),
                    u32::try_from(random.below(8)).expect("below eight"),
                ),
            ];
            try_damages(form, order, &bytes, &damages, &mut counts);
        }
    }
    assert_eq!(counts.copies, 3 * REAL_PICTURES, "seed {SEED}");
    assert_refused(&format!("real {form:?}"), &counts);
}

/// Every picture of a format below `folder`, by name.
fn pictures_below(folder: &Path, form: Form) -> Vec<PathBuf> {
    let mut entries: Vec<PathBuf> = folder
        .read_dir()
        .expect("a folder of a recording")
        .map(|entry| entry.expect("readable").path())
        .collect();
    entries.sort();
    let mut pictures = Vec::new();
    for path in entries {
        if path.is_dir() {
            pictures.extend(pictures_below(&path, form));
        } else if path
            .extension()
            .is_some_and(|extension| extension == form.extension())
        {
            pictures.push(path);
        }
    }
    pictures
}
