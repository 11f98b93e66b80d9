//! Taxels of a recording, and the facts about their file in the header.

use serde::{Deserialize, Serialize};
use taceva_core::{Channel, SignalInfo, Unit};

use crate::digest::{Digest, PartsDigest};

/// Taxels of a recording.
///
/// ```
/// use taceva_core::{SignalInfo, Unit};
/// use taceva_dataset::SignalsSpec;
///
/// let info = SignalInfo::new(5, 1, 3, Unit::Microtesla)?;
/// let spec = SignalsSpec::new(info, ["x", "y", "z"])?.with_rest([[0, 99]]);
/// assert_eq!(spec.column_names().nth(4).as_deref(), Some("taxel_1_0_y"));
/// assert!(SignalsSpec::new(info, ["x", "y"]).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SignalsSpec {
    /// Grid and unit of the taxels.
    pub info: SignalInfo,
    /// Names of the values of one taxel, in order.
    pub channels: Vec<String>,
    /// Ranges of rows without contact, each as first and last row, from 0.
    pub rest: Vec<[u64; 2]>,
}

impl SignalsSpec {
    /// Taxels of `info`, each with values called `channels`, without rows marked as without contact.
    ///
    /// # Errors
    /// Error message if the number of names is not the number of values per taxel, or a name is duplicate or invalid.
    pub fn new<N: Into<String>>(
        info: SignalInfo,
        channels: impl IntoIterator<Item = N>,
    ) -> Result<SignalsSpec, String> {
        let spec = SignalsSpec {
            info,
            channels: channels.into_iter().map(Into::into).collect(),
            rest: Vec::new(),
        };
        spec.check()?;
        Ok(spec)
    }

    /// The same taxels with the ranges of rows without contact, each as first and last row, from 0.
    #[must_use]
    pub fn with_rest(self, rest: impl IntoIterator<Item = [u64; 2]>) -> SignalsSpec {
        SignalsSpec {
            rest: rest.into_iter().collect(),
            ..self
        }
    }

    /// Column names, in the order of the values: `taxel_ROW_COLUMN_CHANNEL`.
    pub fn column_names(&self) -> impl Iterator<Item = String> + '_ {
        let SignalInfo { rows, columns, .. } = self.info;
        let places = (0..rows).flat_map(move |row| (0..columns).map(move |column| (row, column)));
        places.flat_map(|(row, column)| {
            let channels = self.channels.iter();
            channels.map(move |channel| format!("taxel_{row}_{column}_{channel}"))
        })
    }

    /// Checks the grid and the names of the values, which may come from a file. Returns an error message.
    pub(super) fn check(&self) -> Result<(), String> {
        let info = self.info;
        if !info.is_valid() {
            return Err(format!(
                "{info}: a sample has at least one number and at most {}",
                SignalInfo::LEN_MAX
            ));
        }
        if self.channels.len() != info.channels as usize {
            return Err(format!(
                "{} names for the {} numbers of a place",
                self.channels.len(),
                info.channels
            ));
        }
        for (position, name) in self.channels.iter().enumerate() {
            if Channel::named(name, Unit::One).is_err() {
                return Err(format!(
                    "`{}` is not a valid column name",
                    crate::text::shown(name)
                ));
            }
            if self.channels[..position].contains(name) {
                return Err(format!("two numbers of a place are called `{name}`"));
            }
        }
        Ok(())
    }

    /// Checks the rows without contact of a recording with `rows` rows. Returns an error message.
    pub(super) fn check_rest(&self, rows: u64) -> Result<(), String> {
        let wrong = |run: &&[u64; 2]| run[0] > run[1] || run[1] >= rows;
        match self.rest.iter().find(wrong) {
            None => Ok(()),
            Some([first, last]) => Err(format!(
                "rows {first} to {last} are stated to be without contact, but there are only {rows} rows, from 0"
            )),
        }
    }

    /// Digest of the taxel facts, to which the caller adds the values.
    pub(super) fn digest(&self) -> PartsDigest {
        let mut digest = PartsDigest::default();
        digest.part(b"taceva.signals/1");
        for side in [self.info.rows, self.info.columns, self.info.channels] {
            digest.fixed(&side.to_le_bytes());
        }
        digest.part(self.info.unit.symbol().as_bytes());
        for name in &self.channels {
            digest.part(name.as_bytes());
        }
        digest.fixed(&(self.rest.len() as u64).to_le_bytes());
        for bound in self.rest.iter().flatten() {
            digest.fixed(&bound.to_le_bytes());
        }
        digest
    }
}

/// Facts about the taxels of a recording in a header.
///
/// ```
/// # use taceva_core::{Channel, Channels, Clock, Readings, Sample, SignalInfo, Signals, Unit};
/// # use taceva_dataset::{Dataset, Recorder, RecordingFacts, RecordingSpec, SensorFacts, SignalsSpec, Source};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("recording");
/// # let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, SensorFacts::new("my skin"));
/// let info = SignalInfo::new(1, 2, 1, Unit::Count)?;
/// let spec = RecordingSpec::new(facts, Channels::new([Channel::FZ])?)
///     .with_signals(SignalsSpec::new(info, ["pressure"])?);
/// let mut recorder = Recorder::create(&path, &spec)?;
/// let sample = Sample::new("press 1").with_truth(Readings::from_values([0.5]));
/// recorder.append(&sample.with_signals(Signals::new(info, vec![512.0, 498.0])?))?;
/// let header = recorder.close()?;
///
/// let taxels = header.signals.ok_or("signals were recorded")?;
/// assert_eq!(taxels.spec.info, info);
/// let signals = Dataset::open(&path)?.signals(0)?.ok_or("every row has signals")?;
/// assert_eq!(signals.values(), [512.0, 498.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SignalsInfo {
    /// Taxels of the recording.
    pub spec: SignalsSpec,
    /// Digest of the taxel values, independent of their storage.
    pub digest: Digest,
    /// SHA-256 of the bytes of the file.
    pub sha256: Digest,
}

/// Taxels in the form of `dataset.toml`.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct WrittenSignals {
    rows: u32,
    columns: u32,
    channels: Vec<String>,
    unit: Unit,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    rest: Vec<[u64; 2]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    digest: Option<Digest>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    sha256: Option<Digest>,
}

impl WrittenSignals {
    /// Taxels of a recording that is not yet closed, without digests.
    pub(crate) fn of(spec: &SignalsSpec) -> WrittenSignals {
        WrittenSignals {
            rows: spec.info.rows,
            columns: spec.info.columns,
            channels: spec.channels.clone(),
            unit: spec.info.unit,
            rest: spec.rest.clone(),
            digest: None,
            sha256: None,
        }
    }

    /// Converts to the taxels. Returns an error message if they are invalid.
    pub(crate) fn spec(&self) -> Result<SignalsSpec, String> {
        let channels = u32::try_from(self.channels.len()).unwrap_or(u32::MAX);
        let info = SignalInfo::new(self.rows, self.columns, channels, self.unit);
        let info = info.map_err(|error| error.to_string())?;
        let spec = SignalsSpec::new(info, self.channels.iter().cloned())?;
        Ok(spec.with_rest(self.rest.iter().copied()))
    }
}

impl From<&SignalsInfo> for WrittenSignals {
    fn from(info: &SignalsInfo) -> WrittenSignals {
        WrittenSignals {
            digest: Some(info.digest),
            sha256: Some(info.sha256),
            ..WrittenSignals::of(&info.spec)
        }
    }
}

impl TryFrom<WrittenSignals> for SignalsInfo {
    type Error = String;

    fn try_from(written: WrittenSignals) -> Result<SignalsInfo, String> {
        let (Some(digest), Some(sha256)) = (written.digest, written.sha256) else {
            return Err("`[signals]` must state `digest` and `sha256`".to_owned());
        };
        Ok(SignalsInfo {
            spec: written.spec()?,
            digest,
            sha256,
        })
    }
}
