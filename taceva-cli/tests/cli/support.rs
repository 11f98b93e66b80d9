//! Test folder with a synthetic recording of a lab, in which the program runs as by a user.

pub(crate) mod emulated;
pub(crate) mod list;
pub(crate) mod snapshot;
pub(crate) mod sweeps;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use taceva_core::{Channel, Channels, Clock, Frame, FrameInfo, PixelFormat, Readings, Sample};
use taceva_dataset::{Dataset, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};
use tempfile::TempDir;

/// Number of samples of the synthetic recording: ten points, six presses each.
pub(crate) const SAMPLES: u32 = 60;

/// A temporary folder to work in.
pub(crate) struct Bench {
    folder: TempDir,
    /// True if runs use a cache.
    has_cache: bool,
}

/// Exit code and output of a run of the program.
pub(crate) struct Ran {
    pub(crate) code: i32,
    pub(crate) out: String,
    pub(crate) err: String,
}

impl Bench {
    pub(crate) fn new() -> Bench {
        Bench {
            folder: tempfile::tempdir().expect("a temporary folder"),
            has_cache: false,
        }
    }

    /// Test folder with a lab's folder, imported as the dataset `data`.
    pub(crate) fn imported() -> Bench {
        let bench = Bench::new();
        bench.lab();
        bench.ok("import lab --map map.toml --out data -q");
        bench
    }

    /// Test folder whose runs use a cache. Without a cache, every run executes all of its stages.
    pub(crate) fn with_cache() -> Bench {
        Bench {
            has_cache: true,
            ..Bench::new()
        }
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, text: &str) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().expect("in a folder")).expect("created");
        fs::write(path, text).expect("written");
    }

    /// Command `taceva WORDS` in the test folder, not yet started.
    pub(crate) fn command(&self, words: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_taceva"));
        command
            .current_dir(self.folder.path())
            .env("XDG_CACHE_HOME", self.path("user-cache"))
            .env("XDG_CONFIG_HOME", self.path("user-config"))
            .env("XDG_DATA_HOME", self.path("user-data"))
            .env("XDG_STATE_HOME", self.path("user-state"))
            .env_remove("TACEVA_PLUGIN_PATH")
            .args(words.split_whitespace());
        if words.starts_with("run") && !self.has_cache {
            command.arg("--no-cache");
        }
        command
    }

    /// Runs `taceva WORDS` in this folder.
    pub(crate) fn run(&self, words: &str) -> Ran {
        let Output {
            status,
            stdout,
            stderr,
        } = self.command(words).output().expect("the program starts");
        let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
        Ran {
            code: status.code().expect("not ended by a signal"),
            out: text(stdout),
            err: text(stderr),
        }
    }

    /// Runs `taceva WORDS` with these lines on its standard input.
    pub(crate) fn answered(&self, words: &str, answers: &str) -> Ran {
        self.write("answers.txt", answers);
        let answers = fs::File::open(self.path("answers.txt")).expect("it was written");
        let output = self
            .command(words)
            .stdin(answers)
            .output()
            .expect("the program starts");
        let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
        Ran {
            code: output.status.code().expect("not ended by a signal"),
            out: text(output.stdout),
            err: text(output.stderr),
        }
    }

    /// Runs `taceva WORDS`, and expects success.
    pub(crate) fn ok(&self, words: &str) -> String {
        let ran = self.run(words);
        assert_eq!(ran.code, 0, "taceva {words}\n{}{}", ran.out, ran.err);
        ran.out
    }

    /// Runs `taceva WORDS` with JSON output, and expects success.
    pub(crate) fn json(&self, words: &str) -> serde_json::Value {
        serde_json::from_str(&self.ok(&format!("{words} --format json -q"))).expect("JSON")
    }

    /// Runs `taceva WORDS -q`; expects the exit code `code`, `message` on standard error, and nothing on standard output.
    pub(crate) fn refused(&self, words: &str, code: i32, message: &str) {
        let ran = self.run(&format!("{words} -q"));
        assert_eq!(ran.code, code, "taceva {words}\n{}{}", ran.out, ran.err);
        assert!(
            ran.err.contains(message),
            "expected `{message}` in: {}",
            ran.err
        );
        assert_eq!(ran.out, "", "taceva {words}");
    }

    /// Runs the command that `text` states after `allow it: `, in a shell, as if pasted by a user.
    pub(crate) fn paste(&self, text: &str) -> Ran {
        let (_, line) = text.rsplit_once("allow it: ").expect(text);
        self.shell(line.lines().next().expect("a line").trim())
    }

    /// Runs a command line in a shell in this folder.
    pub(crate) fn shell(&self, line: &str) -> Ran {
        let program = Path::new(env!("CARGO_BIN_EXE_taceva"));
        let mut path = program.parent().expect("a folder").as_os_str().to_owned();
        path.push(":");
        path.push(std::env::var_os("PATH").unwrap_or_default());
        // With the folders of this bench, which `command` sets.
        let ours = self.command("");
        let variables = ours
            .get_envs()
            .filter_map(|(key, value)| Some((key, value?)));
        let mut shell = Command::new("sh");
        shell.args(["-c", line]).envs(variables).env("PATH", path);
        shell.current_dir(self.folder.path());
        let output = shell.output().expect("a shell");
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
        Ran {
            code: output.status.code().expect("it ended"),
            out: text(output.stdout),
            err: text(output.stderr),
        }
    }

    /// Creates a plugin called `name` with one `kind`, and builds it.
    pub(crate) fn make_plugin(&self, kind: &str, name: &str) {
        self.ok(&format!("plugin new {kind} {name}"));
        self.build_plugin(name);
    }

    /// Builds the plugin in `examples/plugins/NAME` as its README says.
    pub(crate) fn make_example(&self, kind: &str, name: &str) {
        self.ok(&format!("plugin new {kind} {name}"));
        let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/plugins");
        for file in ["plugin.toml", "src/lib.rs", &format!("src/{kind}.rs")] {
            let to = self.path(name).join(file);
            fs::copy(examples.join(name).join(file), to).expect(file);
        }
        self.build_plugin(name);
    }

    /// Builds the plugin in the folder `name`, without a network.
    pub(crate) fn build_plugin(&self, name: &str) {
        let built = Command::new(env!("CARGO"))
            .args(["build", "--release", "--offline", "--quiet"])
            .current_dir(self.path(name))
            .env("CARGO_HOME", self.path("cargo"))
            .env_remove("CARGO_TARGET_DIR")
            .env_remove("RUSTFLAGS")
            .output()
            .expect("cargo runs, it runs this test");
        let said = String::from_utf8_lossy(&built.stderr);
        assert!(built.status.success(), "{said}");
    }

    /// Records a dataset at `name` without a sample.
    pub(crate) fn record_nothing(&self, name: &str) {
        let recorder = Recorder::create(&self.path(name), &spec()).expect("a new recording");
        recorder.close().expect("closed");
    }

    /// Records a dataset at `name`, with pictures of `side` × `side` pixels.
    pub(crate) fn record(&self, name: &str, side: u32) -> PathBuf {
        self.record_with_noise(name, side, 0)
    }

    /// Records a dataset like [`record`](Bench::record), with its own noise. Recordings of different `noise` below 7 share no frame.
    pub(crate) fn record_with_noise(&self, name: &str, side: u32, noise: u32) -> PathBuf {
        self.record_as(name, side, noise, &spec())
    }

    /// Records a dataset like [`record`](Bench::record), whose operator is `operator`.
    pub(crate) fn record_by(&self, name: &str, side: u32, operator: &str) -> PathBuf {
        let mut spec = spec();
        let setting = ("operator".to_owned(), operator.to_owned());
        spec.facts.settings.extend([setting]);
        self.record_as(name, side, 0, &spec)
    }

    fn record_as(&self, name: &str, side: u32, noise: u32, spec: &RecordingSpec) -> PathBuf {
        let path = self.path(name);
        let mut recorder = Recorder::create(&path, spec).expect("a new recording");
        for number in 0..SAMPLES {
            let (place, force) = label(number);
            recorder
                .append(
                    &Sample::new(format!("{name}-{number:02}"))
                        .with_point_id(format!("p{}", number / 6))
                        .with_frame(draw((number, noise), side))
                        .with_truth(Readings::from_values([place, force])),
                )
                .expect("recorded");
        }
        recorder.close().expect("closed");
        path
    }

    /// Records a dataset of depths at `name`, each from a fitted surface whose zero has the standard uncertainty `zero_u_mm`.
    pub(crate) fn record_depths(&self, name: &str, zero_u_mm: f64) {
        let channels = Channels::new([Channel::PZ]).expect("one");
        let spec = RecordingSpec::new(spec().facts, channels);
        let mut recorder = Recorder::create(&self.path(name), &spec).expect("a new recording");
        for number in 0..SAMPLES {
            let (_, depth) = label(number);
            let sample = Sample::new(format!("{name}-{number:02}"))
                .with_point_id(format!("p{}", number / 6))
                .with_frame(draw((number, 0), 32))
                .with_truth(Readings::from_values([depth]))
                .with_zero_u_mm(Some(zero_u_mm));
            recorder.append(&sample).expect("recorded");
        }
        recorder.close().expect("closed");
    }

    /// Writes a lab's folder `lab` with `labels.csv`, `pictures/` and `map.toml`.
    pub(crate) fn lab(&self) {
        let recording = self.record("drawn", 32);
        let dataset = Dataset::open(&recording).expect("a dataset");
        fs::create_dir_all(self.path("lab/pictures")).expect("created");
        let mut labels = String::from("file,place_mm,force_N,point,sample\n");
        for (number, row) in (0..SAMPLES).zip(dataset.all_rows()) {
            let file = format!("pictures/{number:02}.png");
            let frame = dataset.frame(row).expect("read").expect("there");
            let FrameInfo { width, height, .. } = frame.info();
            let gray = image::ExtendedColorType::L8;
            let path = self.path("lab").join(&file);
            image::save_buffer(path, frame.bytes(), width, height, gray).expect("written");
            let (place, force) = label(number);
            labels.push_str(&format!(
                "{file},{place:?},{force:?},p{},s{number:02}\n",
                number / 6
            ));
        }
        fs::write(self.path("lab/labels.csv"), labels).expect("written");
        fs::write(self.path("map.toml"), MAP).expect("written");
    }
}

/// Facts and channels of a synthetic recording.
fn spec() -> RecordingSpec {
    let sensor = SensorFacts::new("drawn")
        .with_serial("1")
        .with_gel("1")
        .with_opaque(true);
    let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, sensor);
    RecordingSpec::new(
        facts,
        Channels::new([Channel::PX, Channel::FZ]).expect("two channels"),
    )
}

pub(crate) const MAP: &str = r#"map_version = 2
table = "labels.csv"

[frame]
column = "file"
channel_order = "gray"
reference = "unknown"

[columns]
Px = { from = "place_mm", unit = "mm" }
Fz = { from = "force_N", unit = "N" }

[ids]
sample = "sample"
point_id = "point"

[time]
clock = "unknown"

[sensor]
model = "drawn"
serial = "unknown"
gel = "unknown"
opaque = true
"#;

/// Labels of sample `number`: position of the drawn blob, mm, and its brightness, which stands for a force, N.
fn label(number: u32) -> (f64, f64) {
    let mixed = f64::from(number * 37 % SAMPLES) / f64::from(SAMPLES);
    (8.0 * (mixed - 0.5), 0.2 + f64::from(number % 6) * 0.3)
}

/// Picture of sample `number`: a blob at its labelled position, as bright as the labelled force.
fn draw((number, noise): (u32, u32), side: u32) -> Frame {
    let (place, force) = label(number);
    let middle = f64::from(side) / 2.0 + place * f64::from(side) / 12.0;
    let mut bytes = Vec::new();
    for y in 0..side {
        for x in 0..side {
            let (from_x, from_y) = (f64::from(x) - middle, f64::from(y) - f64::from(side) / 2.0);
            let light = 20.0
                + 110.0 * force * (-(from_x * from_x + from_y * from_y) / f64::from(side)).exp();
            let noise = f64::from((x * 7919 + y * 104_729 + number * 1_299_709 + noise) % 7);
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "clamped to a byte"
            )]
            bytes.push((light + noise).clamp(0.0, 255.0) as u8);
        }
    }
    Frame::new(
        FrameInfo {
            width: side,
            height: side,
            format: PixelFormat::Gray8,
        },
        bytes,
    )
    .expect("whole")
}

/// Names in the folder other than `known`, such as those of partial files.
pub(crate) fn leftovers(folder: &Path, known: &[&str]) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let names = entries.map(|entry| {
        entry
            .expect("readable")
            .file_name()
            .into_string()
            .expect("UTF-8")
    });
    names
        .filter(|name| !known.contains(&name.as_str()))
        .collect()
}

/// The header of a dataset changed to the format `version`, with its old seal.
pub(crate) fn of_format(header: &str, version: &str) -> String {
    let line = header.lines().find(|line| line.starts_with("format = "));
    let line = line.expect("a header states its format");
    header.replacen(line, &format!("format = \"{version}\""), 1)
}
