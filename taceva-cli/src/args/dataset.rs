//! Arguments of the commands that make and inspect datasets.

use std::path::PathBuf;

use clap::{ArgGroup, Args};

use super::{ExplainArgs, ListFormat, Output, SplitArgs};

/// Turn a lab's folder of pictures and labels into a dataset
///
/// The map states, in TOML, the column and unit of each channel, and the location of the pictures. `taceva init recording FOLDER` writes it by
/// questions, and --draft without questions. The layouts of --presets need no map. --explain prints what the import would read, and writes nothing.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("layout").args(["map", "preset", "draft", "presets"]))]
pub(crate) struct Import {
    /// The folder with the table and the pictures, a file in it, or a tar of it (.tar, .tar.gz, .tgz)
    #[arg(required_unless_present = "presets")]
    pub(crate) source: Option<PathBuf>,
    /// The map, as `taceva init recording` writes it; docs/your-recording.md explains its keys
    #[arg(long, value_name = "MAP.toml")]
    pub(crate) map: Option<PathBuf>,
    /// A known layout, which needs no map: --presets lists them
    #[arg(long, value_name = "NAME")]
    pub(crate) preset: Option<String>,
    /// List the known layouts: their files, the content that is read, and the settings left open
    #[arg(long, conflicts_with_all = ["source", "out", "explain", "force", "ffmpeg"])]
    pub(crate) presets: bool,
    /// Instead of importing, print the map of --preset as a start for your own; to the terminal, or to --out
    #[arg(long, requires = "preset", conflicts_with_all = ["explain", "map", "draft"])]
    pub(crate) print: bool,
    /// Format of the list of --presets
    #[arg(long, value_name = "FORMAT", value_enum, default_value_t = ListFormat::Text, requires = "presets")]
    pub(crate) format: ListFormat,
    /// Write a first map for the folder, with reasons as comments and unknown units left open; to the terminal, or to --out
    #[arg(long, conflicts_with = "explain")]
    pub(crate) draft: bool,
    /// The dataset to write: a new folder; with --draft or --print the map
    #[arg(long, value_name = "DATASET", required_unless_present_any = ["explain", "draft", "extend", "presets", "print"])]
    pub(crate) out: Option<PathBuf>,
    /// Append the rows to this dataset, imported earlier with a map of the same sensor; earlier rows keep their part of every split
    #[arg(long, value_name = "DATASET", conflicts_with_all = ["out", "draft", "force"])]
    pub(crate) extend: Option<PathBuf>,
    /// Append rows whose labels have another calibration certificate than the labels of the dataset; the dataset then names both certificates
    #[arg(long, requires = "extend")]
    pub(crate) new_certificate: bool,
    #[command(flatten)]
    pub(crate) explain: ExplainArgs,
    /// Replace a dataset that exists already, or a map with --draft or --print
    #[arg(long)]
    pub(crate) force: bool,
    /// Compare the folder with a list of digests before it is read; a changed, missing or unlisted file is an error
    #[arg(long, value_name = "SHA256SUMS", conflicts_with_all = ["presets", "print"])]
    pub(crate) verify: Option<PathBuf>,
    /// The program for clips that taceva cannot decode, such as HEVC or FFV1 [default: TACEVA_FFMPEG, or else ffmpeg on the PATH]
    #[arg(long, value_name = "PROGRAM")]
    pub(crate) ffmpeg: Option<PathBuf>,
}

/// Write a dataset in a form that other programs read
///
/// Labels and signals are kept to the last bit, pictures to the last pixel, and their files byte for byte if the format contains files.
/// `map.toml` in the same folder restores all of it: `taceva import FOLDER --map FOLDER/map.toml --out DATASET`. Data that no map can express
/// (camera settings, ends of presses) is listed.
///
/// Readers: for huggingface `datasets.load_dataset("FOLDER")`, for lerobot `LeRobotDataset("me/it", root="FOLDER")`, for hdf5
/// `h5py.File("FOLDER/recording.h5")`, for csv any program.
#[derive(Debug, Args)]
pub(crate) struct Export {
    /// The dataset to export
    pub(crate) dataset: PathBuf,
    /// The new folder to write, created completely or not at all
    #[arg(long, value_name = "FOLDER")]
    pub(crate) out: PathBuf,
    /// The format to write
    #[arg(long, value_name = "FORM", value_enum, default_value_t = Form::Huggingface)]
    pub(crate) format: Form,
}

/// Show the content of a dataset and its devices, with certificates and latencies
///
/// Prints one fact per line: content, origin, days of recording, instruments of the labels, their certificates, settings and latencies of the
/// devices, sessions, warnings. No frame is decoded.
#[derive(Debug, Args)]
pub(crate) struct Show {
    /// The dataset to show
    pub(crate) dataset: PathBuf,
}

/// Format of an exported dataset.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Form {
    /// A table, labels.csv, and one file for each picture in its original bytes
    Csv,
    /// Parquet with the pictures in a column, as Hugging Face writes it
    Huggingface,
    /// One HDF5 file, recording.h5: an array for each column with its unit, the pictures as an array of pixels
    Hdf5,
    /// LeRobot 3.0: an episode for each press, the pictures in the tables
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

/// Accept a deliberate edit of a sealed file, and record it with its reason in the file's history
///
/// Files that decide a number or a claim are sealed: dataset.toml, results, states and models. A changed file is rejected until the edit is
/// accepted here; reports show the history. A model is not edited but fitted again.
#[derive(Debug, Args)]
pub(crate) struct Reseal {
    /// The dataset, or the file: dataset.toml, results or a state
    #[arg(value_name = "FILE|DATASET")]
    pub(crate) file: PathBuf,
    /// The reason for the edit; reports show it
    #[arg(long, value_name = "TEXT")]
    pub(crate) reason: String,
}

/// Check a recording for defects, before any number is computed
///
/// Every finding has a stable code, from TAC001 to TAC045, and a hint. `--explain` lists the checks and their defects: units, copies,
/// doubled and dropped frames, clocks that jump, lags, blank frames, saturation, leakage between parts, data that an import left out, and
/// more. A hint names the remedy: a key of the map for an import, a command for a recording. The exit code is 1 if a finding is an error.
#[derive(Debug, Args)]
pub(crate) struct Check {
    /// The dataset to check; several recordings are checked one by one, and then for conflicts between them
    #[arg(required = true, value_name = "DATASET")]
    pub(crate) datasets: Vec<PathBuf>,
    /// Compare this folder, or a tar of it, with the files that the dataset was imported from, and run no other check
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["only", "explain"])]
    pub(crate) source: Option<PathBuf>,
    /// Run only the checks with these codes or names, separated by commas: TAC013,leakage
    #[arg(long, value_name = "CODES", value_delimiter = ',')]
    pub(crate) only: Vec<String>,
    #[command(flatten)]
    pub(crate) split: SplitArgs,
    #[command(flatten)]
    pub(crate) explain: ExplainArgs,
    #[command(flatten)]
    pub(crate) output: Output,
}
