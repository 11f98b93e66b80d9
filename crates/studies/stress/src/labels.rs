//! Labels of a recording, which a fault can change.

use std::collections::BTreeMap;

use taceva_core::random::Draws;
use taceva_core::{Channel, Column};
use taceva_dataset::{Dataset, Table};
use taceva_metrics::STREAM_S;
use taceva_models::Model;

/// Change that a fault makes to labels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LabelChange {
    /// Function that returns the reason why the fault cannot change the labels of the given rows; `None` if it can change some.
    pub(crate) lacks: fn(&Dataset, &Model, &[usize]) -> Option<&'static str>,
    /// Function that returns the labels of one channel with the fault at the given parameter.
    pub(crate) change: fn(&Labels<'_>, f64) -> Column,
}

/// Labels of one channel, without the fault.
pub(crate) struct Labels<'a> {
    pub(crate) table: &'a Table,
    pub(crate) channel: Channel,
    /// Rows of the table with a label in `truth`.
    pub(crate) rows: &'a [usize],
    pub(crate) truth: &'a Column,
    /// Random numbers of the fault for this channel.
    pub(crate) draws: Draws,
}

/// Index of the next row of the same contact, clock and sensor unit, for each row of `table`; `None` if it is more than [`STREAM_S`] later.
pub(crate) fn followers(table: &Table) -> Vec<Option<usize>> {
    let (units, tables) = (table.unit_id(), table.source_table());
    let (points, times) = (table.point_id(), table.t_s());
    let mut followers = vec![None; table.rows()];
    let mut last: BTreeMap<(Option<&str>, Option<&str>), usize> = BTreeMap::new();
    for row in 0..table.rows() {
        let clock = (units[row].as_deref(), tables[row].as_deref());
        let Some(before) = last.insert(clock, row) else {
            continue;
        };
        let step = times[row].zip(times[before]);
        let step = step.map(|(later, earlier)| later - earlier);
        let is_next = step.is_some_and(|step| step > 0.0 && step <= STREAM_S);
        if is_next && points[before] == points[row] {
            followers[before] = Some(row);
        }
    }
    followers
}
