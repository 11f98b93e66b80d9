//! Summary of a map's labels for the header of the dataset.

use super::short;
use crate::error::ImportError;
use crate::import::map::{GravityMap, ImportMap, SignalsFrom, ZeroMap};
use crate::import::resolve::matrix_rows;
use crate::source_folder::SourceFolder;
use taceva_dataset::MappedColumn;

/// Sources of the channels, the time and the taxel values of `map`.
///
/// # Errors
/// [`ImportError`] if the file of a matrix cannot be read.
pub(super) fn columns(
    map: &ImportMap,
    folder: &SourceFolder,
) -> Result<Vec<MappedColumn>, ImportError> {
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
    for (position, channel) in map.channels.iter().enumerate() {
        let mut own = columns.iter_mut();
        let Some(column) = own.find(|column| column.label == channel.name()) else {
            continue;
        };
        let zero = map.zero.as_ref();
        let zero = zero.filter(|zero| zero.channels.contains(&position));
        column.zero = zero.map(ZeroMap::rule);
        let gravity = map.gravity.as_ref();
        let gravity = gravity.filter(|gravity| gravity.channels.contains(&Some(position)));
        column.gravity = gravity.map(GravityMap::rule);
    }
    for column in &mut columns {
        let mut placeholders = map.drop.placeholders.iter();
        let own = placeholders.find(|own| own.channel == column.label);
        column.placeholder = own.map(|own| own.number);
        column.from = short(&column.from);
    }
    Ok(columns)
}
