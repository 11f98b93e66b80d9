//! Data frames in the fixed format of pandas, which stores blocks of columns of one type. Each column becomes an array.
//!
//! `/run` with `block0_items`, `block0_values` and `axis1` becomes `/run/Fz`, `/run/obj` and `/run/index`. A block of texts is a pickle.

use std::ops::Range;
use std::sync::Arc;

use super::Hdf5;
use crate::element::{ArrayInfo, Element};
use crate::error::Problem;
use crate::pickle::Pickle;
use crate::store::{Arrays, Store};
use crate::values::{ArrayData, ArrayValues};

/// File with data frames in the fixed format of pandas.
#[derive(Debug)]
pub(crate) struct DataFrames {
    hdf5: Hdf5,
    shown: Vec<Shown>,
    refused: Vec<(String, Problem)>,
}

/// Array that this crate lists for the file: a stored array, or a column of a data frame.
#[derive(Debug)]
struct Shown {
    name: String,
    info: ArrayInfo,
    content: Content,
}

/// Location of the elements of a listed array.
#[derive(Debug)]
enum Content {
    /// Whole array of the file, by its index.
    Array(usize),
    /// Column of a block of numbers.
    Numbers(BlockColumn),
    /// Column of a block of texts, whose block is stored as a pickle.
    Texts(BlockColumn),
}

#[derive(Clone, Copy, Debug)]
struct BlockColumn {
    array: usize,
    column: usize,
    /// Number of columns of the block.
    width: usize,
}

/// Remedy for every unsupported data frame.
const REMEDY: &str =
    "write it with `df.to_parquet(path)`, or with `df.to_hdf(path, key=\"run\", format=\"table\")`";

/// Creates the store of an HDF5 file. Data frames, if any, are replaced by their columns.
pub(crate) fn store(hdf5: Hdf5) -> Box<dyn Store> {
    let arrays = hdf5.arrays();
    let is_of_frame = |name: &String| {
        let last = name.rsplit('/').next().unwrap_or_default();
        last == "axis1" || last.starts_with("axis1_level") || last.starts_with("axis0")
    };
    let parent = |name: &String| name.rsplit_once('/').map(|(group, _)| group.to_owned());
    let mut groups: Vec<String> = arrays
        .iter()
        .map(|(name, _)| name)
        .filter(|name| is_of_frame(name))
        .filter_map(parent)
        .filter(|group| hdf5.attribute(group, "pandas_type").as_deref() == Some("frame"))
        .collect();
    groups.sort_unstable();
    groups.dedup();
    if groups.is_empty() {
        return Box::new(hdf5);
    }
    let (mut shown, mut refused) = (Vec::new(), Vec::new());
    for (index, (name, info)) in arrays.iter().enumerate() {
        if !parent(name).is_some_and(|group| groups.contains(&group)) {
            shown.push(Shown {
                name: name.clone(),
                info: info.clone(),
                content: Content::Array(index),
            });
        }
    }
    for (name, reason) in hdf5.refused() {
        if !parent(name).is_some_and(|group| groups.contains(&group)) {
            refused.push((name.clone(), reason.again()));
        }
    }
    for group in groups {
        match columns(&hdf5, &arrays, &group) {
            Ok(columns) => shown.extend(columns),
            Err(reason) => refused.push((group, reason)),
        }
    }
    Box::new(DataFrames {
        hdf5,
        shown,
        refused,
    })
}

/// Columns of the data frame in `group`, beginning with the index.
fn columns(hdf5: &Hdf5, arrays: &Arrays, group: &str) -> Result<Vec<Shown>, Problem> {
    let find = |name: &str| {
        let path = format!("{group}/{name}");
        arrays.iter().position(|(array, _)| *array == path)
    };
    let said = |name: &str| hdf5.attribute(group, name);
    if said("axis0_variety").as_deref() == Some("multi") {
        return Err(Problem::unsupported(
            "a data frame of pandas whose columns have several levels",
            "use one level, `df.columns = [\"_\".join(map(str, c)) for c in df.columns]`, and write it again",
        ));
    }
    let blocks: usize = said("nblocks")
        .and_then(|count| count.parse().ok())
        .unwrap_or(0);
    let mut shown = Vec::new();
    let mut rows = None;
    for block in 0..blocks {
        let there = [
            find(&format!("block{block}_items")),
            find(&format!("block{block}_values")),
        ];
        let [Some(items), Some(values)] = there else {
            return Err(Problem::unsupported(
                format!(
                    "an incomplete data frame of pandas: block {block} of {blocks} is not in `{group}`, and pandas cannot read it either \
                     (the fixed format supports neither categories nor half floats)"
                ),
                REMEDY,
            ));
        };
        let names = texts(hdf5.read(items, 0..arrays[items].1.rows())?.values);
        let info = &arrays[values].1;
        let is_text = info.element == Element::Bytes;
        let (of_block, width) = match (is_text, info.shape.as_slice()) {
            (true, _) => (None, names.len() as u64),
            (false, [rows]) => (Some(*rows), 1),
            (false, [rows, width]) => (Some(*rows), *width),
            (false, _) => return Err(unlike(group, block)),
        };
        let is_first = rows.is_none();
        rows = rows.or(of_block);
        let is_turned = hdf5
            .attribute(&format!("{group}/block{block}_values"), "transposed")
            .is_none_or(|turned| turned != "0");
        if width != names.len() as u64
            || !(is_text || is_turned)
            || (!is_first && of_block.is_some() && rows != of_block)
        {
            return Err(unlike(group, block));
        }
        for (column, name) in names.into_iter().enumerate() {
            let own = BlockColumn {
                array: values,
                column,
                width: usize::try_from(width).unwrap_or(usize::MAX),
            };
            let (element, content) = match is_text {
                true => (Element::Text, Content::Texts(own)),
                false => (info.element, Content::Numbers(own)),
            };
            shown.push(Shown {
                name: format!("{group}/{name}"),
                info: ArrayInfo::new(vec![0], element),
                content,
            });
        }
    }
    let index = find("axis1");
    let rows = index.map(|index| arrays[index].1.rows()).or(rows);
    let rows = rows.ok_or_else(|| unlike(group, 0))?;
    for column in &mut shown {
        column.info.shape = vec![rows];
    }
    let own = format!("{group}/index");
    if let (Some(index), false) = (index, shown.iter().any(|column| column.name == own)) {
        let first = Shown {
            name: own,
            info: arrays[index].1.clone(),
            content: Content::Array(index),
        };
        shown.insert(0, first);
    }
    Ok(shown)
}

fn unlike(group: &str, block: usize) -> Problem {
    Problem::unsupported(
        format!("block {block} of the data frame `{group}` does not have the shape of its columns"),
        REMEDY,
    )
}

/// Column names as texts. Stored names may be numbers.
fn texts(values: ArrayValues) -> Vec<String> {
    match values {
        ArrayValues::Text(texts) => texts,
        ArrayValues::I64(numbers) => numbers.iter().map(ToString::to_string).collect(),
        other => match other.to_f64() {
            Some(numbers) => numbers.iter().map(ToString::to_string).collect(),
            None => Vec::new(),
        },
    }
}

impl DataFrames {
    /// Rows of a column of texts. Parses the pickle of the whole block.
    fn texts(&self, own: BlockColumn, rows: Range<u64>) -> Result<ArrayValues, Problem> {
        let block = self.hdf5.read(own.array, 0..1)?.values;
        let ArrayValues::Bytes(mut block) = block else {
            return Err(Problem::unsupported(
                "a block of strings with an unexpected type",
                REMEDY,
            ));
        };
        let pickle = Pickle::open(Arc::new(block.pop().unwrap_or_default()), 0)?;
        let arrays = pickle.arrays();
        let [(_, info)] = arrays.as_slice() else {
            let reason = pickle.refused().first().map(|(_, reason)| reason.again());
            return Err(reason.unwrap_or_else(|| {
                Problem::unsupported(
                    "a block of the data frame holds objects that are not strings",
                    REMEDY,
                )
            }));
        };
        let values = pickle.read(0, 0..info.rows())?.values;
        let at = |row: u64| usize::try_from(row).unwrap_or(usize::MAX);
        match values.every(own.column, own.width) {
            ArrayValues::Text(texts) => match texts.get(at(rows.start)..at(rows.end)) {
                Some(texts) => Ok(ArrayValues::Text(texts.to_vec())),
                None => Err(Problem::damaged(
                    0,
                    format!("a block of the data frame with {} strings", texts.len()),
                    format!("at least {}", rows.end),
                )),
            },
            other => Err(Problem::unsupported(
                format!(
                    "a block of the data frame holds {} objects that are not strings",
                    other.len()
                ),
                "convert the objects to strings by `df.astype(str)`, and write the file again",
            )),
        }
    }
}

impl Store for DataFrames {
    fn arrays(&self) -> Arrays {
        let each = self.shown.iter();
        each.map(|shown| (shown.name.clone(), shown.info.clone()))
            .collect()
    }

    fn refused(&self) -> &[(String, Problem)] {
        &self.refused
    }

    fn nowhere(&self) -> &[(String, Problem)] {
        self.hdf5.nowhere()
    }

    fn link(&self, name: &str) -> Option<Problem> {
        self.hdf5.link(name)
    }

    fn groups(&self) -> Vec<String> {
        self.hdf5.groups()
    }

    fn attributes(&self, owner: &str) -> Vec<String> {
        self.hdf5.attributes(&self.stored(owner))
    }

    fn attribute(&self, owner: &str, name: &str) -> Option<String> {
        self.hdf5.attribute(&self.stored(owner), name)
    }

    fn absent_chunks(&self, index: usize) -> Result<u64, Problem> {
        self.hdf5.absent_chunks(self.shown[index].content.array())
    }

    fn read(&self, index: usize, rows: Range<u64>) -> Result<ArrayData, Problem> {
        let shape = vec![rows.end - rows.start];
        let values = match self.shown[index].content {
            Content::Array(array) => return self.hdf5.read(array, rows),
            Content::Numbers(own) => {
                let block = self.hdf5.read(own.array, rows)?.values;
                block.every(own.column, own.width)
            }
            Content::Texts(own) => self.texts(own, rows)?,
        };
        Ok(ArrayData { shape, values })
    }
}

impl DataFrames {
    /// Name under which the file stores the array `owner`.
    fn stored(&self, owner: &str) -> String {
        let own = self.shown.iter().find(|shown| shown.name == owner);
        let stored = own.and_then(|own| {
            let arrays = self.hdf5.arrays();
            Some(arrays.get(own.content.array())?.0.clone())
        });
        stored.unwrap_or_else(|| owner.to_owned())
    }
}

impl Content {
    fn array(&self) -> usize {
        match self {
            Content::Array(array) => *array,
            Content::Numbers(own) | Content::Texts(own) => own.array,
        }
    }
}
