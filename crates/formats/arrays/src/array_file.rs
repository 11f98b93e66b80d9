//! File of arrays in any supported format.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::element::ArrayInfo;
use crate::error::{ArrayError, Problem};
use crate::fields::check_read;
use crate::format::ArrayFormat;
use crate::npy::NpyArray;
use crate::npz::Npz;
use crate::pickle::Pickle;
use crate::source::FileBytes;
use crate::store::{Arrays, Store};
use crate::values::{ArrayData, ArrayValues};
use crate::zarr::Zarr;

/// Number of names that an error for a missing array lists.
const NAMES_SHOWN: usize = 12;

/// Named arrays of one file, read in ranges of rows. Threads may share an open file.
///
/// ```no_run
/// use taceva_arrays::{ArrayFile, ArrayFormat};
///
/// let file = ArrayFile::open("run.h5".as_ref(), ArrayFormat::Hdf5)?;
/// for name in file.names() {
///     println!("{name}: {:?}", file.info(&name).expect("listed").shape);
/// }
/// let one = file.read("/camera/rgb", 7..8)?;
/// assert_eq!(one.shape, [1, 240, 320, 3]);
/// # Ok::<(), taceva_arrays::ArrayError>(())
/// ```
#[derive(Debug)]
pub struct ArrayFile {
    path: PathBuf,
    store: Box<dyn Store>,
    arrays: Arrays,
    by_name: BTreeMap<String, usize>,
}

impl ArrayFile {
    /// Opens a file and lists its arrays. Does not read elements.
    ///
    /// # Errors
    /// [`ArrayError`] if the file cannot be opened, is damaged, has another format, or contains unsupported content.
    pub fn open(path: &Path, format: ArrayFormat) -> Result<ArrayFile, ArrayError> {
        let wrong = |problem: Problem| ArrayError {
            path: path.to_owned(),
            array: None,
            problem,
        };
        Ok(ArrayFile::of_store(
            path,
            open(path, format).map_err(wrong)?,
        ))
    }

    /// Reads the bytes of a `.npy` file within another file. `path` is used only in errors.
    ///
    /// # Errors
    /// [`ArrayError`] if the bytes are damaged, are not a NumPy array, or have an unsupported type.
    ///
    /// ```
    /// use taceva_arrays::{ArrayFile, ArrayValues};
    ///
    /// let header = "{'descr': '<i2', 'fortran_order': False, 'shape': (2,), }\n";
    /// let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    /// bytes.extend([header.len() as u8, 0]);
    /// bytes.extend(header.as_bytes());
    /// bytes.extend([1, 0, 2, 0]);
    /// let file = ArrayFile::of_npy("run.tar".as_ref(), bytes)?;
    /// assert_eq!(file.read("value", 0..2)?.values, ArrayValues::I16(vec![1, 2]));
    /// # Ok::<(), taceva_arrays::ArrayError>(())
    /// ```
    pub fn of_npy(path: &Path, bytes: Vec<u8>) -> Result<ArrayFile, ArrayError> {
        let store = NpyArray::open("", Arc::new(bytes)).map_err(|problem| ArrayError {
            path: path.to_owned(),
            array: None,
            problem,
        })?;
        Ok(ArrayFile::of_store(path, Box::new(store)))
    }

    fn of_store(path: &Path, store: Box<dyn Store>) -> ArrayFile {
        let arrays = store.arrays();
        let named = arrays.iter().enumerate();
        let by_name = named
            .map(|(index, (name, _))| (name.clone(), index))
            .collect();
        ArrayFile {
            path: path.to_owned(),
            store,
            arrays,
            by_name,
        }
    }

    /// Names of the arrays, in the order of the file.
    ///
    /// An `.npy` file has one array, `value`. An `.npz` file has the names of its members without `.npy`. HDF5 and zarr have full paths
    /// (`/group/frames`). A MATLAB file has its variables. A pickle has `value`, or the keys of its dictionary or of the dictionaries in its
    /// list. An array of records has one name for each field, after a dot: `/table.Fx`.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        self.arrays.iter().map(|(name, _)| name.clone()).collect()
    }

    /// Shape and type of the array `name`; `None` if it does not exist. The leading slash of a full name is optional.
    #[must_use]
    pub fn info(&self, name: &str) -> Option<&ArrayInfo> {
        let index = self.index(name)?;
        self.arrays.get(index).map(|(_, info)| info)
    }

    /// Shape and type of the array `name`, or the reason why it cannot be read.
    ///
    /// ```no_run
    /// # fn of(file: &taceva_arrays::ArrayFile) -> Result<(), taceva_arrays::ArrayError> {
    /// // `…/run.mat: contacts: a sparse matrix; save a matrix: …`, or the names that are there.
    /// let contacts = file.find("contacts")?;
    /// println!("{} rows", contacts.rows());
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`ArrayError`] if the array does not exist or is not supported.
    pub fn find(&self, name: &str) -> Result<&ArrayInfo, ArrayError> {
        self.info(name)
            .ok_or_else(|| self.wrong(name, self.absent(name)))
    }

    fn wrong(&self, name: &str, problem: Problem) -> ArrayError {
        ArrayError {
            path: self.path.clone(),
            array: Some(name.to_owned()),
            problem,
        }
    }

    /// Index of the array `name`; `None` if it does not exist. The leading slash of a full name is optional.
    fn index(&self, name: &str) -> Option<usize> {
        let found = self
            .by_name
            .get(name)
            .or_else(|| self.by_name.get(&format!("/{name}")));
        found.copied()
    }

    /// Full names of the groups of an HDF5 or zarr file that match `pattern`, sorted by name. `*` matches any characters except `/`. Dictionaries
    /// within the dictionary of a pickle are also groups, after dots: `trajectories.*`.
    #[must_use]
    pub fn groups(&self, pattern: &str) -> Vec<String> {
        let mut groups = self.store.groups();
        let depth = |name: &str| match name.contains('/') {
            true => 0,
            false => name.matches('.').count(),
        };
        let is_like = |group: &String| {
            depth(group) == depth(pattern) && crate::pattern::matches(pattern, group)
        };
        groups.retain(is_like);
        groups.sort_unstable();
        groups
    }

    /// Dead links of the file, each with the reason. Dead links are not listed as arrays, and reading a dead link by name is an error.
    ///
    /// ```no_run
    /// # fn of(file: &taceva_arrays::ArrayFile) {
    /// for (link, reason) in file.dead_links() {
    ///     println!("{link}: {reason}");
    /// }
    /// # }
    /// ```
    #[must_use]
    pub fn dead_links(&self) -> Vec<(String, String)> {
        let links = self.store.nowhere().iter();
        links
            .map(|(link, reason)| (link.clone(), reason.to_string()))
            .collect()
    }

    /// Arrays and tables of the file that cannot be read, each with the reason.
    ///
    /// ```no_run
    /// # fn of(file: &taceva_arrays::ArrayFile) {
    /// for (array, reason) in file.unread_arrays() {
    ///     println!("{array}: {reason}");
    /// }
    /// # }
    /// ```
    #[must_use]
    pub fn unread_arrays(&self) -> Vec<(String, String)> {
        let refused = self.store.refused().iter();
        refused
            .map(|(array, reason)| (array.clone(), reason.to_string()))
            .collect()
    }

    /// Checks that no dead link matches `pattern` or a parent of a match. [`groups`](ArrayFile::groups) is then complete.
    ///
    /// ```no_run
    /// # fn of(file: &taceva_arrays::ArrayFile) -> Result<(), taceva_arrays::ArrayError> {
    /// file.check_groups("/data/*")?;
    /// let presses = file.groups("/data/*");
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`ArrayError`] with the name of a matching dead link.
    pub fn check_groups(&self, pattern: &str) -> Result<(), ArrayError> {
        let wanted: Vec<&str> = pattern.trim_matches('/').split('/').collect();
        let is_like = |link: &str| {
            let steps = link.trim_matches('/').split('/').count();
            let above = wanted.get(..steps);
            above.is_some_and(|above| crate::pattern::matches(&above.join("/"), link))
        };
        let mut links = self.store.nowhere().iter();
        match links.find(|(link, _)| is_like(link)) {
            None => Ok(()),
            Some((link, reason)) => Err(self.wrong(link, reason.again())),
        }
    }

    /// Names of the attributes of the group or array `owner`; empty if the format has no attributes.
    ///
    /// ```no_run
    /// # fn of(file: &taceva_arrays::ArrayFile) {
    /// for name in file.attributes("/data/demo_0") {
    ///     println!("{name}: {:?}", file.attribute("/data/demo_0", &name));
    /// }
    /// # }
    /// ```
    #[must_use]
    pub fn attributes(&self, owner: &str) -> Vec<String> {
        self.store.attributes(owner)
    }

    /// Attribute `name` of the group or array `owner`; `None` if it is missing. Numbers have the shortest text that parses back exactly. Several numbers are in
    /// brackets.
    #[must_use]
    pub fn attribute(&self, owner: &str, name: &str) -> Option<String> {
        self.store.attribute(owner, name)
    }

    /// Reads rows of the first axis, in the byte order of this machine and in C order. An array of a single number has one row.
    ///
    /// # Errors
    /// [`ArrayError`] if the array or a row does not exist, the rows need more than 1 GiB, or the file is damaged there.
    pub fn read(&self, name: &str, rows: Range<u64>) -> Result<ArrayData, ArrayError> {
        self.rows(name, rows)
            .map_err(|problem| self.wrong(name, problem))
    }

    /// Number of chunks of the array that were never written (HDF5, zarr). Their elements are read as the fill value, mostly 0, without any mark. Returns 0 for
    /// arrays without chunks, and if the index of an HDF5 file cannot be listed.
    ///
    /// ```no_run
    /// # fn of(file: &taceva_arrays::ArrayFile) -> Result<(), taceva_arrays::ArrayError> {
    /// match file.absent_chunks("/camera/rgb")? {
    ///     0 => {}
    ///     absent => println!("{absent} chunks are black because nobody wrote them"),
    /// }
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`ArrayError`] if the array does not exist, or its chunks cannot be listed.
    pub fn absent_chunks(&self, name: &str) -> Result<u64, ArrayError> {
        let index = self.index(name);
        let index = index.ok_or_else(|| self.wrong(name, self.absent(name)))?;
        self.store
            .absent_chunks(index)
            .map_err(|problem| self.wrong(name, problem))
    }

    fn rows(&self, name: &str, rows: Range<u64>) -> Result<ArrayData, Problem> {
        let index = self.index(name);
        let (index, info) = index
            .and_then(|index| Some((index, &self.arrays.get(index)?.1)))
            .ok_or_else(|| self.absent(name))?;
        if rows.start > rows.end || rows.end > info.rows() {
            return Err(Problem::Rows {
                asked: rows,
                rows: info.rows(),
            });
        }
        if info.shape.is_empty() && rows.is_empty() {
            return Ok(ArrayData {
                shape: vec![0],
                values: ArrayValues::with_capacity(info.element, 0),
            });
        }
        let mut shape = info.shape.clone();
        if let Some(first) = shape.first_mut() {
            *first = rows.end - rows.start;
        }
        check_read(&shape, info.element, 0)?;
        self.store.read(index, rows)
    }

    fn absent(&self, name: &str) -> Problem {
        // An unreadable record is requested by its fields.
        let name = name.trim_start_matches('/');
        let is_of = |array: &str| {
            let rest = name.strip_prefix(array.trim_start_matches('/'));
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '/']))
        };
        if let Some((_, reason)) = self.store.refused().iter().find(|(array, _)| is_of(array)) {
            return reason.again();
        }
        let is_behind = |link: &str| {
            let rest = name.strip_prefix(link.trim_start_matches('/'));
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '/']))
        };
        let mut links = self.store.nowhere().iter();
        if let Some((_, reason)) = links.find(|(link, _)| is_behind(link)) {
            return reason.again();
        }
        if let Some(link) = self.store.link(name) {
            return link;
        }
        let shown: Vec<&str> = self
            .arrays
            .iter()
            .map(|(name, _)| name.as_str())
            .take(NAMES_SHOWN)
            .collect();
        let more = self.arrays.len().saturating_sub(NAMES_SHOWN);
        let mut there = if shown.is_empty() {
            "none".to_owned()
        } else {
            shown.join(", ")
        };
        if more > 0 {
            there.push_str(&format!(" and {more} more"));
        }
        Problem::Absent { there }
    }
}

fn open(path: &Path, format: ArrayFormat) -> Result<Box<dyn Store>, Problem> {
    match format {
        ArrayFormat::Matlab => crate::matlab::open(FileBytes::open(path)?),
        ArrayFormat::Pickle => Ok(Box::new(Pickle::open(Arc::new(FileBytes::open(path)?), 0)?)),
        ArrayFormat::Zarr => Ok(Box::new(Zarr::open(path)?)),
        #[cfg(feature = "hdf5")]
        ArrayFormat::Hdf5 => Ok(crate::hdf5::store(crate::hdf5::Hdf5::open(
            FileBytes::open(path)?,
        )?)),
        #[cfg(not(feature = "hdf5"))]
        ArrayFormat::Hdf5 => Err(Problem::unsupported(
            "an HDF5 file, but this program was built without HDF5",
            "build the program with the feature `hdf5`",
        )),
        ArrayFormat::Npz => Ok(Box::new(Npz::open(FileBytes::open(path)?)?)),
        ArrayFormat::Npy => Ok(Box::new(NpyArray::open(
            "",
            Arc::new(FileBytes::open(path)?),
        )?)),
    }
}
