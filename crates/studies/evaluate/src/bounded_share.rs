//! Shares of predictions beyond the label bounds of a model, as counts that can be summed over parts and shards.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// Number of predictions beyond the label bounds and number of all predictions, by channel. A channel without bounds is absent.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Bounded {
    counts: BTreeMap<String, Counts>,
}

/// Counts of predictions of one channel: beyond the bounds, and in total.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Counts {
    beyond: u64,
    of: u64,
}

impl Bounded {
    /// Adds predictions of `channel`. Each item of `beyond` is true if the prediction is beyond the label bounds.
    pub fn add(&mut self, channel: &str, beyond: impl Iterator<Item = bool>) {
        let counts = self.counts.entry(channel.to_owned()).or_default();
        for is_beyond in beyond {
            counts.of += 1;
            counts.beyond += u64::from(is_beyond);
        }
    }

    /// Adds the counts of `other`, channel by channel.
    pub fn joined(mut self, other: &Bounded) -> Bounded {
        for (channel, counts) in &other.counts {
            let own = self.counts.entry(channel.clone()).or_default();
            own.beyond = own.beyond.saturating_add(counts.beyond);
            own.of = own.of.saturating_add(counts.of);
        }
        self
    }

    /// True if no channel has bounds.
    pub fn is_empty(&self) -> bool {
        self.counts.is_empty()
    }

    /// Share of predictions of `channel` beyond the label bounds; `None` without predictions.
    pub fn share(&self, channel: &str) -> Option<f64> {
        let counts = self.counts.get(channel).filter(|counts| counts.of > 0)?;
        Some(counts.beyond as f64 / counts.of as f64)
    }

    /// Share of predictions beyond the bounds, for each channel that has predictions.
    pub fn shares(&self) -> BTreeMap<String, f64> {
        let channels = self.counts.keys();
        channels
            .filter_map(|channel| Some((channel.clone(), self.share(channel)?)))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_of_shards_add_up_to_the_share_of_the_whole() {
        let mut left = Bounded::default();
        left.add("Pz", [true, false, false].into_iter());
        let mut right = Bounded::default();
        right.add("Pz", [true].into_iter());
        right.add("Fz", std::iter::empty());
        let both = left.joined(&right);
        assert_eq!((both.share("Pz"), both.share("Fz")), (Some(0.5), None));
        assert_eq!(both.shares().len(), 1);
    }
}
