//! Digest of the samples of a bundle: shows that two bundles were scored on the same samples.

use std::num::NonZeroUsize;
use std::path::Path;

use serde::{Deserialize, Serialize};
use taceva_evaluate::{CsvTable, read_table};
use taceva_files::seal::digest_of_bytes;
use taceva_results::{EvaluationReport, Samples};

use crate::error::BundleError;

/// Schema of `samples.json`.
pub(crate) const SAMPLES_SCHEMA: &str = "taceva.samples/1";

/// Possible names of the column with the ids of samples.
pub(crate) const IDS: [&str; 4] = [Samples::KEY, "id", "sample_id", "index"];
/// Column with the digest of each frame.
const FRAME: &str = "frame_sha256";
/// Columns that are not labels.
const BESIDE: [&str; 20] = [
    "",
    "recording",
    "protocol",
    "part",
    "point_id",
    "unit_id",
    "scene",
    "phase",
    "kind",
    Samples::GROUP,
    Samples::FOLD,
    "depth_step",
    "repeat",
    "t_s",
    "spacing_mm",
    "spacing_predicted_mm",
    "zero_u_mm",
    "intensity",
    "distance",
    FRAME,
];

/// Content of `samples.json`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct SampleDigest {
    pub(crate) schema: String,
    /// Digest over the samples of all studies.
    pub(crate) digest: String,
    pub(crate) studies: Vec<StudySamples>,
}

/// Samples of one study.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct StudySamples {
    /// Basis of the digest: `samples` for id, frame and labels of each sample, `provenance` without a table.
    pub(crate) by: String,
    /// Number of samples; `None` without a table.
    pub(crate) count: Option<u64>,
    pub(crate) digest: String,
}

impl SampleDigest {
    pub(crate) fn of(studies: Vec<StudySamples>) -> SampleDigest {
        let digests: Vec<&str> = studies.iter().map(|study| study.digest.as_str()).collect();
        SampleDigest {
            schema: SAMPLES_SCHEMA.to_owned(),
            digest: digest_of_bytes(digests.join("\n").as_bytes()),
            studies,
        }
    }
}

impl StudySamples {
    /// Samples in the table at `path`, with its numeric columns as labels.
    ///
    /// # Errors
    /// [`BundleError::Evaluate`] if the file is not a table.
    pub(crate) fn of_table(path: &Path, jobs: NonZeroUsize) -> Result<StudySamples, BundleError> {
        let (table, _) = read_table(path, jobs)?;
        Ok(StudySamples::of_read(&table))
    }

    /// Samples in `table`, with its numeric columns as labels.
    pub(crate) fn of_read(table: &CsvTable) -> StudySamples {
        let names = table.names();
        let position = |name: &str| names.iter().position(|own| own == name);
        let id = IDS.into_iter().find_map(position);
        let frame = position(FRAME);
        let is_label = |name: &str| {
            !IDS.contains(&name) && !BESIDE.contains(&name) && !name.contains(Samples::PREDICTED)
        };
        let mut labels: Vec<(&str, usize)> = Vec::new();
        for (column, name) in names.iter().enumerate() {
            let is_number = |row| table.number(row, column).is_ok();
            if is_label(name) && (0..table.rows()).all(is_number) {
                labels.push((name.as_str(), column));
            }
        }
        labels.sort_unstable();
        let mut lines: Vec<String> = Vec::with_capacity(table.rows());
        for row in 0..table.rows() {
            let id = match id {
                Some(column) => table.cell(row, column).to_owned(),
                None => (row + 1).to_string(),
            };
            let frame = frame.map_or("", |column| table.cell(row, column));
            let labels = labels.iter().map(|(name, column)| {
                let number = table.number(row, *column).ok().flatten();
                (
                    *name,
                    number.map(|number| format!("{:016x}", number.to_bits())),
                )
            });
            let labels: Vec<(&str, Option<String>)> = labels.collect();
            // A JSON list keeps ids, frames and labels apart.
            let line = serde_json::json!([id, frame, labels]).to_string();
            lines.push(line);
        }
        lines.sort_unstable();
        StudySamples {
            by: "samples".to_owned(),
            count: Some(lines.len() as u64),
            digest: digest_of_bytes(lines.join("\n").as_bytes()),
        }
    }

    /// Samples that the provenance of `report` names, for a study without a table.
    pub(crate) fn of_provenance(report: &EvaluationReport) -> StudySamples {
        let own = &report.provenance;
        let named = serde_json::json!([
            own.dataset,
            own.recordings,
            own.tables,
            own.part,
            own.split,
            own.seed
        ]);
        StudySamples {
            by: "provenance".to_owned(),
            count: None,
            digest: digest_of_bytes(named.to_string().as_bytes()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn digest(table: &str) -> Option<String> {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("t.csv");
        std::fs::write(&path, table).expect("room");
        let samples = StudySamples::of_table(&path, NonZeroUsize::MIN).ok()?;
        Some(samples.digest)
    }

    #[test]
    fn the_digest_is_of_ids_and_labels_in_any_order_of_rows_and_columns() {
        let one = digest("id,Fz,Fx\na,0.5,1\nb,0.25,2\n");
        assert!(one.is_some());
        assert_eq!(one, digest("Fx,id,Fz\n2,b,0.25\n1.0,a,0.50\n"));
        assert_ne!(one, digest("id,Fz,Fx\na,0.5,1\nb,0.25,3\n"));
        assert_ne!(one, digest("id,Fz,Fy\na,0.5,1\nb,0.25,2\n"));
        assert_ne!(one, digest("id,Fz,Fx\na,0.5,1\n"));
    }

    #[test]
    fn an_id_that_looks_like_several_samples_is_one() {
        let honest = digest("id,Fz\na,0.5\nb,0.5\n").expect("a table");
        let bits = format!("{:016x}", 0.5_f64.to_bits());
        let forged = format!("id,Fz\n\"a\0\0Fz={bits}\nb\",0.5\n");
        assert_ne!(digest(&forged), Some(honest));
    }
}
