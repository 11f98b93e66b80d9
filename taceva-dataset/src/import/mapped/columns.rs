//! How a map reads each label, as the header of the dataset keeps it.

use std::borrow::Cow;

use super::map::{ImportMap, SignalsFrom};
use super::resolve::matrix_rows;
use crate::digest::Digest;
use crate::error::DatasetError;
use crate::file::SourceFolder;
use crate::header::MappedColumn;

/// Of so many columns of taxels all are named, and each by so many bytes; what is more is told apart by a digest, so that a header stays small.
const NAMED: usize = 64;
const NAME_BYTES: usize = 256;

/// How `map` reads the channels, the time and the numbers of taxels.
///
/// # Errors
/// [`DatasetError`] if the file of a matrix cannot be read.
pub(super) fn mapped_columns(
    map: &ImportMap,
    folder: &SourceFolder,
) -> Result<Vec<MappedColumn>, DatasetError> {
    let mut columns = Vec::new();
    for matrix in &map.matrices {
        let rows = matrix_rows(matrix, folder)?;
        for ((label, unit), factors) in matrix.gives.iter().zip(rows) {
            let mut column = MappedColumn::new(label, matrix.from.clone(), unit.symbol());
            column.offset.clone_from(&matrix.offset);
            column.factors = factors;
            columns.push(column);
        }
    }
    let of_matrix = columns.len();
    for (channel, own) in map.channels.iter().zip(&map.columns) {
        let mut given = columns[..of_matrix].iter();
        if given.any(|column| column.label == channel.name()) {
            continue;
        }
        let mut column =
            MappedColumn::new(channel.name(), vec![own.from.clone()], own.unit.symbol());
        column.sign = if own.is_negated { -1 } else { 1 };
        column.offset = own.offset.into_iter().collect();
        column.factors = own.scale.into_iter().collect();
        columns.push(column);
    }
    if let Some(time) = &map.time {
        let from = vec![time.column.clone()];
        columns.push(MappedColumn::new("t_s", from, time.unit.symbol()));
    }
    if let Some(signals) = &map.signals {
        let from = match &signals.from {
            SignalsFrom::Columns(columns) => columns.clone(),
            SignalsFrom::Array { file, path } => {
                vec![format!("{file} {}", path.as_deref().unwrap_or_default())]
            }
        };
        let mut column = MappedColumn::new("signals", from, signals.unit.symbol());
        let order = if signals.is_channel_first {
            "channel-first"
        } else {
            "place-first"
        };
        column.order = Some(order.to_owned());
        columns.push(column);
    }
    for column in &mut columns {
        column.from = short(&column.from);
    }
    Ok(columns)
}

/// `names`, of which no more are kept than a header has room for.
fn short(names: &[String]) -> Vec<String> {
    let (named, others) = names.split_at(names.len().min(NAMED));
    let named = named.iter().map(|name| short_name(name).into_owned());
    let others = (!others.is_empty()).then(|| {
        let digest = Digest::of(others.join("\n").as_bytes());
        format!("… and {} others, {digest}", others.len())
    });
    named.chain(others).collect()
}

fn short_name(name: &str) -> Cow<'_, str> {
    if name.len() <= NAME_BYTES {
        return name.into();
    }
    let begin: String = name.chars().take(NAME_BYTES / 4).collect();
    format!("{begin}… {}", Digest::of(name.as_bytes())).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_columns_and_long_names_stay_short_and_differ_where_they_did() {
        let names = |last: &str| -> Vec<String> {
            let names = (0..5000).map(|number| format!("taxel {number}"));
            names.chain([last.repeat(9999)]).collect()
        };
        let (one, other) = (short(&names("a")), short(&names("b")));
        assert!(one.join("").len() < 2000, "{one:?}");
        assert_ne!(one, other);
        assert_eq!(one[..NAMED], other[..NAMED]);
        assert_ne!(short(&["a".repeat(999)]), short(&["a".repeat(998)]));
        assert_eq!(short(&["force".to_owned()]), ["force"]);
    }
}
