//! Arguments of the commands that make datasets and look at them.

use std::path::PathBuf;

use clap::{ArgGroup, Args};

use super::{ExplainArgs, ListFormat, Output, SplitArgs};

/// The map says, in TOML, which column is which channel, in which unit, and where the pictures are.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("layout").required(true).args(["map", "preset", "draft", "presets"]))]
pub(crate) struct Import {
    /// The folder that holds the table and the pictures, or a tar of it (.tar, .tar.gz, .tgz)
    #[arg(required_unless_present = "presets")]
    pub(crate) source: Option<PathBuf>,
    /// The map; see the documentation of taceva-import for its keys
    #[arg(long, value_name = "MAP.toml")]
    pub(crate) map: Option<PathBuf>,
    /// A known layout, which needs no map: --presets lists them
    #[arg(long, value_name = "NAME")]
    pub(crate) preset: Option<String>,
    /// List the known layouts: what lies where, what of it is read, what it leaves open
    #[arg(long, conflicts_with_all = ["source", "out", "explain", "force", "ffmpeg"])]
    pub(crate) presets: bool,
    /// Print the map of --preset instead of importing, to be adapted; to --out, else to the terminal
    #[arg(long, requires = "preset", conflicts_with_all = ["explain", "map", "draft"])]
    pub(crate) print: bool,
    /// How --presets is written
    #[arg(long, value_name = "FORMAT", value_enum, default_value_t = ListFormat::Text, requires = "presets")]
    pub(crate) format: ListFormat,
    /// Look at the folder and write a first map for it, with reasons as comments and units left open; to --out, else to the terminal
    #[arg(long, conflicts_with = "explain")]
    pub(crate) draft: bool,
    /// The dataset to write: a new folder
    #[arg(long, value_name = "DATASET", required_unless_present_any = ["explain", "draft", "extend", "presets", "print"])]
    pub(crate) out: Option<PathBuf>,
    /// Add the rows to this dataset, imported before by a map of the same sensor; each row before keeps its part of every split
    #[arg(long, value_name = "DATASET", conflicts_with_all = ["out", "draft", "force"])]
    pub(crate) extend: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) explain: ExplainArgs,
    /// Replace a dataset that exists already
    #[arg(long)]
    pub(crate) force: bool,
    /// Compare the folder with a list of digests before it is read: a file that has changed, is absent or is not named there is refused by name
    #[arg(long, value_name = "SHA256SUMS", conflicts_with_all = ["presets", "print"])]
    pub(crate) verify: Option<PathBuf>,
    /// The program that decodes clips which are not decoded here, such as HEVC or FFV1; without it TACEVA_FFMPEG, or else ffmpeg on the PATH
    #[arg(long, value_name = "PROGRAM")]
    pub(crate) ffmpeg: Option<PathBuf>,
}

/// Labels and signals are kept to the last bit, pictures to the last pixel, and their files byte for byte where the form holds files; `map.toml` beside
/// them brings all of it back: `taceva import FOLDER --map FOLDER/map.toml --out DATASET`. What no map can say (settings of the camera, how presses ended) is named.
///
/// Read by: huggingface: `datasets.load_dataset("FOLDER")`; lerobot: `LeRobotDataset("me/it", root="FOLDER")`; hdf5: `h5py.File("FOLDER/recording.h5")`;
/// csv: anything.
#[derive(Debug, Args)]
pub(crate) struct Export {
    /// The dataset
    pub(crate) dataset: PathBuf,
    /// The folder to write: a new one, there whole or not at all
    #[arg(long, value_name = "FOLDER")]
    pub(crate) out: PathBuf,
    /// In which form
    #[arg(long, value_name = "FORM", value_enum, default_value_t = Form::Huggingface)]
    pub(crate) format: Form,
}

/// The form of an export.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Form {
    /// A table, labels.csv, and a file a picture in the bytes it came in
    Csv,
    /// Parquet with the pictures in a column, as Hugging Face writes it
    Huggingface,
    /// One file of HDF5: an array a column with its unit, the pictures as an array of pixels
    Hdf5,
    /// LeRobot 3.0: an episode a press, the pictures in the tables
    Lerobot,
}

impl From<Form> for taceva_import::ExportForm {
    fn from(form: Form) -> taceva_import::ExportForm {
        match form {
            Form::Csv => taceva_import::ExportForm::Csv,
            Form::Huggingface => taceva_import::ExportForm::HuggingFace,
            Form::Hdf5 => taceva_import::ExportForm::Hdf5,
            Form::Lerobot => taceva_import::ExportForm::LeRobot,
        }
    }
}

/// Files that decide a number or a claim are sealed: dataset.toml, results, states and models. One that was changed is refused until the edit
/// is accepted here; reports show the history. A model is not edited but fitted again.
#[derive(Debug, Args)]
pub(crate) struct Reseal {
    /// The dataset, or the file: dataset.toml, results or a state
    #[arg(value_name = "FILE|DATASET")]
    pub(crate) file: PathBuf,
    /// Why it was changed; reports show it
    #[arg(long, value_name = "TEXT")]
    pub(crate) reason: String,
}

/// Every finding has a stable code, from TAC001 to TAC044, and a hint. `--explain` lists the checks and what each looks for: units, copies, doubled and dropped frames,
/// clocks that jump, lags, blank frames, saturation, leakage between parts, what an import left out, and more. The exit code is 1 if a finding is an error.
#[derive(Debug, Args)]
pub(crate) struct Check {
    /// The dataset to check; of several recordings each is checked, and then whether they can be taken as one
    #[arg(required = true, value_name = "DATASET")]
    pub(crate) datasets: Vec<PathBuf>,
    /// Compare this folder, or a tar of it, with the files that the dataset was imported from, and make no other check
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["only", "explain"])]
    pub(crate) source: Option<PathBuf>,
    /// Make only the checks with these codes, separated by commas
    #[arg(long, value_name = "CODES", value_delimiter = ',')]
    pub(crate) only: Vec<String>,
    #[command(flatten)]
    pub(crate) split: SplitArgs,
    #[command(flatten)]
    pub(crate) explain: ExplainArgs,
    #[command(flatten)]
    pub(crate) output: Output,
}
