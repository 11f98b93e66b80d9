//! Forms of an export.

/// Form of an export, readable by other programs.
///
/// ```
/// use taceva_import::ExportForm;
///
/// assert_eq!(ExportForm::ALL.map(ExportForm::name), ["csv", "huggingface", "hdf5", "lerobot"]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ExportForm {
    /// `labels.csv` with one row per sample, and one file for each picture.
    Csv,
    /// Parquet file for the library `datasets` of Hugging Face, with the pictures in the column `image`.
    HuggingFace,
    /// `recording.h5`: one array for each column, and the pictures as one array of pixels.
    Hdf5,
    /// LeRobot folder, version 3.0: one episode per press.
    LeRobot,
}

impl ExportForm {
    /// Every form.
    pub const ALL: [ExportForm; 4] = [
        ExportForm::Csv,
        ExportForm::HuggingFace,
        ExportForm::Hdf5,
        ExportForm::LeRobot,
    ];

    /// Name of the form on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            ExportForm::Csv => "csv",
            ExportForm::HuggingFace => "huggingface",
            ExportForm::Hdf5 => "hdf5",
            ExportForm::LeRobot => "lerobot",
        }
    }
}
