//! Describes the channels in the summary of an import.

use super::reading::Reading;
use crate::import::summary::Conversion;
use crate::import::suspicion::magnitude_suspicion_in;
use crate::import::warning::ImportWarning;

impl Reading<'_> {
    pub(super) fn describe_channels(&mut self) {
        self.warn_of_columns_read_twice();
        for (position, channel) in self.map.channels.iter().enumerate() {
            let map = &self.map.columns[position];
            let column = self.table.truth(position);
            let values = || (0..column.len()).filter_map(|row| column.get(row));
            self.summary.conversions.push(Conversion {
                channel: channel.name().to_owned(),
                column: map.from.clone(),
                from: map.unit,
                to: channel.unit(),
                is_negated: map.is_negated,
                offset: map.offset,
                scale: map.scale,
                present: values().count() as u64,
            });
            self.summary
                .suspicions
                .extend(magnitude_suspicion_in(channel, &map.unit, values()));
        }
    }

    /// Warns of channels with equal numbers if the map reads both from the same column.
    fn warn_of_columns_read_twice(&mut self) {
        let columns = &self.map.columns;
        for (position, map) in columns.iter().enumerate() {
            let is_same = |other: &&usize| {
                let other = &columns[**other];
                other.from == map.from
                    && other.is_negated == map.is_negated
                    && other.scale == map.scale
                    && other.offset == map.offset
            };
            let all: Vec<usize> = (0..columns.len()).collect();
            let same: Vec<usize> = all.iter().filter(is_same).copied().collect();
            if same.len() > 1 && same[0] == position {
                let names = self.map.channels.iter().map(|channel| channel.name());
                let names: Vec<&str> = names.collect();
                self.summary.warnings.insert(ImportWarning::ColumnTwice {
                    column: map.from.clone(),
                    channels: same.iter().map(|at| names[*at].to_owned()).collect(),
                });
            }
        }
    }
}
