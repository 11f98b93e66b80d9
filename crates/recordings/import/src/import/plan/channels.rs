//! What happens to each channel, in the summary of an import.

use super::reading::Reading;
use crate::import::summary::Conversion;
use crate::import::suspicion::magnitude_suspicion_in;

impl Reading<'_> {
    pub(super) fn describe_channels(&mut self) {
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
}
