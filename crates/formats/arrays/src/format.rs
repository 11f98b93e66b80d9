//! Formats of files of arrays.

use std::path::Path;

/// Format of a file of arrays.
///
/// ```
/// use std::path::Path;
/// use taceva_arrays::ArrayFormat;
///
/// assert_eq!(ArrayFormat::of(Path::new("run/frames.NPY")), Some(ArrayFormat::Npy));
/// assert_eq!(ArrayFormat::of(Path::new("run/labels.csv")), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ArrayFormat {
    /// One NumPy array (`.npy`).
    Npy,
    /// Several NumPy arrays in a zip archive (`.npz`).
    Npz,
    /// HDF5 (`.h5`, `.hdf5`, `.hdf`, `.he5`, `.nc4`).
    Hdf5,
    /// zarr of version 2 or 3: a folder (`.zarr`), or a ZIP archive of the folder with the same extension.
    Zarr,
    /// MATLAB (`.mat`) of version 5 or 7.3.
    Matlab,
    /// A Python pickle (`.pkl`, `.pickle`, `.p`) with arrays and plain values.
    Pickle,
}

impl ArrayFormat {
    /// All formats.
    pub const ALL: [ArrayFormat; 6] = [
        ArrayFormat::Npy,
        ArrayFormat::Npz,
        ArrayFormat::Hdf5,
        ArrayFormat::Zarr,
        ArrayFormat::Matlab,
        ArrayFormat::Pickle,
    ];

    /// Format indicated by the extension of `path`; `None` for an unknown extension. Does not open the file.
    #[must_use]
    pub fn of(path: &Path) -> Option<ArrayFormat> {
        let ending = path.extension()?.to_str()?.to_ascii_lowercase();
        let named = |format: &ArrayFormat| format.endings().contains(&ending.as_str());
        ArrayFormat::ALL.into_iter().find(named)
    }

    /// Usual extensions of the format, in lower case and without the dot.
    ///
    /// ```
    /// assert_eq!(taceva_arrays::ArrayFormat::Matlab.endings(), ["mat"]);
    /// ```
    #[must_use]
    pub fn endings(self) -> &'static [&'static str] {
        match self {
            ArrayFormat::Npy => &["npy"],
            ArrayFormat::Npz => &["npz"],
            ArrayFormat::Hdf5 => &["h5", "hdf5", "hdf", "he5", "nc4"],
            ArrayFormat::Zarr => &["zarr"],
            ArrayFormat::Matlab => &["mat"],
            ArrayFormat::Pickle => &["pkl", "pickle", "p"],
        }
    }
}
