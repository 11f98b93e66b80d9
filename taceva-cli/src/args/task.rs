//! Arguments of tasks.

use clap::Args;
use taceva_evaluate::TaskSpec;
use taceva_tasks::PublicProgram;

use super::SettingArgs;

/// Options for scores of channels, which cannot be combined with `--task`.
const OF_CHANNELS: [&str; 9] = [
    "units",
    "periods",
    "metrics",
    "independent",
    "sensor",
    "figures",
    "samples_out",
    "table",
    "explain",
];

/// Tasks to score instead of channels.
#[derive(Debug, Args)]
pub(crate) struct TaskArgs {
    /// Score a task instead of channels, as NAME=KIND[:positive=CLASS][:names=A|B]: class, event, outcome, pose, place or depth; may be
    /// repeated. The column NAME holds classes. The columns `NAME.p.CLASS` of the predictions hold scores of classes. A pose has the columns
    /// NAME.x .y .z (mm) .qx .qy .qz .qw, and takes thresholds between its classes as NAME=pose:t=MM|MM:r=DEG|DEG. NAME=place:unit=m reads
    /// predictions in m. The truth of NAME=depth[:unit=UNIT][:gate=MM] is a dataset, and the predictions are an array of maps (.npy, .npz, .h5).
    /// Refused with --task: --units, --periods, --metrics, --independent, --sensor, --figures, --samples-out, --table, --explain
    #[arg(id = "task", long, value_name = "NAME=KIND", conflicts_with_all = OF_CHANNELS)]
    pub(crate) tasks: Vec<TaskSpec>,
    /// Column with the name of the trajectory, clip or object: intervals are over these names [default: point_id]
    #[arg(long, value_name = "COLUMN", requires = "task")]
    pub(crate) cluster: Option<String>,
    /// Predict the positive class where its score is above LIMIT, as NAME=LIMIT; may be repeated
    #[arg(id = "threshold", long, value_name = "NAME=LIMIT", requires = "task")]
    pub(crate) thresholds: Vec<String>,
    /// Predict the positive class from the Nth positive frame in a row on, as NAME=N; may be repeated
    #[arg(id = "debounce", long, value_name = "NAME=N", requires = "task")]
    pub(crate) debounces: Vec<String>,
    /// Also print the numbers of a public program, each beside the correct number and the reason for the difference: sparsh, touch-and-go, normalflow
    /// or objectfolder
    #[arg(id = "as", long = "as", value_name = "PROGRAM", requires = "task")]
    pub(crate) program: Option<PublicProgram>,
}

/// Frames that a sample of a task reads.
#[derive(Debug, Args)]
pub(crate) struct WindowArgs {
    /// Predict a sample of the task from N frames: its own frame, earlier frames of its cluster, and the changes between these frames [default: 1]
    #[arg(long, value_name = "N", requires = "task")]
    pub(crate) window: Option<u32>,
    /// Number of frames from one frame of the window to the next [default: 1]
    #[arg(long, value_name = "N", requires = "window")]
    pub(crate) stride: Option<u32>,
}

impl WindowArgs {
    /// `settings` with `window` and `stride` added, if they are given.
    pub(crate) fn on(&self, settings: &SettingArgs) -> SettingArgs {
        let window = self.window.map(|frames| format!("window={frames}"));
        let stride = self.stride.map(|frames| format!("stride={frames}"));
        let set = settings.set.iter().cloned();
        SettingArgs {
            set: set.chain(window).chain(stride).collect(),
            channels: settings.channels.clone(),
        }
    }
}
