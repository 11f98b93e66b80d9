//! Trainings killed repeatedly at random moments, or out of disk space: the model has the same bytes as without interruption.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use taceva_tests::{Form, Lab, Random, scratch, taceva};

const SEED: u64 = 20_261_122;
const KILLS: usize = 24;

/// A recording of drawn pictures, and a folder for models.
struct Bench {
    folder: tempfile::TempDir,
}

impl Bench {
    fn new() -> Bench {
        let (lab, folder) = (Lab::drawn(Form::Png, 24), scratch());
        let bench = Bench { folder };
        let imported = Command::new(taceva())
            .args(["import", "--quiet"])
            .args([
                lab.path().as_os_str(),
                "--map".as_ref(),
                lab.map().as_os_str(),
            ])
            .args(["--out".as_ref(), bench.path("set").as_os_str()])
            .output();
        assert!(imported.expect("the program was built").status.success());
        bench
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Command of a training with sixty steps of a small network and a checkpoint after each.
    fn fit(&self, model: &str, settings: &[&str]) -> Command {
        let mut command = Command::new(taceva());
        command
            .args([
                "fit",
                "--quiet",
                "--no-cache",
                "--model",
                "cnn",
                "--split",
                "random",
            ])
            .args(["--checkpoint-every", "0"])
            .args([&self.path("set"), Path::new("--out"), &self.path(model)]);
        for setting in ["size=16x16", "batch=8"].iter().chain(settings) {
            command.args(["--set", setting]);
        }
        command
    }

    /// Bytes of the model of an uninterrupted training.
    fn undisturbed(&self) -> Vec<u8> {
        let output = output(&mut self.fit("whole.model", &LONG));
        assert!(output.status.success(), "{}", complaint(&output));
        assert!(!self.path("whole.model.checkpoint").exists());
        fs::read(self.path("whole.model")).expect("written")
    }
}

const LONG: [&str; 1] = ["epochs=30"];

fn output(command: &mut Command) -> Output {
    command.output().expect("the program was built")
}

fn complaint(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Inode and modification time of the file, which change when it is replaced.
fn mark(path: &Path) -> Option<(u64, std::time::SystemTime)> {
    use std::os::unix::fs::MetadataExt;
    let found = fs::metadata(path).ok()?;
    Some((found.ino(), found.modified().ok()?))
}

/// Starts `command` and kills it a while after `checkpoint` was written, or after its start. True if it was killed.
fn killed(command: &mut Command, checkpoint: Option<&Path>, random: &mut Random) -> bool {
    let before = checkpoint.and_then(mark);
    let mut child = command
        .stdout(Stdio::null())
        .spawn()
        .expect("the program was built");
    let patience = Instant::now() + Duration::from_secs(60);
    while let Some(path) = checkpoint {
        let is_over = child.try_wait().expect("a child").is_some();
        if mark(path) != before || is_over || Instant::now() > patience {
            break;
        }
        std::thread::yield_now();
    }
    let micros = random.below(if checkpoint.is_some() {
        40_000
    } else {
        400_000
    });
    let end = Instant::now() + Duration::from_micros(micros as u64);
    while Instant::now() < end {
        std::thread::yield_now();
    }
    // SIGKILL; a finished child cannot be killed and has an exit status.
    let _ = child.kill();
    !child.wait().expect("a child").success()
}

#[test]
fn a_training_that_is_killed_again_and_again_gives_the_model_of_one_that_is_not() {
    let bench = Bench::new();
    let expected = bench.undisturbed();
    let (model, checkpoint) = (
        bench.path("killed.model"),
        bench.path("killed.model.checkpoint"),
    );
    let mut random = Random::new(SEED);
    let (mut kills, mut resumptions, mut is_last) = (0, 0, false);
    while !is_last {
        // Enough kills: the last run is not killed.
        is_last = kills == KILLS;
        resumptions += usize::from(checkpoint.exists());
        let mut command = bench.fit("killed.model", &LONG);
        if is_last {
            let output = output(&mut command);
            assert!(output.status.success(), "{}", complaint(&output));
        } else {
            let after = (kills % 3 != 0).then_some(checkpoint.as_path());
            kills += usize::from(killed(&mut command, after, &mut random));
        }
        if model.exists() {
            let found = fs::read(&model).expect("there");
            assert!(found == expected, "seed {SEED}, {kills} kills");
            fs::remove_file(&model).expect("there");
        }
    }
    assert!(
        resumptions >= KILLS / 2,
        "{resumptions} of {kills} runs went on"
    );
    let left = fs::read_dir(bench.folder.path()).expect("there");
    let left: Vec<_> = left
        .map(|entry| entry.expect("there").file_name())
        .collect();
    let parts = left
        .iter()
        .filter(|name| name.to_string_lossy().contains("checkpoint"));
    assert_eq!(parts.count(), 0, "{left:?}");
}

/// The command with files limited to `blocks` of 512 bytes: larger writes fail, as on a full disk.
fn with_small_files(blocks: usize, command: &Command) -> Command {
    let mut small = Command::new("sh");
    // Ignored signals stay ignored in children: the write fails instead of the process.
    let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$@\"");
    small
        .args(["-c", &script, "sh"])
        .arg(command.get_program())
        .args(command.get_args());
    small
}

#[test]
fn a_checkpoint_without_room_is_refused_and_the_one_before_stands() {
    let bench = Bench::new();
    let expected = bench.undisturbed();
    let (model, checkpoint) = (
        bench.path("full.model"),
        bench.path("full.model.checkpoint"),
    );
    let fit = bench.fit("full.model", &LONG);
    let mut before = None;
    for round in 0..3 {
        let output = output(&mut with_small_files(2000, &fit));
        let complaint = complaint(&output);
        assert_eq!(output.status.code(), Some(3), "{complaint}");
        assert!(complaint.contains("cannot write checkpoint"), "{complaint}");
        assert!(complaint.contains("File too large"), "{complaint}");
        assert!(!model.exists());
        assert_eq!(fs::read(&checkpoint).ok(), before, "round {round}");
        let mut random = Random::new(SEED + round);
        assert!(killed(
            &mut bench.fit("full.model", &LONG),
            Some(&checkpoint),
            &mut random
        ));
        before = Some(fs::read(&checkpoint).expect("written before the kill"));
    }
    let output = output(&mut bench.fit("full.model", &LONG));
    assert!(output.status.success(), "{}", complaint(&output));
    assert!(fs::read(&model).expect("written") == expected);
}

#[test]
fn a_checkpoint_of_another_training_stops_the_command_and_force_begins_anew() {
    let bench = Bench::new();
    let checkpoint = bench.path("other.model.checkpoint");
    let mut random = Random::new(SEED);
    assert!(killed(
        &mut bench.fit("other.model", &LONG),
        Some(&checkpoint),
        &mut random
    ));
    let left = fs::read(&checkpoint).expect("written before the kill");
    let refused = output(&mut bench.fit("other.model", &["epochs=2"]));
    let said = complaint(&refused);
    assert_eq!(refused.status.code(), Some(3), "{said}");
    assert!(
        said.contains("belongs to another training run, with other settings"),
        "{said}"
    );
    assert_eq!(fs::read(&checkpoint).expect("there"), left);
    let begun = output(bench.fit("other.model", &["epochs=2"]).arg("--force"));
    assert!(begun.status.success(), "{}", complaint(&begun));
    assert!(!checkpoint.exists());
}

#[test]
fn a_training_that_breaks_names_the_step_and_keeps_its_best_epoch() {
    let bench = Bench::new();
    // The rate rises during a third of the steps, so the first epochs are finite.
    let settings = ["epochs=200", "rate=10", "weight_decay=10", "noise=0"];
    let broken = output(&mut bench.fit("broken.model", &settings));
    let said = complaint(&broken);
    assert_eq!(broken.status.code(), Some(3), "{said}");
    assert!(
        said.contains("step ") && said.contains("is not finite"),
        "{said}"
    );
    assert!(said.contains("is saved in"), "{said}");
    assert!(!bench.path("broken.model").exists());
    let again = output(&mut bench.fit("broken.model", &settings));
    assert_eq!(
        complaint(&again),
        said,
        "what was kept breaks at the same step"
    );
}
