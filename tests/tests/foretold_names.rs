//! Tests of links at every predictable file name of a command. The files to which the links lead must keep their content.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use taceva_needs::{Need, skip};
use taceva_tests::{Form, Lab, scratch, taceva};

/// System calls that create a name.
const MAKING: &str =
    "trace=open,openat,creat,mkdir,mkdirat,rename,renameat,renameat2,link,linkat,symlink,symlinkat";

/// Number of links at names that an earlier run created, for a command whose names are not predictable.
const SOME: usize = 8;
/// Maximum number of names of one command at which links are tried.
const MOST: usize = 24;

/// Commands, each in a folder `work` in which only they create names. Inputs are in `given` beside it.
const COMMANDS: [(&str, &str); 31] = [
    (
        "import",
        "import ../given/lab --map ../given/map.toml --out set",
    ),
    (
        "import of an archive",
        "import ../given/lab.tar --map ../given/map.toml --out set",
    ),
    (
        "import over a dataset",
        "import ../given/lab --map ../given/map.toml --out data --force",
    ),
    (
        "extend",
        "import ../given/other --map ../given/map.toml --extend data",
    ),
    ("export", "export data --out exported --format csv"),
    (
        "export to HDF5",
        "export data --out exported.h5 --format hdf5",
    ),
    ("draft", "import ../given/lab.tar --draft --out draft.toml"),
    ("init", "init recording ../given/lab --yes --out map.toml"),
    ("check", "check data --format json --out findings.json"),
    ("fit", "fit data --model ridge --out model"),
    (
        "evaluate",
        "evaluate data --model ridge --format json --out scores.json",
    ),
    (
        "evaluate with every output",
        "evaluate data --model ridge --no-cache --state-out scores.state --samples-out samples.csv --html page.html --figures figures",
    ),
    (
        "predict",
        "predict data --with ../given/model --out predictions.csv --truth-out truth.csv",
    ),
    (
        "score",
        "score --truth ../given/truth.csv --pred ../given/predicted.csv --format json --out scores.json",
    ),
    (
        "merge",
        "merge ../given/ridge.state --state-out both.state --format csv --out scores.csv",
    ),
    (
        "bundle",
        "bundle ../given/ridge.json --state ../given/ridge.state --draft --date 2026-11-28 --out b.tar.gz",
    ),
    ("report", "report ../given/ridge.json --out print"),
    (
        "compare",
        "compare ../given/ridge.json ../given/baseline.json --format csv --out compared.csv",
    ),
    (
        "limits",
        "accept --template ../given/ridge.json --out limits.toml",
    ),
    (
        "accept",
        "accept ../given/ridge.json --limits ../given/limits.toml --html sheet.html --format csv --out accepted.csv",
    ),
    (
        "gauge",
        "gauge ../given/study.csv --part part --by unit --trial trial --channels Fz --format json --out gauge.json",
    ),
    (
        "curve",
        "curve ../given/study.csv --x trial --y Fz --format csv --out curve.csv",
    ),
    (
        "budget",
        "budget ../given/budget.toml --mc 0 --format csv --out budget.csv --html budget.html",
    ),
    (
        "bundle",
        "bundle ../given/ridge.json --state ../given/ridge.state --draft --out bundle",
    ),
    (
        "packed bundle",
        "bundle ../given/ridge.json --state ../given/ridge.state --draft --out bundle.tar.gz",
    ),
    ("catalogue site", "catalogue site --out pages"),
    (
        "capture",
        "capture presses --sensor sim/gelsight:seed=3 --frames 3",
    ),
    ("run", "run ../given/scene.toml --out run --no-cache"),
    ("plugin new", "plugin new estimator mine --language python"),
    ("plugin headers", "plugin headers --out include"),
    ("manual pages", "man --out pages"),
];

struct Bench {
    folder: tempfile::TempDir,
}

impl Bench {
    fn new() -> Bench {
        let bench = Bench { folder: scratch() };
        let given = bench.path("given");
        std::fs::create_dir(&given).expect("room");
        for (name, first) in [("lab", 0), ("other", 500)] {
            let lab = Lab::drawn_from(Form::Png, first, 12);
            copied(lab.path(), &given.join(name));
            std::fs::copy(lab.map(), given.join("map.toml")).expect("copied");
        }
        let file = std::fs::File::create(given.join("lab.tar")).expect("room");
        let mut tar = tar::Builder::new(file);
        tar.append_dir_all("lab", given.join("lab"))
            .expect("packed");
        tar.finish().expect("written");
        bench.anew();
        bench.ok("import ../given/lab --map ../given/map.toml --out ../given/data");
        bench.ok("fit ../given/data --model ridge --out ../given/model");
        for model in ["ridge", "baseline"] {
            bench.ok(&format!(
                "evaluate ../given/data --model {model} --format json --out ../given/{model}.json --state-out ../given/{model}.state"
            ));
        }
        bench.ok("predict ../given/data --with ../given/model --out ../given/predicted.csv --truth-out ../given/truth.csv");
        for (name, text) in [
            ("which.toml", SWEEP),
            ("scene.toml", SCENE),
            ("limits.toml", LIMITS),
            ("study.csv", STUDY),
            ("budget.toml", BUDGET),
        ] {
            std::fs::write(given.join(name), text).expect("room");
        }
        bench
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Restores the folder `work` before each command.
    fn anew(&self) {
        let work = self.path("work");
        if work.exists() {
            std::fs::remove_dir_all(&work).expect("removed");
        }
        for name in ["work", "work/tmp"] {
            std::fs::create_dir(self.path(name)).expect("room");
        }
        let data = self.path("given/data");
        if data.exists() {
            copied(&data, &work.join("data"));
            let sweep = self.path("given/which.toml");
            if sweep.exists() {
                std::fs::copy(sweep, work.join("which.toml")).expect("copied");
            }
        }
    }

    fn settings(&self, command: &mut Command) {
        let work = self.path("work");
        command
            .current_dir(&work)
            .env("HOME", &work)
            .env("TMPDIR", work.join("tmp"))
            .env("XDG_CACHE_HOME", work.join("cache"))
            .env("XDG_DATA_HOME", work.join("share"))
            .env("XDG_CONFIG_HOME", work.join("config"))
            .env_remove("TACEVA_PLUGIN_PATH")
            .stdin(Stdio::null());
    }

    fn run(&self, words: &str) -> Output {
        let mut command = Command::new(taceva());
        command.args(words.split_whitespace()).arg("-q");
        self.settings(&mut command);
        command.output().expect("built")
    }

    fn ok(&self, words: &str) {
        let output = self.run(words);
        let complaint = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{words}: {complaint}");
    }

    /// Names below `work` that the command creates, or the reason why they cannot be traced.
    fn made(&self, words: &str) -> Result<BTreeSet<PathBuf>, String> {
        self.anew();
        let log = self.path("trace");
        let mut command = Command::new("strace");
        command.args([
            "-f",
            "-qq",
            "-s",
            "4096",
            "-e",
            "signal=none",
            "-e",
            MAKING,
            "-o",
        ]);
        command.arg(&log).arg(taceva());
        command.args(words.split_whitespace()).arg("-q");
        self.settings(&mut command);
        let output = command.output().map_err(|error| error.to_string())?;
        let complaint = String::from_utf8_lossy(&output.stderr);
        if complaint.starts_with("strace:") {
            return Err(complaint.into_owned());
        }
        // 1: done, but a limit is not met.
        let is_done = matches!(output.status.code(), Some(0 | 1));
        assert!(is_done, "{words}: {complaint}");
        let work = self.path("work");
        let log = std::fs::read_to_string(log).expect("a trace");
        let names = log.lines().filter_map(name_made);
        Ok(names
            .map(|name| work.join(name))
            .filter(|path| path.starts_with(&work))
            .collect())
    }
}

const SWEEP: &str =
    "sweep_version = 1\ndatasets = [\"data\"]\nmodels = [\"ridge\"]\nmetrics = [\"accuracy\"]\n";

/// Table of a measurement study: two parts, each measured twice by two units.
const STUDY: &str = "part,unit,trial,Fz\na,1,1,0.1\na,1,2,0.11\na,2,1,0.13\na,2,2,0.12\nb,1,1,0.5\nb,1,2,0.52\nb,2,1,0.53\nb,2,2,0.55\n";

const BUDGET: &str = "budget_version = 1\nmeasurand = \"Fz\"\nat = [\"1 N\"]\n[[source]]\nname = \"lamp\"\nu = \"10 mN\"\n";

const LIMITS: &str = "[[limit]]\nmetric = \"mae\"\nchannel = \"Fz\"\nunit = \"N\"\nmost = 1000\n";

/// Scene of a few presses of the simulated bench.
const SCENE: &str = r#"scene_version = 1
name = "study"
seed = 7
metrics = { want = ["mae"] }
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
model = { name = "ridge", set = { size = "8x8" } }
sensor = { driver = "sim/vitactip:reduction=16" }
protocol = { calibration = { points = 4, indentations = 2 } }
"#;

/// Name that a line of a trace creates.
fn name_made(line: &str) -> Option<String> {
    let (call, result) = line.rsplit_once(" = ")?;
    if result.starts_with('-') {
        return None;
    }
    let is_open = call.contains(" open") || call.contains(" creat(");
    if is_open && !call.contains("O_CREAT") && !call.contains(" creat(") {
        return None;
    }
    let quoted: Vec<&str> = call.split('"').skip(1).step_by(2).collect();
    quoted.last().map(|name| (*name).to_owned())
}

/// Copies a folder and its content.
fn copied(from: &Path, to: &Path) {
    std::fs::create_dir(to).expect("room");
    for entry in from.read_dir().expect("there").flatten() {
        let target = to.join(entry.file_name());
        match entry.path().is_dir() {
            true => copied(&entry.path(), &target),
            false => drop(std::fs::copy(entry.path(), target).expect("copied")),
        }
    }
}

/// Creates a folder that belongs to another program: it looks like a dataset but contains further files.
fn theirs(folder: &Path) {
    if folder.exists() {
        std::fs::remove_dir_all(folder).expect("removed");
    }
    std::fs::create_dir(folder).expect("room");
    for name in ["dataset.toml", "thesis.tex", ".taceva-temporary"] {
        std::fs::write(folder.join(name), "theirs").expect("room");
    }
}

fn content(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut content: Vec<_> = folder
        .read_dir()
        .expect("there")
        .flatten()
        .map(|entry| {
            let bytes = std::fs::read(entry.path()).unwrap_or_default();
            (entry.file_name().to_string_lossy().into_owned(), bytes)
        })
        .collect();
    content.sort();
    content
}

/// True if a user may place a link at `path` to store files elsewhere: new files are then written there, and existing ones stay.
fn is_kept_elsewhere(path: &Path, work: &Path) -> bool {
    ["cache", "share", "which.sweep", "figures", "print", "pages"]
        .iter()
        .any(|name| path.starts_with(work.join(name)))
}

#[cfg(unix)]
#[test]
#[expect(clippy::print_stderr, reason = "the counts are the result")]
fn what_links_at_foretold_names_lead_to_keeps_its_bytes() {
    let bench = Bench::new();
    let mut commands: Vec<(&str, String)> = COMMANDS
        .iter()
        .map(|(name, words)| (*name, (*words).to_owned()))
        .collect();
    commands.push(("sweep", "sweep which.toml".to_owned()));
    #[cfg(target_os = "linux")]
    {
        crate::kill_commands::packed_plugin(&bench.path("given"));
        commands.push((
            "plugin install",
            "plugin install ../given/sim.tar".to_owned(),
        ));
    }
    for (name, words) in commands {
        let (first, second) = match (bench.made(&words), bench.made(&words)) {
            (Ok(first), Ok(second)) => (first, second),
            (Err(why), _) | (_, Err(why)) => return skip(Need::Strace, why),
        };
        let foretold: Vec<&PathBuf> = first.intersection(&second).collect();
        bench.anew();
        let is_free = |path: &&PathBuf| std::fs::symlink_metadata(path).is_err();
        let mut linked: Vec<&PathBuf> = foretold.iter().copied().filter(is_free).collect();
        if linked.is_empty() {
            // No new name is predictable: put links at some names of the first run.
            linked = first.iter().filter(is_free).take(SOME).collect();
        }
        let work = bench.path("work");
        let elsewhere = bench.path("theirs");
        let mut tried = 0;
        for path in linked.iter().take(MOST) {
            for leads_to in [elsewhere.clone(), elsewhere.join("thesis.tex")] {
                bench.anew();
                theirs(&elsewhere);
                let before = content(&elsewhere);
                // Nobody can put a link into a folder that the command itself creates.
                let parent = path.parent().expect("below a folder");
                std::fs::create_dir_all(parent).expect("room");
                if std::fs::symlink_metadata(path).is_ok() {
                    continue;
                }
                std::os::unix::fs::symlink(&leads_to, path).expect("linked");
                let output = bench.run(&words);
                tried += 1;
                let mut after = content(&elsewhere);
                if is_kept_elsewhere(path, &work) {
                    after.retain(|(name, _)| before.iter().any(|(old, _)| old == name));
                }
                assert_eq!(
                    before,
                    after,
                    "{name}: {} led to {}: {}",
                    path.display(),
                    leads_to.display(),
                    String::from_utf8_lossy(&output.stderr)
                );
            }
        }
        eprintln!(
            "{name}: {} names made, {} of them foretold, {tried} links, 0 bytes changed",
            first.len(),
            foretold.len()
        );
        assert!(tried > 0, "{name}: no link was tried");
    }
}
