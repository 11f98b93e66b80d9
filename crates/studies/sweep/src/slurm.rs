//! Tasks as Slurm jobs: readable scripts, arrays, and one job that collects the results.
//!
//! No daemon is needed. Jobs find their tasks in the shared folder, a result marks a task as finished, and the scheduler lists running jobs. If a job runs
//! twice, for example after a restart of the controller, it finds the results of its first run.

mod command;
mod queue;
mod record;
mod script;
mod submission;

use std::fs;
use std::path::{Path, PathBuf};

use crate::error::SweepError;
use crate::folder::SweepFolder;
use crate::slurm_spec::SlurmSpec;
use crate::task_list::TaskList;
use command::array_most;
use script::Script;

pub use queue::{JobState, queue_of};
pub use record::Submitted;
pub use submission::submit;

/// Scripts to submit, with the numbers of their tasks and jobs.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Submission {
    /// Scripts of the arrays, in order.
    pub arrays: Vec<PathBuf>,
    /// Script of the job that collects the results.
    pub collect: PathBuf,
    /// Number of tasks.
    pub tasks: usize,
    /// Number of jobs, excluding the job that collects the results.
    pub jobs: usize,
}

/// Tasks of one job array. All of them request the same resources.
struct Array<'a> {
    name: &'static str,
    tasks: Vec<usize>,
    gres: Option<&'a str>,
}

/// Writes the scripts that run the tasks at the indices `wanted`.
///
/// # Errors
/// [`SweepError::Io`] if a script cannot be written.
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
            // One line for each job: positions of its tasks.
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
