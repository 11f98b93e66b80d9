//! The forms of an export.

/// A form that other programs read.
///
/// ```
/// use taceva_import::ExportForm;
///
/// assert_eq!(ExportForm::ALL.map(ExportForm::name), ["csv", "huggingface", "hdf5", "lerobot"]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ExportForm {
    /// `labels.csv`, one row for each sample, and each picture in a file of its own.
    Csv,
    /// Parquet whose column `image` holds the pictures, as the library `datasets` of Hugging Face reads it.
    HuggingFace,
    /// `recording.h5`: one array for each column, the pictures as one array of pixels.
    Hdf5,
    /// A folder of LeRobot, version 3.0: one episode for each press.
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

    /// The word for it.
    pub const fn name(self) -> &'static str {
        match self {
            ExportForm::Csv => "csv",
            ExportForm::HuggingFace => "huggingface",
            ExportForm::Hdf5 => "hdf5",
            ExportForm::LeRobot => "lerobot",
        }
    }
}
