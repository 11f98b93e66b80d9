//! Key of the result of a shard of two tables.

use taceva_core::Unit;
use taceva_dataset::Digest;

use super::{KeyBytes, TaskKey, text_of};

/// Inputs that determine the result of a shard of two tables.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShardParts<'a> {
    /// Digests of the truth table and of the prediction table.
    pub(crate) tables: [Digest; 2],
    /// Shard number and number of shards: `2/7`.
    pub(crate) shard: &'a str,
    pub(crate) units: &'a [(String, Unit)],
    pub(crate) allow_invalid: bool,
    pub(crate) metrics: &'a [String],
    pub(crate) sensor: Option<Digest>,
}

/// Inputs that determine the result of a shard of two tables with tasks.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LabelShardParts<'a> {
    /// Digests of the truth table and of the prediction table.
    pub(crate) tables: [Digest; 2],
    /// Shard number and number of shards: `2/7`.
    pub(crate) shard: &'a str,
    /// Tasks, cluster column and rules in words.
    pub(crate) labels: &'a [String],
}

impl TaskKey {
    pub(crate) fn of_label_shard(parts: LabelShardParts<'_>) -> TaskKey {
        let mut bytes = KeyBytes::new("taceva-sweep of tables with tasks");
        for table in parts.tables {
            bytes.part(&table.to_string());
        }
        bytes.part(parts.shard);
        for words in parts.labels {
            bytes.part(words);
        }
        bytes.finish()
    }

    pub(crate) fn of_shard(parts: ShardParts<'_>) -> TaskKey {
        let mut bytes = KeyBytes::new("taceva-sweep of tables");
        for table in parts.tables {
            bytes.part(&table.to_string());
        }
        bytes.part(parts.shard);
        bytes.part(&parts.units.len().to_string());
        for (name, unit) in parts.units {
            bytes.part(name);
            bytes.part(unit.symbol());
        }
        bytes.part(&parts.allow_invalid.to_string());
        bytes.part(&parts.metrics.join(","));
        bytes.part(&text_of(parts.sensor));
        bytes.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_part_of_a_shard_is_part_of_its_key() {
        let of = |tables: [&[u8]; 2], shard: &str, units: &[(String, Unit)], allow_invalid| {
            TaskKey::of_shard(ShardParts {
                tables: tables.map(Digest::of),
                shard,
                units,
                allow_invalid,
                metrics: &["all".to_owned()],
                sensor: None,
            })
        };
        let newton = [("tension".to_owned(), Unit::Newton)];
        let keys = [
            of([b"a", b"b"], "1/2", &[], false),
            of([b"b", b"a"], "1/2", &[], false),
            of([b"a", b"b"], "2/2", &[], false),
            of([b"a", b"b"], "1/2", &newton, false),
            of([b"a", b"b"], "1/2", &[], true),
        ];
        for (at, key) in keys.iter().enumerate() {
            assert!(keys[..at].iter().all(|other| other != key), "{key}");
        }
    }
}
