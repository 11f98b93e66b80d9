//! Tests of the memory and processor time for hostile inputs, each in a separate process: at most 300 MB and 20 s.

use std::fs;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use taceva_core::SilentProgress;
use taceva_import::{ImportMap, ImportPlan, MapDraft, UnpackedArchive};

use super::{FACTS, NO_TIME};

const MOST_BYTES: u64 = 300_000_000;
const MOST_S: f64 = 20.0;

/// Environment variable with the folder of the input, for the measured process.
const FOLDER: &str = "TACEVA_BOUNDED_FOLDER";
/// Name of this test, which the measured process runs alone.
const CHILD: &str =
    "suspect_inputs::bounded::the_input_that_another_test_names_is_imported_and_measured";

/// Files of an input: a folder `lab` or an archive `lab.tar`, and a map if the input is imported. Without a map, a draft is made.
struct Input {
    folder: tempfile::TempDir,
}

impl Input {
    fn new() -> Input {
        let folder = tempfile::tempdir().expect("a folder");
        fs::create_dir(folder.path().join("lab")).expect("made");
        Input { folder }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().expect("inside")).expect("made");
        fs::write(path, bytes).expect("written");
    }

    /// Outcome in words, after a check that memory and time were within the limits.
    #[track_caller]
    fn outcome(&self) -> String {
        let program = std::env::current_exe().expect("this program");
        let ran = Command::new(program)
            .args(["--exact", CHILD])
            .env(FOLDER, self.folder.path())
            .stdout(Stdio::null())
            .status()
            .expect("it starts");
        assert!(ran.success(), "{ran}");
        let taken = fs::read_to_string(self.path("taken.txt")).expect("the test of this name ran");
        let mut lines = taken.lines();
        let mut line = || lines.next().expect("a line").to_owned();
        let bytes: u64 = line().parse().expect("bytes");
        let seconds: f64 = line().parse().expect("seconds");
        let said = line();
        assert!(bytes <= MOST_BYTES, "{bytes} bytes: {said}");
        assert!(seconds <= MOST_S, "{seconds} s: {said}");
        said
    }
}

#[test]
fn the_input_that_another_test_names_is_imported_and_measured() {
    let Some(folder) = std::env::var_os(FOLDER).map(PathBuf::from) else {
        return;
    };
    let said = taken_in(&folder).unwrap_or_else(|problem| problem);
    let status = fs::read_to_string("/proc/self/status").expect("a status");
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let peak = peak.and_then(|peak| peak.trim().strip_suffix(" kB"));
    let kibibytes: u64 = peak.and_then(|peak| peak.parse().ok()).expect("a peak");
    let stat = fs::read_to_string("/proc/self/stat").expect("a status");
    let (_, behind_name) = stat.rsplit_once(')').expect("a name");
    // The user and the system time, in hundredths of a second.
    let times = behind_name.split_whitespace().skip(11).take(2);
    let ticks: f64 = times
        .map(|time| time.parse::<f64>().expect("a number"))
        .sum();
    let one_line = said.replace('\n', " ");
    let taken = format!("{}\n{}\n{one_line}\n", kibibytes << 10, ticks / 100.0);
    fs::write(folder.join("taken.txt"), taken).expect("written");
}

/// Imports the input in `folder`, or drafts its map. Returns a text that names the number of imported rows or the draft; the error in words.
fn taken_in(folder: &Path) -> Result<String, String> {
    let archive = folder.join("lab.tar");
    let unpacked = archive
        .exists()
        .then(|| UnpackedArchive::open(&archive, folder, &SilentProgress));
    let unpacked = unpacked.transpose().map_err(|error| error.to_string())?;
    let lab = folder.join("lab");
    let lab = unpacked
        .as_ref()
        .map_or(lab.as_path(), |unpacked| unpacked.folder());
    let Ok(map) = fs::read_to_string(folder.join("map.toml")) else {
        let draft = MapDraft::of(lab).map_err(|error| error.to_string())?;
        return Ok(format!("a draft of {} bytes", draft.text().len()));
    };
    let map = ImportMap::parse("map.toml".as_ref(), &map).map_err(|error| error.to_string())?;
    let plan = ImportPlan::new(lab, &map).map_err(|error| error.to_string())?;
    let rows = plan.summary().rows_kept;
    plan.run(&folder.join("set"), NonZeroUsize::MIN, &SilentProgress)
        .map_err(|error| error.to_string())?;
    Ok(format!("{rows} rows imported"))
}

/// HDF5 file of 375 kB: 1,200 frames of 640 by 480 in chunks that contain all frames.
fn planes() -> Vec<u8> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../formats/arrays/tests/data/refused/planes.h5.gz");
    let packed = fs::read(path).expect("readable");
    let inflated = miniz_oxide::inflate::decompress_to_vec(&packed[10..packed.len() - 8]);
    inflated.expect("deflated")
}

/// Offset of the first `part` in `whole`.
fn place_of(whole: &[u8], part: &[u8]) -> usize {
    let mut places = whole.windows(part.len());
    places.position(|window| window == part).expect("there")
}

/// HDF5 file like [`planes`], but with only 200 frames, which may be unpacked.
fn fewer_planes() -> Vec<u8> {
    const FRAMES: u32 = 200;
    let mut bytes = planes();
    // The shape stands there twice, since the file may also state the greatest one.
    let shape = [1_200_u64, 480, 640].map(u64::to_le_bytes).concat();
    for _ in 0..2 {
        let at = place_of(&bytes, &shape);
        bytes[at..at + 8].copy_from_slice(&u64::from(FRAMES).to_le_bytes());
    }
    let chunk = [1_200_u32, 8, 640].map(u32::to_le_bytes).concat();
    let at = place_of(&bytes, &chunk);
    bytes[at..at + 4].copy_from_slice(&FRAMES.to_le_bytes());
    let zeros = vec![0; FRAMES as usize * 8 * 640];
    let packed = miniz_oxide::deflate::compress_to_vec_zlib(&zeros, 6);
    let size = u32::try_from(packed.len()).expect("small");
    // 60 chunks in one node: of each a key of 40 bytes, which begins with its size, and its address.
    let node = place_of(&bytes, b"TREE\x01") + 24;
    for number in 0..60 {
        let key = node + 48 * number;
        bytes[key..key + 4].copy_from_slice(&size.to_le_bytes());
        let address = bytes[key + 40..key + 48].try_into().expect("eight");
        let address = usize::try_from(u64::from_le_bytes(address)).expect("inside");
        bytes[address..address + packed.len()].copy_from_slice(&packed);
    }
    bytes
}

#[test]
fn k5_small_files_of_chunks_of_whole_planes_take_little_memory_and_time() {
    let map = format!(
        "map_version = 2\ntable = \"labels.csv\"\n[frame]\narray = {{ file = \"run.h5\", path = \"/frames\" }}\nchannel_order = \"gray\"\nreference = \"unknown\"\n[columns]\nFz = {{ from = \"z\", unit = \"N\" }}\n{NO_TIME}{FACTS}"
    );
    for (file, rows, expected) in [
        (planes(), 1_200, "times the size of the file"),
        (fewer_planes(), 200, "200 rows imported"),
    ] {
        let input = Input::new();
        input.write("lab/run.h5", file);
        input.write("lab/labels.csv", format!("z\n{}", "1\n".repeat(rows)));
        input.write("map.toml", &map);
        let said = input.outcome();
        assert!(said.contains(expected), "{said}");
    }
}

#[test]
fn k9_an_archive_of_100_000_empty_members_is_refused_with_little_memory_and_time() {
    let input = Input::new();
    let file = fs::File::create(input.path("lab.tar")).expect("made");
    let mut archive = tar::Builder::new(std::io::BufWriter::new(file));
    for number in 0..100_000 {
        let mut header = tar::Header::new_ustar();
        header.set_size(0);
        header.set_path(format!("f{number}")).expect("a name");
        header.set_cksum();
        archive.append(&header, std::io::empty()).expect("added");
    }
    archive.finish().expect("written");
    drop(archive);
    let said = input.outcome();
    assert!(said.contains("20000 empty files and folders"), "{said}");
}

#[test]
fn k9_links_to_folders_above_them_take_little_memory_and_time() {
    let input = Input::new();
    input.write("lab/labels.csv", "z\n1\n2\n");
    // A walk along these links finds the same folders again and again.
    for folder in 0..64 {
        let folder = input.path(&format!("lab/{folder}"));
        fs::create_dir(&folder).expect("made");
        for link in 0..64 {
            let link = folder.join(format!("up{link}"));
            std::os::unix::fs::symlink("..", link).expect("linked");
        }
    }
    let said = input.outcome();
    assert!(said.starts_with("a draft of"), "{said}");
    let map = format!(
        "map_version = 2\ntable = \"labels.csv\"\n[columns]\nFz = {{ from = \"z\", unit = \"N\" }}\n{NO_TIME}{FACTS}"
    );
    input.write("map.toml", map);
    assert_eq!(input.outcome(), "2 rows imported");
}

#[test]
fn k9_groups_of_hdf5_that_contain_each_other_take_little_memory_and_time() {
    let cycle = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../formats/arrays/tests/data/refused/cycle.h5");
    let input = Input::new();
    input.write("lab/run.h5", fs::read(cycle).expect("readable"));
    input.outcome();
    let map = format!(
        "map_version = 2\ntable = \"run.h5\"\n[columns]\nFz = {{ from = \"/a/b/x\", unit = \"N\" }}\n{NO_TIME}{FACTS}"
    );
    input.write("map.toml", map);
    let said = input.outcome();
    assert!(said.ends_with("rows imported"), "{said}");
}
