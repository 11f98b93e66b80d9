//! Sweeps on a real Slurm: two virtual nodes on loopback, begun and ended by `tests/slurm`.

mod support;

use std::fs;
use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use support::Bench;
use support::sweeps::{self, SWEEP, bytes, tables};
use taceva_needs::{Need, skip};

/// What the cluster is asked for.
const SLURM: &str = r#"[slurm]
partition = "main"
time = "00:10:00"
memory = "200M"
tasks_a_job = 3
setup = ["export SET_UP=yes"]
"#;
/// A loaded machine is waited for.
const PATIENCE: Duration = Duration::from_secs(240);

/// One cluster at a time: ports that were found free are free until the daemons have them.
static ALONE: Mutex<()> = Mutex::new(());

/// A Slurm of two nodes, ended when it is dropped.
struct Cluster {
    folder: tempfile::TempDir,
    _alone: MutexGuard<'static, ()>,
}

impl Cluster {
    /// Begins one, if this machine may.
    fn start() -> Option<Cluster> {
        let is_there = |program: &str| {
            let found = Command::new("sh")
                .args(["-c", &format!("command -v {program}")])
                .output();
            found.is_ok_and(|output| output.status.success())
        };
        for program in ["slurmctld", "slurmd", "munged", "sbatch"] {
            if !is_there(program) {
                skip(Need::Slurm, format!("there is no {program}"));
                return None;
            }
        }
        if !nix_root() {
            skip(Need::Slurm, "only root starts munged and slurmd");
            return None;
        }
        let cluster = Cluster {
            folder: tempfile::tempdir().expect("a folder"),
            _alone: ALONE.lock().unwrap_or_else(PoisonError::into_inner),
        };
        let output = cluster.script("up.sh", &[&free_ports().to_string()]);
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        Some(cluster)
    }

    fn script(&self, name: &str, words: &[&str]) -> Output {
        let scripts = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/slurm");
        // Daemons keep what they inherit, so nothing waits for a pipe of theirs.
        let said = self.folder.path().join(format!("{name}.txt"));
        let file = fs::File::create(&said).expect("made");
        let status = Command::new("bash")
            .arg(scripts.join(name))
            .arg(self.folder.path())
            .args(words)
            .env("MAX_ARRAY_SIZE", "11")
            .env("SLURMD_TIMEOUT", "10")
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(file)
            .status()
            .expect("bash");
        Output {
            status,
            stdout: Vec::new(),
            stderr: fs::read(said).expect("written"),
        }
    }

    fn configuration(&self) -> PathBuf {
        self.folder.path().join("slurm.conf")
    }

    /// Runs `taceva WORDS` as on a login node.
    fn run(&self, bench: &Bench, words: &str) -> (i32, String) {
        let mut command = bench.command(words);
        let output = command
            .env("SLURM_CONF", self.configuration())
            .output()
            .expect("it starts");
        let text = [output.stdout, output.stderr]
            .map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
        (output.status.code().unwrap_or(-1), text.concat())
    }

    fn ok(&self, bench: &Bench, words: &str) -> String {
        let (code, said) = self.run(bench, words);
        assert_eq!(code, 0, "taceva {words}: {said}");
        said
    }

    /// Waits until no job of the sweep is left.
    fn wait(&self, bench: &Bench) {
        let began = Instant::now();
        loop {
            // A controller that was just started may not answer yet.
            let (code, status) = self.run(bench, "sweep status which.toml");
            if code == 0 && status.contains("none are left") {
                return;
            }
            self.release(&status);
            assert!(began.elapsed() < PATIENCE, "{status}\n{}", self.logs(bench));
            std::thread::sleep(Duration::from_millis(300));
        }
    }

    /// Requeued jobs are held for two minutes, which no test waits for.
    fn release(&self, status: &str) {
        for line in status.lines().filter(|line| line.contains("(BeginTime)")) {
            let id = line.split_whitespace().nth(1).expect("a number");
            self.scontrol(&["update", &format!("JobId={id}"), "StartTime=now"]);
        }
    }

    fn scontrol(&self, words: &[&str]) {
        let output = Command::new("scontrol")
            .args(words)
            .env("SLURM_CONF", self.configuration())
            .output();
        drop(output.expect("scontrol"));
    }

    fn logs(&self, bench: &Bench) -> String {
        let folder = bench.path("which.sweep/slurm/logs");
        let entries = fs::read_dir(folder).into_iter().flatten().flatten();
        entries
            .map(|entry| fs::read_to_string(entry.path()).unwrap_or_default())
            .collect()
    }

    fn pid(&self, name: &str) -> String {
        let text = fs::read_to_string(self.folder.path().join(name)).expect("a daemon's number");
        text.trim().to_owned()
    }
}

/// Ends what runs on a node as a cut of its power would: first the processes that would report the end of a job, then the jobs.
fn cut_power(cluster: &Cluster, node: &str) {
    let daemon = cluster.pid(&format!("slurmd-{node}.pid"));
    let ours = [
        format!("SLURM_CONF={}", cluster.configuration().display()),
        format!("SLURMD_NODENAME={node}"),
    ];
    let mut jobs = Vec::new();
    let mut reporters = vec![daemon];
    for entry in fs::read_dir("/proc").expect("processes").flatten() {
        let folder = entry.path();
        let Ok(environment) = fs::read(folder.join("environ")) else {
            continue;
        };
        let of = |wanted: &String| {
            environment
                .split(|byte| *byte == 0)
                .any(|word| word == wanted.as_bytes())
        };
        if !ours.iter().all(of) {
            continue;
        }
        jobs.push(entry.file_name().to_string_lossy().into_owned());
        let stat = fs::read_to_string(folder.join("stat")).unwrap_or_default();
        let parent = stat
            .rsplit_once(')')
            .and_then(|(_, rest)| rest.split_whitespace().nth(1).map(str::to_owned));
        let is_reporter = |pid: &String| {
            fs::read_to_string(format!("/proc/{pid}/comm"))
                .is_ok_and(|name| name.starts_with("slurmstepd"))
        };
        reporters.extend(parent.filter(is_reporter));
    }
    for pid in reporters.iter().chain(&jobs) {
        drop(
            Command::new("kill")
                .args(["-9", pid])
                .stderr(Stdio::null())
                .status(),
        );
    }
}

impl Drop for Cluster {
    fn drop(&mut self) {
        self.script("down.sh", &[]);
    }
}

fn nix_root() -> bool {
    let output = Command::new("id").arg("-u").output();
    output.is_ok_and(|output| output.stdout.trim_ascii() == b"0")
}

/// The first of three ports that are free now.
fn free_ports() -> u16 {
    for port in (20_000..60_000).step_by(37) {
        let held = [port, port + 1, port + 2].map(|port| TcpListener::bind(("127.0.0.1", port)));
        if held.iter().all(Result::is_ok) {
            return port;
        }
    }
    panic!("no three ports are free");
}

fn week() -> Bench {
    sweeps::week(SLURM)
}

#[test]
fn two_nodes_one_of_them_killed_and_a_controller_that_is_started_anew_give_the_same_bytes_as_here()
{
    let Some(cluster) = Cluster::start() else {
        return;
    };
    let bench = week();
    bench.ok("sweep which.toml -q --out here");
    let reference = bytes(&bench, "here");

    // Two nodes. 48 tasks in jobs of three are 16 jobs, more than the ten that an array of this site may have.
    let said = cluster.ok(&bench, "sweep which.toml --on slurm");
    assert!(said.contains("submitted 48 tasks in 16 jobs"), "{said}");
    let script =
        fs::read_to_string(bench.path("which.sweep/slurm/tasks-2.sh")).expect("a second array");
    for line in [
        "--array=0-5\n",
        "--partition=main\n",
        "--time=00:10:00\n",
        "--mem=200M\n",
        "export SET_UP=yes\n",
    ] {
        assert!(script.contains(line), "{line}: {script}");
    }
    cluster.wait(&bench);
    assert_eq!(
        bytes(&bench, "which.sweep"),
        reference,
        "{}",
        cluster.logs(&bench)
    );
    let times = fs::read_to_string(bench.path("which.sweep/times.csv")).expect("times");
    assert!(
        times.contains(",one,") && times.contains(",two,"),
        "both nodes took part: {times}"
    );
    let again = cluster.ok(&bench, "sweep which.toml --on slurm");
    assert!(again.contains("48 scored, 0 failed"), "{again}");

    // Cancelled, and submitted again at once.
    fs::remove_dir_all(bench.path("which.sweep")).expect("removed");
    cluster.ok(&bench, "sweep which.toml --on slurm");
    cluster.ok(&bench, "sweep cancel which.toml");
    cluster.ok(&bench, "sweep which.toml --on slurm");
    // A controller that is ended and started anew while jobs wait and run.
    let controller = cluster.pid("slurmctld.pid");
    Command::new("kill")
        .arg(&controller)
        .status()
        .expect("sent");
    let began = Instant::now();
    while Path::new(&format!("/proc/{controller}")).exists() {
        assert!(began.elapsed() < PATIENCE, "the controller did not end");
        std::thread::sleep(Duration::from_millis(50));
    }
    let configuration = cluster.configuration();
    let started = Command::new("slurmctld")
        .arg("-f")
        .arg(&configuration)
        .env("SLURM_CONF", &configuration)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status();
    assert!(started.expect("slurmctld").success());
    // A node that is lost with its jobs.
    let began = Instant::now();
    while fs::read_dir(bench.path("which.sweep/results")).map_or(0, Iterator::count) == 0 {
        assert!(
            began.elapsed() < PATIENCE,
            "nothing was scored\n{}",
            cluster.logs(&bench)
        );
        std::thread::sleep(Duration::from_millis(50));
    }
    cut_power(&cluster, "two");
    cluster.wait(&bench);
    assert_eq!(
        bytes(&bench, "which.sweep"),
        reference,
        "{}",
        cluster.logs(&bench)
    );
}

#[test]
fn shards_of_tables_on_two_nodes_end_in_the_scores_of_one_pass() {
    let Some(cluster) = Cluster::start() else {
        return;
    };
    let bench = Bench::new();
    let [truth, prediction] = tables(500, true);
    bench.write("truth.csv", &truth);
    bench.write("pred.csv", &prediction);
    let score = "[score]\ntruth = \"truth.csv\"\npred = \"pred.csv\"\nshards = 5\n";
    bench.write("which.toml", &format!("sweep_version = 1\n{score}{SLURM}"));
    let said = cluster.ok(&bench, "sweep which.toml --on slurm");
    assert!(said.contains("submitted 5 tasks in 2 jobs"), "{said}");
    cluster.wait(&bench);
    let joined = fs::read_to_string(bench.path("which.sweep/score.json"));
    let whole = bench.ok("score --truth truth.csv --pred pred.csv --format json -q");
    assert_eq!(
        joined.unwrap_or_else(|_| panic!("{}", cluster.logs(&bench))),
        whole
    );
}

#[test]
fn a_refusing_sbatch_is_quoted_and_nothing_of_the_sweep_is_left_in_the_queue() {
    let Some(cluster) = Cluster::start() else {
        return;
    };
    let bench = week();
    bench.write(
        "which.toml",
        &format!("{SWEEP}{}", SLURM.replace("\"main\"", "\"nowhere\"")),
    );
    let (code, said) = cluster.run(&bench, "sweep which.toml --on slurm");
    assert_eq!(code, 3, "{said}");
    assert!(
        said.contains("sbatch: ") && said.contains("invalid partition"),
        "{said}"
    );
    let status = cluster.ok(&bench, "sweep status which.toml");
    assert!(status.contains("none were submitted"), "{status}");
}
