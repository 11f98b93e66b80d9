//! Outcome of a verification, as data.

use serde::Serialize;

use crate::card::SEAL_REMARK;
use crate::error::Damage;
use crate::level::Level;

/// Schema of a verification.
pub const VERIFICATION_SCHEMA: &str = "taceva.verification/1";

/// Outcome of a verification.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Verification {
    /// Schema of the verification, [`VERIFICATION_SCHEMA`].
    pub schema: &'static str,
    /// The bundle; `None` if its manifest cannot be read.
    pub bundle: Option<BundleFacts>,
    /// Program that verified the bundle, with its version.
    pub program: String,
    /// Every level up to the requested level.
    pub levels: Vec<LevelCheck>,
    /// Every claim.
    pub claims: Vec<ClaimCheck>,
    /// Differences of scores in facts that no claim states, and parts of the results that cannot be computed from a state.
    pub others: Vec<OtherCheck>,
    /// Findings that make the bundle unusable.
    pub damage: Vec<Damage>,
    /// Number of claims by verdict.
    pub summary: Summary,
    /// Remarks for readers.
    pub remarks: Vec<String>,
    /// Requested level; `None` for the deepest level that the files allow.
    #[serde(skip)]
    pub(crate) asked: Option<Level>,
}

/// Facts of the manifest.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct BundleFacts {
    /// Name of the bundle.
    pub name: String,
    /// Day on which the bundle was made.
    pub created: String,
    /// Version of the program that made the bundle.
    pub taceva: String,
    /// Origin of the samples.
    pub source: String,
    /// Statement on samples that were not measured.
    pub badge: Option<String>,
    /// Digest of the manifest.
    pub seal: String,
    /// Digest of the samples.
    pub samples_digest: String,
    /// Accepted edits of the manifest.
    pub edits: Vec<String>,
}

/// Level, with the reason if it was not reached.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct LevelCheck {
    /// Level of verification.
    pub level: Level,
    /// True if every file and claim reached the level.
    pub reached: bool,
    /// Reason why the level was not reached; `None` if reached.
    pub reason: Option<String>,
}

/// Verdict on a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub enum Verdict {
    /// The recomputed number equals the claim, bit for bit.
    #[serde(rename = "equal")]
    Equal,
    /// The recomputed number differs from the claim, but within the tolerance.
    #[serde(rename = "within")]
    Within,
    /// The recomputed number differs from the claim by more than the tolerance.
    #[serde(rename = "differs")]
    Differs,
    /// The number of the claim was not computed again.
    #[serde(rename = "not recomputable")]
    NotRecomputable,
}

impl std::fmt::Display for Verdict {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Verdict::Equal => "equal",
            Verdict::Within => "within",
            Verdict::Differs => "differs",
            Verdict::NotRecomputable => "not recomputable",
        })
    }
}

/// Claim, with the number that was computed again.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ClaimCheck {
    /// Index of the study in the results, from 0.
    pub study: usize,
    /// Metric, such as `mae`.
    pub metric: String,
    /// Channel or plane.
    pub channel: String,
    /// Variant of the metric; `None` for the metric itself.
    pub variant: Option<String>,
    /// Value of the claim in the manifest.
    #[serde(rename = "printed")]
    pub stated: f64,
    /// Value that was computed again; `None` if no value was computed.
    pub recomputed: Option<f64>,
    /// Deepest level that the claim reached.
    pub level: Level,
    /// Verdict on the claim.
    pub verdict: Verdict,
    /// Reason for a verdict other than `equal`, or for a missing deeper level.
    pub reason: Option<String>,
    /// True if the bundle lacks the files for a deeper level.
    #[serde(skip)]
    pub(crate) is_absent: bool,
}

/// Part of the results that is not a claim.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct OtherCheck {
    /// Index of the study in the results, from 0.
    pub study: usize,
    /// Part of the results: `mae of Fz`, `by_recording`.
    pub part: String,
    /// [`Verdict::Differs`] or [`Verdict::NotRecomputable`].
    pub verdict: Verdict,
    /// Reason for the verdict.
    pub reason: String,
}

/// Number of claims by verdict.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct Summary {
    /// Number of claims that are equal, bit for bit.
    pub equal: u64,
    /// Number of claims that differ, but within the tolerance.
    pub within: u64,
    /// Number of claims that differ by more than the tolerance.
    pub differs: u64,
    /// Number of claims that were not computed again.
    pub not_recomputable: u64,
}

/// Outcome in one word, for exit codes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Outcome {
    /// Every claim is equal or within the tolerance, to the requested level.
    Verified,
    /// A claim differs, or cannot be computed again.
    Unverified,
    /// The bundle is damaged, or the path is not a bundle.
    Damaged,
}

impl Verification {
    pub(crate) fn new(asked: Option<Level>) -> Verification {
        Verification {
            schema: VERIFICATION_SCHEMA,
            bundle: None,
            program: format!("taceva {}", env!("CARGO_PKG_VERSION")),
            levels: Vec::new(),
            claims: Vec::new(),
            others: Vec::new(),
            damage: Vec::new(),
            summary: Summary::default(),
            remarks: vec![SEAL_REMARK.to_owned()],
            asked,
        }
    }

    /// Outcome in one word.
    ///
    /// If no level is requested, a claim counts as verified even if the bundle lacks the files for a deeper level.
    pub fn outcome(&self) -> Outcome {
        if !self.damage.is_empty() {
            return Outcome::Damaged;
        }
        let is_unverified = |claim: &ClaimCheck| match (claim.verdict, self.asked) {
            (Verdict::Differs, _) => true,
            (Verdict::NotRecomputable, None) => !claim.is_absent,
            (_, Some(asked)) => claim.level < asked,
            _ => false,
        };
        let differs = |other: &OtherCheck| other.verdict == Verdict::Differs;
        // Results without a claim can lack a level too.
        let is_short = self.asked.is_some() && self.levels.iter().any(|level| !level.reached);
        match is_short || self.claims.iter().any(is_unverified) || self.others.iter().any(differs) {
            true => Outcome::Unverified,
            false => Outcome::Verified,
        }
    }

    /// Adds `level`, which counts as reached if there is no `reason`.
    pub(crate) fn add_level(&mut self, level: Level, reason: Option<String>) {
        self.levels.push(LevelCheck {
            level,
            reached: reason.is_none(),
            reason,
        });
    }

    /// The same verification, ended by damage at `level`.
    pub(crate) fn damaged_at(mut self, level: Level, damage: Vec<Damage>) -> Verification {
        let last = self.asked.unwrap_or(Level::Predictions);
        for own in Level::ALL {
            if own >= level && own <= last {
                let reason = match own == level {
                    true => "the bundle is damaged".to_owned(),
                    false => format!("the level {level} was not reached"),
                };
                self.add_level(own, Some(reason));
            }
        }
        self.damage = damage;
        self
    }

    /// The same verification, with the number of claims by verdict.
    pub(crate) fn summed(mut self) -> Verification {
        let mut summary = Summary::default();
        for claim in &self.claims {
            *match claim.verdict {
                Verdict::Equal => &mut summary.equal,
                Verdict::Within => &mut summary.within,
                Verdict::Differs => &mut summary.differs,
                Verdict::NotRecomputable => &mut summary.not_recomputable,
            } += 1;
        }
        self.summary = summary;
        self
    }
}
