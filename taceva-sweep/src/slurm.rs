//! Tasks as jobs of Slurm: scripts that can be read and kept, arrays, and one job that collects.
//!
//! Nothing of ours runs beside: jobs find their tasks in the shared folder, results say what is done, and the scheduler says what runs. A job
//! that runs twice, as jobs of a controller that was started anew do, finds the results of the first.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde::{Deserialize, Serialize};
use taceva_core::shown;

use crate::error::SweepError;
use crate::folder::SweepFolder;
use crate::shell::shell_word;
use crate::slurm_spec::SlurmSpec;
use crate::task_list::TaskList;

/// What Slurm allows in one array where the site says nothing.
const ARRAY_MOST: u32 = 1001;
/// The record of what was submitted.
const RECORD: &str = "jobs.json";

/// What is submitted.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Submission {
    /// The scripts of arrays, in their order.
    pub arrays: Vec<PathBuf>,
    /// The script that collects.
    pub collect: PathBuf,
    /// Tasks in all.
    pub tasks: usize,
    /// Jobs in all, but for the one that collects.
    pub jobs: usize,
}

/// What was submitted.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Submitted {
    /// The numbers of the arrays.
    pub arrays: Vec<String>,
    /// The number of the job that collects.
    pub collect: Option<String>,
}

/// A job as the scheduler lists it.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct JobState {
    /// Its number: `17_3`.
    pub id: String,
    /// `RUNNING`, `PENDING`, …
    pub state: String,
    /// Where it runs, or why it waits.
    pub place: String,
}

/// Tasks of one array, which ask for the same.
struct Array<'a> {
    name: &'static str,
    tasks: Vec<usize>,
    gres: Option<&'a str>,
}

/// Writes the scripts that carry out the tasks at `wanted`.
///
/// # Errors
/// [`SweepError::Io`].
pub fn scripts(
    folder: &SweepFolder,
    list: &TaskList,
    wanted: &[usize],
    spec: &SlurmSpec,
    options: &str,
) -> Result<Submission, SweepError> {
    let own = folder.slurm();
    fs::create_dir_all(own.join("logs")).map_err(SweepError::io("make", &own))?;
    let tasks = list.write(folder)?;
    let root = std::path::absolute(folder.path()).map_err(SweepError::io("find", folder.path()))?;
    let tasks = std::path::absolute(&tasks).map_err(SweepError::io("find", &tasks))?;
    let program = match &spec.program {
        Some(program) => program.clone(),
        None => std::env::current_exe()
            .map_err(SweepError::io("find", Path::new("the program")))?
            .to_string_lossy()
            .into_owned(),
    };
    let (on_devices, others): (Vec<usize>, Vec<usize>) = wanted
        .iter()
        .partition(|at| list.tasks[**at].asks_for_device());
    let arrays = [
        Array {
            name: "tasks",
            tasks: others,
            gres: None,
        },
        Array {
            name: "device",
            tasks: on_devices,
            gres: spec.gres.as_deref().or(Some("gpu:1")),
        },
    ];
    let a_job = spec.tasks_a_job.unwrap_or(1).max(1) as usize;
    let most = array_most();
    let mut submission = Submission {
        arrays: Vec::new(),
        collect: own.join("collect.sh"),
        tasks: wanted.len(),
        jobs: 0,
    };
    let script = Script {
        root: &root,
        tasks: &tasks,
        program: &program,
        spec,
        options,
    };
    for array in arrays {
        let blocks: Vec<&[usize]> = array.tasks.chunks(a_job).collect();
        for (number, blocks) in blocks.chunks(most as usize).enumerate() {
            let name = format!("{}-{}", array.name, number + 1);
            // A line a job: the positions of its tasks.
            let lines = blocks.iter().map(|block| {
                let positions = block.iter().map(usize::to_string);
                positions.collect::<Vec<_>>().join(",")
            });
            let blocks_file = own.join(format!("{name}.blocks"));
            let text = lines.collect::<Vec<_>>().join("\n") + "\n";
            folder.write(&blocks_file, text.as_bytes())?;
            let path = own.join(format!("{name}.sh"));
            folder.write(
                &path,
                script.array(&name, blocks.len(), array.gres).as_bytes(),
            )?;
            submission.arrays.push(path);
            submission.jobs += blocks.len();
        }
    }
    folder.write(&submission.collect, script.collect().as_bytes())?;
    Ok(submission)
}

/// What scripts have in common.
struct Script<'a> {
    root: &'a Path,
    tasks: &'a Path,
    program: &'a str,
    spec: &'a SlurmSpec,
    /// Options of the program that the sweep was started with.
    options: &'a str,
}

impl Script<'_> {
    /// One job of an array: the tasks of a line of its file of blocks.
    fn array(&self, name: &str, jobs: usize, gres: Option<&str>) -> String {
        let most = self
            .spec
            .most_jobs
            .map_or_else(String::new, |most| format!("%{most}"));
        let mut text = self.head(name, "%A_%a");
        let mut line = |line: String| {
            text.push_str(&line);
            text.push('\n');
        };
        line(format!("#SBATCH --array=0-{}{most}", jobs - 1));
        line("#SBATCH --requeue".to_owned());
        let asked = [
            ("time", self.spec.time.as_deref()),
            ("mem", self.spec.memory.as_deref()),
            ("gres", gres),
        ];
        for (option, value) in asked {
            if let Some(value) = value {
                line(format!("#SBATCH --{option}={value}"));
            }
        }
        let cpus = self.spec.cpus.unwrap_or(1).max(1);
        line(format!("#SBATCH --cpus-per-task={cpus}"));
        text.push_str(&self.setup());
        let blocks = self.root.join(format!("slurm/{name}.blocks"));
        text.push_str(&format!(
            "blocks={}\n[ -r \"$blocks\" ] || {{ echo \"$blocks is not on $(hostname): the folder of the sweep is not shared with this node\" >&2; exit 1; }}\n",
            shell_word(&blocks.to_string_lossy())
        ));
        text.push_str("block=$(sed -n \"$((SLURM_ARRAY_TASK_ID + 1))p\" \"$blocks\")\n");
        text.push_str(&format!(
            "exec {} sweep task {} --tasks {} --at \"$block\" --jobs {cpus} --quiet{}\n",
            shell_word(self.program),
            shell_word(&self.root.to_string_lossy()),
            shell_word(&self.tasks.to_string_lossy()),
            self.options
        ));
        text
    }

    /// The job that makes the table of what is there once every other has ended, however it ended.
    fn collect(&self) -> String {
        let mut text = self.head("collect", "%j");
        text.push_str(&self.setup());
        text.push_str(&format!(
            "exec {} sweep collect {} --tasks {} --quiet\n",
            shell_word(self.program),
            shell_word(&self.root.to_string_lossy()),
            shell_word(&self.tasks.to_string_lossy())
        ));
        text
    }

    fn head(&self, name: &str, log: &str) -> String {
        let root = self.root.to_string_lossy();
        let mut text = format!(
            "#!/bin/bash\n# Written by `taceva sweep --on slurm`; it may be submitted by hand again: what has a result is not made twice.\n#SBATCH --job-name=taceva-{name}\n#SBATCH --chdir={root}\n#SBATCH --output={root}/slurm/logs/{name}-{log}.txt\n#SBATCH --open-mode=append\n"
        );
        if let Some(partition) = &self.spec.partition {
            text.push_str(&format!("#SBATCH --partition={partition}\n"));
        }
        text
    }

    fn setup(&self) -> String {
        let lines = self.spec.setup.iter();
        lines.map(|line| format!("{line}\n")).collect()
    }
}

/// How many jobs the site allows in one array.
fn array_most() -> u32 {
    let asked = Command::new("scontrol").args(["show", "config"]).output();
    let text = asked.map(|output| String::from_utf8_lossy(&output.stdout).into_owned());
    let text = text.unwrap_or_default();
    let mut lines = text.lines();
    let said = lines.find_map(|line| {
        let (name, value) = line.split_once('=')?;
        (name.trim() == "MaxArraySize").then(|| value.trim().parse::<u32>().ok())?
    });
    // Indices go up to one less than that number.
    said.unwrap_or(ARRAY_MOST).saturating_sub(1).max(1)
}

/// Submits the arrays, and the job that collects once all of them have ended.
///
/// # Errors
/// [`SweepError::Scheduler`] with the words of `sbatch`; what was submitted before is cancelled then.
pub fn submit(folder: &SweepFolder, submission: &Submission) -> Result<Submitted, SweepError> {
    let mut submitted = Submitted::default();
    let done = submit_all(submission, &mut submitted);
    if let Err(error) = done {
        // Half a sweep that nobody collects would only take time.
        drop(run("scancel", &submitted.arrays));
        return Err(error);
    }
    let path = folder.slurm().join(RECORD);
    let text = serde_json::to_string(&submitted).map_err(|error| SweepError::Kept {
        path: path.clone(),
        problem: error.to_string(),
    })?;
    folder.write(&path, text.as_bytes())?;
    Ok(submitted)
}

fn submit_all(submission: &Submission, submitted: &mut Submitted) -> Result<(), SweepError> {
    let number = |words: String| {
        // `17` or `17;cluster`.
        let first = words.trim().split(';').next().unwrap_or_default();
        first.to_owned()
    };
    for array in &submission.arrays {
        let said = run(
            "sbatch",
            &[
                "--parsable".to_owned(),
                array.to_string_lossy().into_owned(),
            ],
        )?;
        submitted.arrays.push(number(said));
    }
    let mut words = vec!["--parsable".to_owned()];
    if !submitted.arrays.is_empty() {
        // After any end: who collects knows what is missing.
        words.push(format!(
            "--dependency=afterany:{}",
            submitted.arrays.join(":")
        ));
        words.push("--kill-on-invalid-dep=yes".to_owned());
    }
    words.push(submission.collect.to_string_lossy().into_owned());
    submitted.collect = Some(number(run("sbatch", &words)?));
    Ok(())
}

impl Submitted {
    /// What was submitted last; `None` if nothing was.
    ///
    /// # Errors
    /// [`SweepError`] if the record cannot be read.
    pub fn read(folder: &SweepFolder) -> Result<Option<Submitted>, SweepError> {
        let path = folder.slurm().join(RECORD);
        match fs::read_to_string(&path) {
            Ok(text) => serde_json::from_str(&text)
                .map(Some)
                .map_err(|error| SweepError::Kept {
                    path,
                    problem: error.to_string(),
                }),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(SweepError::io("read", &path)(error)),
        }
    }

    fn numbers(&self) -> Vec<String> {
        self.arrays.iter().chain(&self.collect).cloned().collect()
    }

    /// Cancels all of it.
    ///
    /// # Errors
    /// [`SweepError::Scheduler`] with the words of `scancel`.
    pub fn cancel(&self) -> Result<(), SweepError> {
        run("scancel", &self.numbers()).map(drop)
    }
}

/// The jobs of `submitted` that the scheduler still has.
///
/// # Errors
/// [`SweepError::Scheduler`] with the words of `squeue`.
pub fn queue_of(submitted: &Submitted) -> Result<Vec<JobState>, SweepError> {
    // All of the user, and not those by number: once the scheduler has forgotten a number, asking for it is an error.
    let words = ["--noheader", "--array", "--me", "--format=%i|%T|%R"].map(str::to_owned);
    let text = run("squeue", &words)?;
    let own = submitted.numbers();
    let jobs = text.lines().filter_map(|line| {
        let mut parts = line.trim().splitn(3, '|');
        let (id, state, place) = (parts.next()?, parts.next()?, parts.next()?);
        let number = id.split('_').next()?;
        own.iter().any(|known| known == number).then(|| JobState {
            id: id.to_owned(),
            state: state.to_owned(),
            place: place.to_owned(),
        })
    });
    Ok(jobs.collect())
}

/// Runs a command of the scheduler; its standard output.
fn run(command: &'static str, words: &[String]) -> Result<String, SweepError> {
    let refused = |words: String| SweepError::Scheduler { command, words };
    let output = Command::new(command).args(words).output().map_err(|error| {
        refused(format!(
            "cannot be started ({error}): no Slurm on this machine? The scripts are written, and may be submitted elsewhere"
        ))
    })?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    let said = String::from_utf8_lossy(&output.stderr);
    let said: Vec<&str> = said
        .lines()
        .map(str::trim)
        .filter(|line| !line.is_empty())
        .collect();
    Err(refused(match said.is_empty() {
        true => format!("{}", output.status),
        false => shown(&said.join("; ")).to_string(),
    }))
}
