//! Reads attributes of arrays in a file.

use taceva_arrays::{ArrayError, ArrayFile};

use crate::foreign::columns::Stated;

/// Scale factor and offset that change nothing.
const UNPACKED: [f64; 2] = [1.0, 0.0];

/// Unit, scale factor and offset of the numbers in an array, from its attributes.
pub(crate) fn stated(file: &ArrayFile, array: &str) -> Stated {
    let said = |attribute: &str| file.attribute(array, attribute);
    let number = |attribute: &str| said(attribute)?.trim_matches(['[', ']']).parse().ok();
    let packed = [number("scale_factor"), number("add_offset")];
    let is_packed = packed.iter().any(Option::is_some);
    let packed = [packed[0].unwrap_or(1.0), packed[1].unwrap_or(0.0)];
    Stated {
        unit: said("unit").or_else(|| said("units")),
        packed: (is_packed && packed != UNPACKED).then_some(packed),
    }
}

/// Arrays among `names` that have unwritten chunks, each with the number of these chunks.
pub(super) fn absent_chunks<'n>(
    file: &ArrayFile,
    names: impl Iterator<Item = &'n str>,
) -> Result<Vec<(String, u64)>, String> {
    let counted = names.map(|name| {
        let count = file.absent_chunks(name).map_err(problem)?;
        Ok((name.to_owned(), count))
    });
    let counted: Result<Vec<(String, u64)>, String> = counted.collect();
    let mut counted = counted?;
    counted.retain(|(_, count)| *count > 0);
    Ok(counted)
}

/// True if `name` is a pandas data frame.
pub(super) fn is_data_frame(file: &ArrayFile, name: &str) -> bool {
    file.attribute(name, "pandas_type").is_some()
}

/// Unit of NumPy times stored as integers; `None` if the file does not mark the array as times.
pub(super) fn unit_of_times(file: &ArrayFile, array: &str) -> Option<&'static str> {
    let mut said = ["value_type", "kind"].iter();
    said.find_map(|name| {
        let kind = file.attribute(array, name)?;
        let unit = kind.strip_prefix("datetime64[")?.split([',', ']']).next()?;
        let known = ["ns", "us", "ms", "s"];
        known.into_iter().find(|known| *known == unit)
    })
}

/// Problem of `error` without the path of the file, because the outer error names it.
pub(super) fn problem(error: ArrayError) -> String {
    match error.array {
        Some(array) => format!("`{array}`: {}", error.problem),
        None => error.problem.to_string(),
    }
}
