//! The disk becomes full while a rig is pressing. The run ends with a typed error, the arm leaves the gel, and the recording resumes once
//! there is space.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use taceva_needs::{Need, skip};
use taceva_tests::wire::{OnTheWire, RUN, scene_of};
use taceva_tests::{scratch, taceva};
use taceva_wire::{BenchOptions, ServeOptions};

const SEED: u64 = 7;
const PRESSES: usize = 8;
/// Exit code for errors of the system.
const REFUSED: &str = "3";

/// Script of a run on a private disk, which is filled once `fill` exists and emptied once `empty` exists. A run that a busy machine ends
/// (exit code 4: a late reading) is resumed.
const ON_A_DISK: &str = r#"
disk=$0 said=$1
shift 1
mount -t tmpfs -o size=32m tmpfs "$disk" || exit 99
for try in 1 2 3 4 5 6 7 8; do
    if [ -d "$disk/wire" ]; then resume=--resume; else resume=; fi
    "$@" $resume >"$said/out.1" 2>"$said/error.1" & run=$!
    until [ -e "$said/fill" ] || ! kill -0 $run 2>/dev/null; do sleep 0.02; done
    if [ -e "$said/fill" ] && [ ! -e "$disk/ballast" ]; then
        dd if=/dev/zero of="$disk/ballast" bs=64k 2>/dev/null
        dd if=/dev/zero of="$disk/ballast.end" bs=512 2>/dev/null
    fi
    wait $run; code=$?
    echo $code >"$said/code.1"
    [ $code = 4 ] || break
done
ls -A "$disk/wire/recordings" >"$said/left"
touch "$said/first"
until [ -e "$said/empty" ]; do sleep 0.02; done
rm "$disk/ballast" "$disk/ballast.end"
for try in 1 2 3 4 5 6 7 8; do
    "$@" --resume >"$said/out.2" 2>"$said/error.2"; code=$?
    echo $code >"$said/code.2"
    [ $code = 4 ] || break
done
cp -r "$disk/wire" "$said/wire"
"#;

/// Waits until `seen` returns true, or until the script has ended.
fn until(script: &mut Child, doing: &str, mut seen: impl FnMut() -> bool) {
    let patience = Instant::now() + Duration::from_secs(300);
    while !seen() {
        assert!(Instant::now() < patience, "{doing} never happened");
        if script.try_wait().expect("a child").is_some() {
            return;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
}

#[test]
fn a_disk_that_is_full_amid_presses_ends_the_run_above_the_gel_and_nothing_is_lost_or_doubled() {
    let on = OnTheWire::new(
        &ServeOptions::over(BenchOptions::quiet(SEED)),
        &scene_of(PRESSES),
    );
    let (disk, said) = (scratch(), scratch());
    let words = [
        "run",
        "wire.toml",
        "--rig",
        "rig.toml",
        "--no-cache",
        "--quiet",
        "--out",
    ];
    let mut script = Command::new("unshare")
        .args(["--mount", "sh", "-c", ON_A_DISK])
        .args([disk.path(), said.path()])
        .arg(taceva())
        .args(words)
        .arg(disk.path().join(RUN))
        .current_dir(on.folder())
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn();
    let Ok(script) = &mut script else {
        skip(Need::Mount, "there is no unshare");
        return;
    };
    let bench = on.served.bench();
    // The gentle touch of the session, and three presses.
    let (mut touches, mut is_deep) = (0, false);
    until(script, "a third press", || {
        let is_deep_now = bench.truth().tip_mm[2] > 0.2;
        touches += usize::from(is_deep_now && !is_deep);
        is_deep = is_deep_now;
        touches >= 4
    });
    let mark = |name: &str| fs::write(said.path().join(name), "").expect("room");
    mark("fill");
    until(script, "the end of the first run", || {
        said.path().join("first").exists()
    });
    let truth = bench.truth();
    mark("empty");
    let mut complaint = String::new();
    let mut errors = script.stderr.take().expect("piped");
    std::io::Read::read_to_string(&mut errors, &mut complaint).expect("text");
    let status = script.wait().expect("a child");
    if status.code() == Some(99) || complaint.starts_with("unshare:") {
        skip(Need::Mount, complaint);
        return;
    }
    let read = |name: &str| fs::read_to_string(said.path().join(name)).expect(name);
    let first = read("error.1");
    assert_eq!(read("code.1").trim(), REFUSED, "{first}");
    assert!(first.contains("cannot record the press"), "{first}");
    assert!(first.contains("No space left on device"), "{first}");
    assert!(!truth.is_moving && truth.tip_mm[2] < -0.9, "{truth:?}");
    assert!(!read("left").trim().is_empty(), "the journal is kept");
    assert_eq!(read("code.2").trim(), "0", "{}", read("error.2"));
    let recording = said.path().join(RUN).join("recordings/1-wire");
    assert_eq!(presses_of(&recording), PRESSES);
}

/// Number of contact points that have each of their two samples once.
fn presses_of(recording: &Path) -> usize {
    let dataset =
        taceva_dataset::Dataset::open(recording).unwrap_or_else(|error| panic!("{error}"));
    let mut samples: Vec<&String> = dataset.table().samples().iter().collect();
    samples.sort();
    let count = samples.len();
    samples.dedup();
    assert_eq!(samples.len(), count, "no sample is there twice");
    assert!(count.is_multiple_of(2), "{count}");
    count / 2
}
