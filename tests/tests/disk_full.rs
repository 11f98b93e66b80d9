//! Tests of a full disk at every stage. The error states this, no partial file remains, and the work continues once there is space.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use taceva_needs::{Need, skip};
use taceva_tests::recorded::{Recorded, open_whole};
use taceva_tests::{Form, Lab, scratch, taceva};

/// Exit code for invalid input and for errors of the system.
const REFUSED: i32 = 3;

fn import(lab: &Lab, target: &Path) -> Vec<PathBuf> {
    let mut words: Vec<PathBuf> = vec![taceva()];
    words.extend(["import", "--quiet", "--jobs", "1"].map(PathBuf::from));
    words.extend([lab.path().to_owned(), "--map".into(), lab.map()]);
    words.extend(["--out".into(), target.to_owned()]);
    words
}

fn recorder(recorded: &Recorded, target: &Path) -> Vec<PathBuf> {
    let command = recorded.command(target);
    let arguments = command.get_args().map(PathBuf::from);
    std::iter::once(PathBuf::from(command.get_program()))
        .chain(arguments)
        .collect()
}

/// Runs a command whose files are limited to `blocks` of 512 bytes: larger writes fail, as on a full disk.
fn with_small_files(blocks: usize, words: &[PathBuf]) -> Output {
    // Ignored signals stay ignored in children: the write fails instead of the process.
    let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$@\"");
    Command::new("sh")
        .args(["-c", &script, "sh"])
        .args(words)
        .output()
        .expect("there is a shell")
}

fn complaint(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Asserts the result of a failed import: no target, no other file, and an error that names the failed operation.
fn assert_left_nothing(output: &Output, folder: &Path, reason: &str) {
    let complaint = complaint(output);
    assert_eq!(output.status.code(), Some(REFUSED), "{complaint}");
    assert!(complaint.contains("cannot write"), "{complaint}");
    assert!(complaint.contains(reason), "{complaint}");
    let left: Vec<_> = folder.read_dir().expect("there").collect();
    assert!(left.is_empty(), "{left:?}");
}

#[test]
fn an_import_whose_files_cannot_grow_says_so_and_leaves_nothing() {
    let lab = Lab::drawn(Form::Png, 6);
    let folder = scratch();
    let target = folder.path().join("set");
    let mut refusals = 0;
    // Pictures are smaller than the table: some limits fail at a picture, some later.
    for blocks in 0..64 {
        let output = with_small_files(blocks, &import(&lab, &target));
        if output.status.success() {
            break;
        }
        assert_left_nothing(&output, folder.path(), "File too large");
        refusals += 1;
    }
    assert!(refusals >= 3, "{refusals} limits were met");
    open_whole(&target).expect("imported once there was room");
}

#[test]
fn an_export_whose_files_cannot_grow_says_so_and_leaves_nothing() {
    let lab = Lab::drawn(Form::Png, 6);
    let sets = scratch();
    let set = sets.path().join("set");
    assert!(
        with_small_files(1 << 20, &import(&lab, &set))
            .status
            .success()
    );
    for form in ["csv", "huggingface", "hdf5", "lerobot"] {
        let folder = scratch();
        let target = folder.path().join("out");
        let mut words: Vec<PathBuf> = vec![taceva()];
        words.extend(["export", "--quiet", "--jobs", "1", "--format", form].map(PathBuf::from));
        words.extend([set.clone(), "--out".into(), target.clone()]);
        let mut refusals = 0;
        for blocks in 0..256 {
            let output = with_small_files(blocks, &words);
            if output.status.success() {
                break;
            }
            assert_left_nothing(&output, folder.path(), "File too large");
            refusals += 1;
        }
        assert!(
            refusals >= 1 && target.join("map.toml").is_file(),
            "{form}: {refusals}"
        );
    }
}

#[test]
fn a_recording_whose_files_cannot_grow_is_resumed_where_there_is_room() {
    let recorded = Recorded::up_to(30);
    let mut refusals = 0;
    for blocks in [0, 1, 2, 4, 8, 16] {
        let folder = scratch();
        let target = folder.path().join("set");
        let output = with_small_files(blocks, &recorder(&recorded, &target));
        assert!(!output.status.success(), "{blocks} blocks held a journal");
        let complaint = complaint(&output);
        assert!(complaint.contains("FileTooLarge"), "{complaint}");
        refusals += 1;
        let said = String::from_utf8_lossy(&output.stdout);
        assert_eq!(recorded.check(&target, highest_acknowledged(&said)), Ok(()));
    }
    assert_eq!(refusals, 6);
}

fn highest_acknowledged(said: &str) -> usize {
    said.lines()
        .filter_map(|line| line.strip_prefix("ACK ")?.parse().ok())
        .max()
        .unwrap_or(0)
}

/// Results of a command on a disk that is too small, and again with enough space.
struct TwoRuns {
    /// Exit code, standard output and standard error of the first and the second run.
    runs: [(i32, String, String); 2],
    /// Names of the files on the disk after the first run.
    left: String,
    /// Copy of the target after the second run.
    copied: tempfile::TempDir,
}

/// Runs a command twice on a private disk, first of `kib` KiB and then large enough; `None` without the required permission.
fn on_small_disk(disk: &Path, kib: usize, words: &[PathBuf]) -> Option<TwoRuns> {
    let copied = scratch();
    let output = Command::new("unshare")
        .args(["--mount", "sh", "-c", TWO_RUNS])
        .arg(disk)
        .arg(copied.path())
        .arg(format!("size={kib}k"))
        .args(words)
        .output();
    let problem = match output {
        Ok(output) if output.status.success() => {
            let read = |name: &str| {
                std::fs::read_to_string(copied.path().join(name)).expect("the script wrote it")
            };
            let code = |name| read(name).trim().parse().expect("a number");
            return Some(TwoRuns {
                runs: [
                    (code("code.1"), read("out.1"), read("error.1")),
                    (code("code.2"), read("out.2"), read("error.2")),
                ],
                left: read("left"),
                copied,
            });
        }
        Ok(output) => {
            let problem = complaint(&output);
            let may_not = output.status.code() == Some(99) || problem.starts_with("unshare:");
            assert!(may_not, "{problem}");
            problem
        }
        Err(error) => error.to_string(),
    };
    skip(Need::Mount, problem);
    None
}

const TWO_RUNS: &str = r#"
disk=$0 copied=$1 size=$2
shift 2
mount -t tmpfs -o "$size" tmpfs "$disk" || exit 99
"$@" >"$copied/out.1" 2>"$copied/error.1"; echo $? >"$copied/code.1"
ls -A "$disk" >"$copied/left"
mount -o remount,size=64m "$disk" || exit 98
"$@" >"$copied/out.2" 2>"$copied/error.2"; echo $? >"$copied/code.2"
cp -r "$disk/set" "$copied/set"
"#;

#[test]
fn an_import_to_a_full_disk_says_so_and_leaves_nothing() {
    let lab = Lab::drawn(Form::Png, 24);
    let folder = scratch();
    let words = import(&lab, &folder.path().join("set"));
    let mut refusals = 0;
    // Disk sizes in steps of three pages, from one page to enough.
    for kib in (4..400).step_by(12) {
        let Some(tried) = on_small_disk(folder.path(), kib, &words) else {
            return;
        };
        let [(code, _, complaint), (second, _, again)] = &tried.runs;
        if *code == 0 {
            break;
        }
        assert_eq!(*code, REFUSED, "{kib} KiB: {complaint}");
        // Reported before the work began, or at a write.
        let is_told =
            ["No space left", "nothing was started"].map(|words| complaint.contains(words));
        assert!(is_told.contains(&true), "{complaint}");
        assert_eq!(tried.left, "", "{kib} KiB: {complaint}");
        assert_eq!(*second, 0, "{kib} KiB: {again}");
        open_whole(&tried.copied.path().join("set")).expect("imported once there was room");
        refusals += 1;
    }
    assert!(refusals >= 5, "{refusals} disks were too small");
}

#[test]
fn a_recording_on_a_full_disk_goes_on_where_there_is_room() {
    let recorded = Recorded::up_to(30);
    let folder = scratch();
    let words = recorder(&recorded, &folder.path().join("set"));
    let mut refusals = 0;
    // Disk sizes in steps of one page, from one page to enough: frames lie in a pack, so a few pages hold everything.
    for kib in (4..240).step_by(4) {
        let Some(tried) = on_small_disk(folder.path(), kib, &words) else {
            return;
        };
        let [(code, said, complaint), (second, resumed, again)] = &tried.runs;
        if *code == 0 {
            break;
        }
        assert!(complaint.contains("StorageFull"), "{kib} KiB: {complaint}");
        assert_eq!(*second, 0, "{kib} KiB: {again}");
        let rows: usize = resumed
            .lines()
            .find_map(|line| line.strip_prefix("RESUMED ")?.parse().ok())
            .expect("the recorder says where it goes on");
        let before = highest_acknowledged(said);
        assert!(
            rows >= before,
            "{kib} KiB: {rows} of {before} samples are left"
        );
        let copy = tried.copied.path().join("set");
        assert_eq!(recorded.check_closed(&copy, recorded.most()), Ok(()));
        refusals += 1;
    }
    assert!(refusals >= 5, "{refusals} disks were too small");
}
