//! A Slurm of two virtual nodes on loopback.

use std::fs;
use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use taceva_needs::{Need, skip};

use crate::support::Bench;

/// Timeout that is long enough for a loaded machine.
pub(crate) const PATIENCE: Duration = Duration::from_secs(240);

/// One cluster at a time: free ports must stay free until the daemons open them.
static ALONE: Mutex<()> = Mutex::new(());

/// A Slurm of two nodes, stopped on drop.
pub(crate) struct Cluster {
    folder: tempfile::TempDir,
    _alone: MutexGuard<'static, ()>,
}

impl Cluster {
    /// Starts a cluster; `None` if Slurm is not installed or the user is not root.
    pub(crate) fn start() -> Option<Cluster> {
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
        // Daemons keep inherited files, so their output goes to a file instead of a pipe.
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

    pub(crate) fn configuration(&self) -> PathBuf {
        self.folder.path().join("slurm.conf")
    }

    /// Runs `taceva WORDS` as on a login node.
    pub(crate) fn run(&self, bench: &Bench, words: &str) -> (i32, String) {
        let mut command = bench.command(words);
        let output = command
            .env("SLURM_CONF", self.configuration())
            .output()
            .expect("it starts");
        let text = [output.stdout, output.stderr]
            .map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
        (output.status.code().unwrap_or(-1), text.concat())
    }

    pub(crate) fn ok(&self, bench: &Bench, words: &str) -> String {
        let (code, said) = self.run(bench, words);
        assert_eq!(code, 0, "taceva {words}: {said}");
        said
    }

    /// Waits until the sweep has no jobs left.
    pub(crate) fn wait(&self, bench: &Bench) {
        let began = Instant::now();
        loop {
            // A newly started controller may not answer yet.
            let (code, status) = self.run(bench, "sweep status which.toml");
            if code == 0 && status.contains("none are left") {
                return;
            }
            self.release(&status);
            assert!(began.elapsed() < PATIENCE, "{status}\n{}", self.logs(bench));
            std::thread::sleep(Duration::from_millis(300));
        }
    }

    /// Releases requeued jobs, which would be held for two minutes.
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

    pub(crate) fn logs(&self, bench: &Bench) -> String {
        let folder = bench.path("which.sweep/slurm/logs");
        let entries = fs::read_dir(folder).into_iter().flatten().flatten();
        entries
            .map(|entry| fs::read_to_string(entry.path()).unwrap_or_default())
            .collect()
    }

    pub(crate) fn pid(&self, name: &str) -> String {
        let text = fs::read_to_string(self.folder.path().join(name)).expect("a daemon's number");
        text.trim().to_owned()
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

/// The first of three free ports.
fn free_ports() -> u16 {
    for port in (20_000..60_000).step_by(37) {
        let held = [port, port + 1, port + 2].map(|port| TcpListener::bind(("127.0.0.1", port)));
        if held.iter().all(Result::is_ok) {
            return port;
        }
    }
    panic!("no three ports are free");
}
