//! Commands killed at random moments: the repeated command succeeds, and no temporary file remains beside its result. `TACEVA_KILLS=50
//! cargo test --workspace --test tests kill_commands:: -- --nocapture` sets the number of kills per command.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use taceva_tests::{Form, Lab, Random, library, root, scratch, taceva};

const SEED: u64 = 20_261_128;
/// Default number of kills per command.
const KILLS: usize = 4;

/// A command in its own folder, with settings, caches and temporary files below it.
fn command(folder: &Path, words: &str) -> Command {
    let mut command = Command::new(taceva());
    command
        .current_dir(folder)
        .env("HOME", folder)
        .env("TMPDIR", folder.join("tmp"))
        .env("XDG_CACHE_HOME", folder.join("cache"))
        .env("XDG_DATA_HOME", folder.join("share"))
        .env("XDG_CONFIG_HOME", folder.join("config"))
        .env_remove("TACEVA_PLUGIN_PATH")
        .args(words.split_whitespace())
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    command
}

/// Files that remain only after an interruption: staged names, temporary files and claims.
fn leftovers(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in folder.read_dir().into_iter().flatten().flatten() {
        let (path, name) = (entry.path(), entry.file_name());
        let is_hidden = name.to_string_lossy().starts_with('.');
        let is_within = ["tmp", "claims", "partial"]
            .iter()
            .any(|place| folder.ends_with(place));
        if is_hidden || is_within {
            found.push(path);
        } else if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            found.extend(leftovers(&path));
        }
    }
    found
}

/// Kills the command at random moments. `anew` restores the folder before each kill.
#[expect(clippy::print_stderr, reason = "the counts are the result")]
fn kill_often(name: &str, folder: &Path, words: &str, anew: impl Fn()) {
    std::fs::create_dir_all(folder.join("tmp")).expect("room");
    let wanted = std::env::var("TACEVA_KILLS").ok();
    let kills = wanted.and_then(|text| text.parse().ok()).unwrap_or(KILLS);
    let finish = |context: &str| {
        let output = command(folder, words)
            .stderr(Stdio::piped())
            .output()
            .expect("built");
        let complaint = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{context}: {complaint}");
        assert_eq!(leftovers(folder), Vec::<PathBuf>::new(), "{context}");
    };
    // The program may be built first, which takes longer than the command.
    taceva();
    // The shortest of three runs: a busy machine makes one of them slow, and kills would come after the end.
    let runs = [(); 3].map(|()| {
        anew();
        let begun = Instant::now();
        finish(name);
        begun.elapsed()
    });
    let whole = runs.into_iter().min().expect("three runs");
    let mut random = Random::new(SEED);
    let (mut amid, mut with_leftovers) = (0, 0);
    for number in 0..kills {
        anew();
        let mut child = command(folder, words).spawn().expect("built");
        // One random moment in each of `kills` equal parts.
        let part = whole / u32::try_from(kills).expect("few");
        let micros = usize::try_from(part.as_micros()).expect("short");
        let within = Duration::from_micros(random.below(micros + 1) as u64);
        std::thread::sleep(part * u32::try_from(number).expect("few") + within);
        amid += usize::from(child.try_wait().expect("a child").is_none());
        // The command may have ended by itself.
        let _ = child.kill();
        child.wait().expect("a child");
        with_leftovers += usize::from(!leftovers(folder).is_empty());
        finish(&format!("seed {SEED}, {name}, kill {number}"));
    }
    eprintln!(
        "{name}: {kills} of {kills} succeeded after a kill; {amid} were killed amid, {with_leftovers} of them left something"
    );
    assert!(amid >= kills / 2, "the moments were chosen badly");
}

/// Creates a tar archive of a laboratory's folder, with the map beside it.
fn archive(folder: &Path) {
    let lab = Lab::drawn(Form::Png, 200);
    let file = std::fs::File::create(folder.join("lab.tar")).expect("room");
    let mut tar = tar::Builder::new(file);
    tar.append_dir_all("lab", lab.path()).expect("packed");
    tar.finish().expect("written");
    std::fs::copy(lab.map(), folder.join("map.toml")).expect("copied");
}

/// Removes the files that commands of `folder` created.
fn without(folder: &Path, names: &[&str]) {
    for name in names {
        let path = folder.join(name);
        match path.is_dir() {
            true => std::fs::remove_dir_all(&path).expect("removed"),
            // The file may not exist yet.
            false => drop(std::fs::remove_file(&path)),
        }
    }
}

#[test]
fn a_killed_import_of_an_archive_is_followed_by_one_that_succeeds() {
    let folder = scratch();
    let folder = folder.path();
    archive(folder);
    let words = "import lab.tar --map map.toml --out set -q";
    // Every second kill begins with an existing dataset, which is replaced.
    let count = std::cell::Cell::new(0);
    kill_often(
        "import of an archive",
        folder,
        &format!("{words} --force"),
        || {
            count.set(count.get() + 1);
            if count.get() % 2 == 0 {
                without(folder, &["set"]);
            }
        },
    );
}

#[test]
fn a_killed_draft_of_an_archive_is_followed_by_one_that_succeeds() {
    let folder = scratch();
    let folder = folder.path();
    archive(folder);
    // A draft from before the kill is replaced.
    let words = "import lab.tar --draft --out draft.toml --force -q";
    kill_often("draft", folder, words, || without(folder, &["draft.toml"]));
}

#[cfg(target_os = "linux")]
#[test]
fn a_killed_installation_of_a_plugin_is_followed_by_one_that_succeeds() {
    let folder = scratch();
    let folder = folder.path();
    packed_plugin(folder);
    kill_often(
        "plugin install",
        folder,
        "plugin install sim.tar --force",
        || {},
    );
}

#[test]
fn a_killed_sweep_is_followed_by_one_that_succeeds_and_leaves_no_claim() {
    let folder = scratch();
    let folder = folder.path();
    let lab = Lab::drawn(Form::Png, 40);
    let import = format!(
        "import {} --map {} --out data",
        lab.path().display(),
        lab.map().display()
    );
    assert!(command(folder, &import).status().expect("built").success());
    std::fs::write(folder.join("which.toml"), SWEEP).expect("room");
    kill_often("sweep", folder, "sweep which.toml -q", || {
        without(folder, &["which.sweep", "cache"]);
    });
}

const SWEEP: &str = "sweep_version = 1\ndatasets = [\"data\"]\nmodels = [\"ridge\", \"baseline\", \"knn\"]\nseeds = [1, 2]\nmetrics = [\"accuracy\"]\n";

/// Packs the simulated bench as a plugin into `sim.tar` of `folder`.
#[cfg(target_os = "linux")]
pub(crate) fn packed_plugin(folder: &Path) {
    let plugin = folder.join("plugin");
    std::fs::create_dir(&plugin).expect("room");
    let built = library("taceva-sim-plugin");
    let name = built.file_name().expect("a file");
    std::fs::copy(&built, plugin.join(name)).expect("room for a library");
    let manifest = root().join("plugins/sim-plugin/plugin.toml");
    std::fs::copy(manifest, plugin.join("plugin.toml")).expect("room for a manifest");
    let packed = command(folder, "plugin pack plugin --out sim.tar").status();
    assert!(packed.expect("built").success());
}
