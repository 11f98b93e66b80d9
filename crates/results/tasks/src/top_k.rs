//! Shares of samples whose class is among the k greatest scores.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use taceva_core::counted;

use crate::clusters::ByCluster;
use crate::error::TaskError;
use crate::estimate::{Estimate, Part, estimate, share};
use crate::names::Names;
use crate::quotient::{Quotient, sum_over};
use crate::score::TaskScore;
use crate::undefined::Undefined;

/// Places of the true class among the scores of all classes, by cluster.
///
/// ```
/// use taceva_tasks::TopK;
/// let mut textile = TopK::new(["corduroy", "denim", "silk"])?;
/// textile.push("clip 1", "denim", &[0.5, 0.25, 0.25])?;
/// let scores = textile.scores(2);
/// // Two classes share the second and the third place.
/// let values: Vec<_> = scores.iter().map(|score| score.estimate.value).collect();
/// assert_eq!(values, [Ok(0.5), Ok(1.0), Ok(0.0)]);
/// assert_eq!(scores[1].variant.as_deref(), Some("k=2 ties_for"));
/// # Ok::<(), taceva_tasks::TaskError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Stored")]
pub struct TopK {
    names: Names,
    #[serde(skip_serializing)]
    n: u64,
    clusters: ByCluster<Places>,
}

/// Deserialized state, not yet validated: counts may contradict the names.
#[derive(Deserialize)]
struct Stored {
    names: Names,
    clusters: ByCluster<Places>,
}

impl TryFrom<Stored> for TopK {
    type Error = TaskError;
    fn try_from(stored: Stored) -> Result<TopK, TaskError> {
        let classes = stored.names.len() as u64;
        let mut n = 0_u64;
        for places in stored.clusters.values() {
            for (Place { above, equal }, count) in places {
                let last = above.saturating_add(*equal);
                if *equal == 0 || last > classes || *count == 0 {
                    let samples = counted(*count, "sample");
                    let places = format!("{} to {last} of {classes}", above.saturating_add(1));
                    let found = format!("{samples} on the places {places}");
                    return Err(TaskError::damaged(found));
                }
                n = TaskError::checked_count(n, *count)?;
            }
        }
        Ok(TopK {
            names: stored.names,
            n,
            clusters: stored.clusters,
        })
    }
}

/// Number of samples by the place of their class.
type Places = BTreeMap<Place, u64>;

/// Place of the true class; in files `above+equal`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
struct Place {
    /// Number of classes with a greater score.
    above: u64,
    /// Number of classes with an equal score, including the true class.
    equal: u64,
}

impl From<Place> for String {
    fn from(place: Place) -> String {
        format!("{}+{}", place.above, place.equal)
    }
}

impl TryFrom<String> for Place {
    type Error = TaskError;
    fn try_from(text: String) -> Result<Place, TaskError> {
        let parsed = text.split_once('+').and_then(|(above, equal)| {
            Some(Place {
                above: above.parse().ok()?,
                equal: equal.parse().ok()?,
            })
        });
        parsed.ok_or_else(|| TaskError::damaged(format!("the place \"{text}\"")))
    }
}

/// Treatment of classes with equal scores at the k-th place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Ties {
    /// The expected share if equal scores are ordered at random.
    Expected,
    /// The true class precedes all classes with an equal score.
    For,
    /// The true class follows all classes with an equal score.
    Against,
}

impl Place {
    /// Weight from 0 to 1 with which a sample counts as found within the first `k` places.
    fn found(self, k: u64, ties: Ties) -> Quotient {
        let free = k.saturating_sub(self.above).min(self.equal);
        let whole = |is_found: bool| Quotient {
            above: u128::from(is_found),
            below: 1,
        };
        match ties {
            Ties::Expected => Quotient {
                above: u128::from(free),
                below: self.equal,
            },
            Ties::For => whole(free > 0),
            Ties::Against => whole(free == self.equal),
        }
    }
}

impl TopK {
    /// State without samples, for the classes `names`.
    ///
    /// # Errors
    /// [`TaskError::TooFewNames`] or [`TaskError::SameName`].
    pub fn new<N: Into<String>>(names: impl IntoIterator<Item = N>) -> Result<TopK, TaskError> {
        Ok(TopK {
            names: Names::new(names, None)?,
            n: 0,
            clusters: ByCluster::default(),
        })
    }

    /// Adds a sample of `cluster` with a score of each class, in the order of the names. Scores are any finite numbers.
    ///
    /// # Errors
    /// [`TaskError::UnknownClass`], [`TaskError::SomeScores`] or [`TaskError::NotFinite`]. No sample is added on an error.
    pub fn push(&mut self, cluster: &str, truth: &str, scores: &[f64]) -> Result<(), TaskError> {
        let row = self.n + 1;
        let truth = self.names.position(row, "truth", truth)?;
        self.names.check_scores(row, scores)?;
        let of_truth = scores[truth as usize];
        let count = |is: fn(&f64, &f64) -> bool| -> u64 {
            scores
                .iter()
                .map(|score| u64::from(is(score, &of_truth)))
                .sum()
        };
        let place = Place {
            above: count(f64::gt),
            equal: count(f64::eq),
        };
        self.n += 1;
        *self.clusters.entry(cluster).entry(place).or_insert(0) += 1;
        Ok(())
    }

    /// Adds all samples of `other`.
    ///
    /// # Errors
    /// [`TaskError::OtherDefinition`] if the names differ.
    pub fn merge(mut self, other: TopK) -> Result<TopK, TaskError> {
        self.names.check_same(&other.names)?;
        self.n += other.n;
        self.clusters.merge(other.clusters, |ours, theirs| {
            for (place, count) in theirs {
                *ours.entry(place).or_insert(0) += count;
            }
        });
        Ok(self)
    }

    /// `top_k` with the expected share for equal scores, then its variants `ties_for` and `ties_against`.
    #[must_use]
    pub fn scores(&self, k: u64) -> Vec<TaskScore> {
        let score = |ties, name: &str, words: &str| {
            let definition =
                format!("share of samples whose class has one of the {k} greatest scores; {words}");
            let found = self.estimate(k, ties);
            TaskScore::new("top_k", definition, found).variant(format!("k={k}{name}"))
        };
        vec![
            score(
                Ties::Expected,
                "",
                "equal scores share their places, so that a sample counts in part",
            ),
            score(
                Ties::For,
                " ties_for",
                "among equal scores the true class stands first",
            ),
            score(
                Ties::Against,
                " ties_against",
                "among equal scores the true class stands last",
            ),
        ]
    }

    fn estimate(&self, k: u64, ties: Ties) -> Estimate {
        let mut all = Places::new();
        for places in self.clusters.values() {
            for (place, count) in places {
                *all.entry(*place).or_insert(0) += count;
            }
        }
        let value = |places: &Places| self.share_of(places, k, ties);
        let found = value(&all);
        // Subtracts each cluster and adds it again.
        let parts = self.clusters.values().map(|part| {
            for (place, count) in part {
                *all.entry(*place).or_insert(0) -= count;
            }
            let value = value(&all);
            for (place, count) in part {
                *all.entry(*place).or_insert(0) += count;
            }
            let n = part.values().sum();
            Part { n, value }
        });
        let parts: Vec<Part> = parts.collect();
        estimate(found, share(found), &parts, None)
    }

    fn share_of(&self, places: &Places, k: u64, ties: Ties) -> Result<f64, Undefined> {
        let n: u64 = places.values().sum();
        if k >= self.names.len() as u64 {
            return Err(Undefined::TooManyPlaces);
        }
        let found = places.iter().map(|(place, count)| {
            let Quotient { above, below } = place.found(k, ties);
            Quotient {
                above: above * u128::from(*count),
                below,
            }
        });
        match n {
            0 => Err(Undefined::Empty),
            n => Ok(sum_over(found, n)),
        }
    }
}
